#include "barycert/check/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace barycert::check {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& x, const Vector& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
Vector cross(const Vector& x, const Vector& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
Vector minus(const Vector& x, const Vector& y) {
    return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
double length(const Vector& x) {
    return std::sqrt(dot(x, x));
}

constexpr double degrees = 180 / std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The regular simplex has aspect 1: its longest edge is 2 sqrt(6) inradii, in 2D 2 sqrt(3).
double aspect(double longest, double inradius, int d) {
    return longest / (2 * std::sqrt(d == 2 ? 3.0 : 6.0) * inradius);
}

Shape triangle(const double* e, double area) {
    const Vector sides[] = {{e[0], e[1], 0}, {e[2], e[3], 0}, {e[2] - e[0], e[3] - e[1], 0}};
    const double l[] = {length(sides[0]), length(sides[1]), length(sides[2])};
    // Angles from twice the area and a scalar product: accurate near 0 and 180 degrees, where a cosine is not.
    const double angles[] = {std::atan2(2 * area, dot(sides[0], sides[1])),
                             std::atan2(2 * area, -dot(sides[0], sides[2])),
                             std::atan2(2 * area, dot(sides[1], sides[2]))};
    const auto [least, most] = std::minmax({angles[0], angles[1], angles[2]});
    const double radius = l[0] * l[1] * l[2] / (4 * area), inradius = 2 * area / (l[0] + l[1] + l[2]);
    return {radius / std::min({l[0], l[1], l[2]}), aspect(std::max({l[0], l[1], l[2]}), inradius, 2), least * degrees,
            most * degrees};
}

Shape tetrahedron(const double* e, double volume) {
    const Vector a{e[0], e[1], e[2]}, b{e[3], e[4], e[5]}, c{e[6], e[7], e[8]};
    const Vector ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
    // Normals of the faces opposite to each corner, as long as twice the area, all inward or all outward.
    const Vector normals[] = {cross(ab, ac), cross(c, b), cross(a, c), cross(b, a)};
    double area[4];
    for (int i = 0; i < 4; ++i) area[i] = length(normals[i]) / 2;
    const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    // The edge between the faces opposite to corners i and j joins the other two.
    struct Edge {
        int i, j;
        double squared;
    };
    const Edge edges[] = {{2, 3, aa},          {1, 3, bb},          {1, 2, cc},
                          {0, 3, dot(ab, ab)}, {0, 2, dot(ac, ac)}, {0, 1, dot(bc, bc)}};
    double longest = 0, shortest = infinity, least = infinity, most = -infinity;
    const Edge *sharpest = edges, *flattest = edges;
    double sharpest_dot = 0, flattest_dot = 0;
    for (const Edge& edge : edges) {
        longest = std::max(longest, edge.squared);
        shortest = std::min(shortest, edge.squared);
        // The angle grows with minus its cosine.
        const double product = dot(normals[edge.i], normals[edge.j]);
        const double order = product / (4 * area[edge.i] * area[edge.j]);
        if (order < least) least = order, sharpest = &edge, sharpest_dot = product;
        if (order > most) most = order, flattest = &edge, flattest_dot = product;
    }
    // |n_i x n_j| = 6 volume * |edge|: accurate near 0 and 180 degrees, where a cosine is not.
    const auto angle = [&](const Edge& edge, double product) {
        return std::atan2(6 * volume * std::sqrt(edge.squared), -product) * degrees;
    };
    const Vector x = cross(b, c), y = cross(c, a), z = cross(a, b);
    const Vector centre{aa * x[0] + bb * y[0] + cc * z[0], aa * x[1] + bb * y[1] + cc * z[1],
                        aa * x[2] + bb * y[2] + cc * z[2]};
    const double radius = length(centre) / (12 * volume);
    const double inradius = 3 * volume / (area[0] + area[1] + area[2] + area[3]);
    return {radius / std::sqrt(shortest), aspect(std::sqrt(longest), inradius, 3), angle(*sharpest, sharpest_dot),
            angle(*flattest, flattest_dot)};
}

}  // namespace

Shape shape(int d, const double* edges, double volume) {
    if (volume == 0) return {infinity, infinity, 0, 180};
    return d == 2 ? triangle(edges, volume) : tetrahedron(edges, volume);
}

}  // namespace barycert::check

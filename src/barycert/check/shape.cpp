#include "barycert/check/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "barycert/base/strict_math.hpp"

namespace barycert::check {
namespace {

template <class Real>
using Vector = std::array<Real, 3>;

template <class Real>
Real dot(const Vector<Real>& x, const Vector<Real>& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
template <class Real>
Vector<Real> cross(const Vector<Real>& x, const Vector<Real>& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
template <class Real>
Vector<Real> minus(const Vector<Real>& x, const Vector<Real>& y) {
    return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
template <class Real>
Real length(const Vector<Real>& x) {
    return std::sqrt(dot(x, x));
}

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Real>
Shape rounded(Real radius_edge, Real aspect, Real min_angle, Real max_angle) {
    const Real degrees = 180 / std::numbers::pi_v<Real>;
    return {static_cast<double>(radius_edge), static_cast<double>(aspect), static_cast<double>(min_angle * degrees),
            static_cast<double>(max_angle * degrees)};
}

/// The regular simplex has aspect 1: its longest edge is 2 sqrt(6) inradii, in 2D 2 sqrt(3).
template <class Real>
Real aspect(Real longest, Real inradius, int d) {
    return longest / (2 * std::sqrt(static_cast<Real>(d == 2 ? 3 : 6)) * inradius);
}

template <class Real>
Shape triangle(const Real* e, Real area) {
    const Vector<Real> sides[] = {{e[0], e[1], 0}, {e[2], e[3], 0}, {e[2] - e[0], e[3] - e[1], 0}};
    const Real l[] = {length(sides[0]), length(sides[1]), length(sides[2])};
    // Angles from twice the area and a scalar product: accurate near 0 and 180 degrees, where a cosine is not.
    const Real angles[] = {std::atan2(2 * area, dot(sides[0], sides[1])),
                           std::atan2(2 * area, -dot(sides[0], sides[2])),
                           std::atan2(2 * area, dot(sides[1], sides[2]))};
    const auto [min, max] = std::minmax({angles[0], angles[1], angles[2]});
    const Real radius = l[0] * l[1] * l[2] / (4 * area), inradius = 2 * area / (l[0] + l[1] + l[2]);
    return rounded(radius / std::min({l[0], l[1], l[2]}), aspect(std::max({l[0], l[1], l[2]}), inradius, 2), min, max);
}

template <class Real>
Shape tetrahedron(const Real* e, Real volume) {
    const Vector<Real> a{e[0], e[1], e[2]}, b{e[3], e[4], e[5]}, c{e[6], e[7], e[8]};
    const Vector<Real> ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
    // Normals of the faces opposite to each corner, as long as twice the area, all inward or all outward.
    const Vector<Real> normals[] = {cross(ab, ac), cross(c, b), cross(a, c), cross(b, a)};
    Real area[4];
    for (int i = 0; i < 4; ++i) area[i] = length(normals[i]) / 2;
    const Real aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    // The edge between the faces opposite to corners i and j joins the other two.
    struct Edge {
        int i, j;
        Real squared;
    };
    const Edge edges[] = {{2, 3, aa},          {1, 3, bb},          {1, 2, cc},
                          {0, 3, dot(ab, ab)}, {0, 2, dot(ac, ac)}, {0, 1, dot(bc, bc)}};
    Real longest = 0, shortest = infinity, min = infinity, max = -infinity;
    const Edge *sharpest = edges, *flattest = edges;
    Real sharpest_dot = 0, flattest_dot = 0;
    for (const Edge& edge : edges) {
        longest = std::max(longest, edge.squared);
        shortest = std::min(shortest, edge.squared);
        // The angle grows with minus its cosine.
        const Real product = dot(normals[edge.i], normals[edge.j]);
        const Real order = product / (4 * area[edge.i] * area[edge.j]);
        if (order < min) min = order, sharpest = &edge, sharpest_dot = product;
        if (order > max) max = order, flattest = &edge, flattest_dot = product;
    }
    // |n_i x n_j| = 6 volume * |edge|: accurate near 0 and 180 degrees, where a cosine is not.
    const auto angle = [&](const Edge& edge, Real product) {
        return std::atan2(6 * volume * std::sqrt(edge.squared), -product);
    };
    const Vector<Real> x = cross(b, c), y = cross(c, a), z = cross(a, b);
    const Vector<Real> centre{aa * x[0] + bb * y[0] + cc * z[0], aa * x[1] + bb * y[1] + cc * z[1],
                              aa * x[2] + bb * y[2] + cc * z[2]};
    const Real radius = length(centre) / (12 * volume);
    const Real inradius = 3 * volume / (area[0] + area[1] + area[2] + area[3]);
    return rounded(radius / std::sqrt(shortest), aspect(std::sqrt(longest), inradius, 3),
                   angle(*sharpest, sharpest_dot), angle(*flattest, flattest_dot));
}

}  // namespace

template <class Real>
Shape shape(int d, const Real* edges, Real volume) {
    if (volume == 0) return {infinity, infinity, 0, 180};
    return d == 2 ? triangle(edges, volume) : tetrahedron(edges, volume);
}

template Shape shape(int, const double*, double);
template Shape shape(int, const long double*, long double);

}  // namespace barycert::check

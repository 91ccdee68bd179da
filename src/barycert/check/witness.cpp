#include "barycert/check/witness.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "barycert/core/predicates.hpp"
#include "barycert/core/simplex.hpp"

namespace barycert::check {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Vector = std::array<Rational, 3>;

Vector operator-(const Vector& x, const Vector& y) {
    return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
Vector cross(const Vector& x, const Vector& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
Rational dot(const Vector& x, const Vector& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
bool is_zero(const Vector& x) {
    return x[0] == 0 && x[1] == 0 && x[2] == 0;
}

/// The points x with normal . x >= offset.
struct HalfSpace {
    Vector normal;
    Rational offset;
    Rational over(const Vector& x) const { return dot(normal, x) - offset; }
};

struct Cell {
    std::vector<Vector> corners;
    std::vector<HalfSpace> sides;  ///< whose intersection it is

    Cell(int d, const Corners& at) {
        const auto n = static_cast<std::size_t>(d) + 1;
        for (std::size_t i = 0; i < n; ++i) {
            Vector p{};
            for (std::size_t k = 0; k + 1 < n; ++k) p[k] = Rational(at[i][k]);
            corners.push_back(p);
        }
        for (std::size_t i = 0; i < n; ++i) {
            const Vector &a = corners[(i + 1) % n], &b = corners[(i + 2) % n];
            const Vector up{0, 0, 1};
            HalfSpace side{cross(b - a, d == 2 ? up : corners[(i + 3) % n] - a), 0};
            side.offset = dot(side.normal, a);
            if (side.over(corners[i]) < 0) {
                for (Rational& x : side.normal) x = -x;
                side.offset = -side.offset;
            }
            sides.push_back(std::move(side));
        }
    }

    bool holds(const Vector& x) const {
        return std::all_of(sides.begin(), sides.end(), [&](const HalfSpace& s) { return s.over(x) >= 0; });
    }
};

/// Corners of a in b, and where edges of a pass through sides of b into or out of b.
void add_extreme_points(const Cell& a, const Cell& b, std::vector<Vector>& points) {
    for (std::size_t i = 0; i < a.corners.size(); ++i) {
        if (b.holds(a.corners[i])) points.push_back(a.corners[i]);
        for (std::size_t j = 0; j < i; ++j) {
            for (const HalfSpace& side : b.sides) {
                const Rational u = side.over(a.corners[i]), v = side.over(a.corners[j]);
                if (u == v || (u > 0) == (v > 0)) continue;
                Vector x;
                for (std::size_t k = 0; k < 3; ++k) x[k] = (a.corners[j][k] * u - a.corners[i][k] * v) / (u - v);
                if (b.holds(x)) points.push_back(std::move(x));
            }
        }
    }
}

int dimension_of(const std::vector<Vector>& points) {
    if (points.empty()) return -1;
    Vector edge{}, normal{};
    int dimension = 0;
    for (const Vector& p : points) {
        const Vector e = p - points.front();
        if (dimension == 0 && !is_zero(e)) edge = e, dimension = 1;
        if (dimension == 1 && !is_zero(cross(edge, e))) normal = cross(edge, e), dimension = 2;
        if (dimension == 2 && dot(normal, e) != 0) return 3;
    }
    return dimension;
}

/// The doubles of the witness themselves lie in both cells; in both interiors if `inside`.
bool lies_in(int d, const Corners& cell, const double* point, bool inside) {
    const Simplex s = d == 2 ? Simplex::triangle : Simplex::tetrahedron;
    double vertices[12];
    for (int i = 0; i <= d; ++i) {
        for (int k = 0; k < d; ++k) vertices[i * d + k] = cell[static_cast<std::size_t>(i)][k];
    }
    const auto signs = weight_signs(s, vertices, point);
    return signs && (inside ? signs->feature(s) == Feature::interior : signs->contains());
}

}  // namespace

Common common_part(int d, const Corners& a, const Corners& b) {
    const Cell p(d, a), q(d, b);
    std::vector<Vector> points;
    add_extreme_points(p, q, points);
    add_extreme_points(q, p, points);
    Common common;
    common.dimension = dimension_of(points);
    if (points.empty()) return common;
    // What the two have in common is the convex hull of these points: their mean is in its relative interior.
    Witness& w = common.witness;
    bool finite = true;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
        Rational mean = 0;
        for (const Vector& x : points) mean += x[k];
        mean /= static_cast<unsigned>(points.size());
        w.point[k] = mean.convert_to<double>();
        w.fraction[k] = mean.str();
        finite = finite && std::isfinite(w.point[k]);
    }
    const bool inside = common.dimension == d;
    w.exact = finite && lies_in(d, a, w.point.data(), inside) && lies_in(d, b, w.point.data(), inside);
    return common;
}

}  // namespace barycert::check

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "barycert/check_results.hpp"
#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "core/base/vectors.hpp"
#include "core/scaled_double.hpp"
#include "core/whole_points.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/check/surface/parts.hpp"
#include "mesh/index/overlap.hpp"

namespace barycert::check {
namespace {

// Homogeneous coordinates, whole numbers: no quotient is ever put in lowest terms on the way, which for coordinates
// over the whole range of doubles took all the time. Each axis has its own unit; what follows is affine.

using Number = core::WholeNumber;
using base::cross, base::dot, base::minus;
using core::WholeVector;

/// x / weight. The weight is positive.
struct Point {
    WholeVector x;
    Number weight;
};

/// [i][j]: corner j of `other` over the side of the cell opposite to corner i: not negative for all i if it is in the
/// cell. For a triangle in space also over and under its plane.
std::vector<std::vector<Number>> over_sides(const std::vector<WholeVector>& cell,
                                            const std::vector<WholeVector>& other) {
    const std::size_t n = cell.size();
    std::vector<std::vector<Number>> over(n);
    const WholeVector up = n == 3 ? cross(minus(cell[1], cell[0]), minus(cell[2], cell[0])) : WholeVector();
    if (n == 3) {  // in the plane all are zero
        over.resize(5);
        for (const WholeVector& p : other) {
            over[3].push_back(dot(up, minus(p, cell[0])));
            over[4].push_back(-over[3].back());
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        const WholeVector &a = cell[(i + 1) % n], &b = cell[(i + 2) % n];
        WholeVector normal = cross(minus(b, a), n == 3 ? up : minus(cell[(i + 3) % n], a));
        if (dot(normal, minus(cell[i], a)) < 0) {
            for (Number& x : normal) x = -x;
        }
        for (const WholeVector& p : other) over[i].push_back(dot(normal, minus(p, a)));
    }
    return over;
}

/// Corners of a in b, and where edges of a pass through sides of b into or out of b. On an edge from p to q that passes
/// through a side at (q u - p v) / (u - v), u and v the heights of p and q over it, any height is the same mean of
/// those at p and q.
void add_extreme_points(const std::vector<WholeVector>& a, const std::vector<WholeVector>& b,
                        std::vector<Point>& points) {
    const auto over = over_sides(b, a);
    const std::size_t n = a.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (std::ranges::all_of(over, [&](const auto& side) { return side[i] >= 0; })) points.push_back({a[i], 1});
        for (std::size_t j = 0; j < i; ++j) {
            for (std::size_t s = 0; s < over.size(); ++s) {
                const Number &u = over[s][i], &v = over[s][j];
                if (u == v || (u > 0) == (v > 0)) continue;
                const bool positive = u > v;
                const auto mean = [&](const Number& at_i, const Number& at_j) {
                    return positive ? at_j * u - at_i * v : at_i * v - at_j * u;
                };
                bool inside = true;
                for (std::size_t t = 0; t < over.size() && inside; ++t)
                    inside = t == s || mean(over[t][i], over[t][j]) >= 0;
                if (!inside) continue;
                Point x{{}, positive ? u - v : v - u};
                for (std::size_t k = 0; k < 3; ++k) x.x[k] = mean(a[i][k], a[j][k]);
                points.push_back(std::move(x));
            }
        }
    }
}

/// As many of the points as span what all of them do: those whose homogeneous coordinates do not depend on those of the
/// ones before, by elimination.
std::vector<Point> spanning(std::size_t d, const std::vector<Point>& points) {
    struct PivotRow {
        std::array<Number, 4> at;
        std::size_t pivot;
    };
    std::vector<PivotRow> rows;
    std::vector<Point> chosen;
    for (const Point& p : points) {
        std::array<Number, 4> v{p.x[0], p.x[1], p.x[2], p.weight};
        for (const PivotRow& row : rows) {
            const Number factor = v[row.pivot];
            if (factor == 0) continue;
            for (std::size_t k = 0; k < 4; ++k) v[k] = v[k] * row.at[row.pivot] - row.at[k] * factor;
        }
        const auto pivot =
            static_cast<std::size_t>(std::ranges::find_if(v, [](const Number& x) { return x != 0; }) - v.begin());
        if (pivot == 4) continue;
        rows.push_back({v, pivot});
        chosen.push_back(p);
        if (chosen.size() == d + 1) break;
    }
    return chosen;
}

/// Longer fractions are not put in lowest terms, but for powers of two, and are not written where doubles do as well:
/// either takes time quadratic in their length. Numbers of coordinates within 2^60 of each other have a few hundred
/// bits.
constexpr std::size_t max_bits = 4096;

/// numerator / denominator * 2^exponent as it is written, and rounded.
class Fraction {
public:
    /// Requires: the denominator is positive.
    Fraction(Number numerator, Number denominator, int exponent)
        : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {
        if (numerator_ == 0) {
            denominator_ = 1;
            return;
        }
        (exponent > 0 ? numerator_ : denominator_) <<= static_cast<unsigned>(std::abs(exponent));
        const auto twos = static_cast<unsigned>(std::min(lsb(abs(numerator_)), lsb(denominator_)));
        numerator_ >>= twos;
        denominator_ >>= twos;
        if (size() > max_bits) return;
        const Number common = gcd(numerator_, denominator_);
        numerator_ /= common;
        denominator_ /= common;
    }

    /// Bits of the longer of both.
    std::size_t size() const { return std::max(numerator_ == 0 ? 0 : msb(abs(numerator_)) + 1, msb(denominator_) + 1); }

    std::string text() const { return numerator_.str() + (denominator_ == 1 ? "" : "/" + denominator_.str()); }

    double rounded() const { return core::rounded_quotient(numerator_, denominator_, 0); }

private:
    Number numerator_, denominator_;
};

/// The double itself.
Fraction dyadic(double x) {
    const core::Unit unit{x};
    return {core::whole(x, unit), 1, unit.power()};
}

/// The rounded point itself lies in both cells; in both interiors if `inside`.
bool lies_in(Simplex s, const Corners& cell, const double* point, bool inside) {
    const int d = space_dimension(s);
    double vertices[12];
    for (int i = 0; i < vertex_count(s); ++i) std::copy_n(cell[static_cast<std::size_t>(i)], d, vertices + i * d);
    const auto signs = checked_weight_signs(s, vertices, point);
    if (s == Simplex::triangle3d && orient3d(vertices, vertices + 3, vertices + 6, point) != Sign::zero) return false;
    return signs && (inside ? signs->feature(s) == Feature::interior : signs->contains());
}

CellContact common_part(Simplex simplex, const CellPair& cells, const Corners& a, const Corners& b) {
    const auto d = static_cast<std::size_t>(space_dimension(simplex)),
               n = static_cast<std::size_t>(vertex_count(simplex));
    std::array<core::Unit, 3> units;
    for (const Corners& cell : {a, b}) {
        for (std::size_t i = 0; i < n * d; ++i) units[i % d].add(cell[i / d][i % d]);
    }
    const auto whole = [&](const Corners& cell) {
        std::vector<WholeVector> corners(n);
        for (std::size_t i = 0; i < n * d; ++i) corners[i / d][i % d] = core::whole(cell[i / d][i % d], units[i % d]);
        return corners;
    };
    const std::vector<WholeVector> p = whole(a), q = whole(b);
    std::vector<Point> all;
    add_extreme_points(p, q, all);
    add_extreme_points(q, p, all);
    const std::vector<Point> points = spanning(d, all);
    const int dimension = static_cast<int>(points.size()) - 1;
    CellContact contact{cells, points.size() == n, dimension, {}};
    if (points.empty()) return contact;
    // The convex hull of all points is the common part: the mean of some that span it is in its relative interior.
    Point sum{{}, 1};
    for (const auto& [x, weight] : points) {
        for (std::size_t k = 0; k < 3; ++k) sum.x[k] = sum.x[k] * weight + x[k] * sum.weight;
        sum.weight *= weight;
    }
    const Number denominator = sum.weight * static_cast<unsigned>(points.size());
    CommonPoint& common = contact.common;
    bool finite = true, short_enough = true;
    std::vector<Fraction> means;
    for (std::size_t k = 0; k < d; ++k) {
        const Fraction& mean = means.emplace_back(sum.x[k], denominator, units[k].power());
        common.point[k] = mean.rounded();
        finite = finite && std::isfinite(common.point[k]);
        short_enough = short_enough && mean.size() <= max_bits;
    }
    common.exact = finite && lies_in(simplex, a, common.point.data(), contact.overlap) &&
                   lies_in(simplex, b, common.point.data(), contact.overlap);
    for (std::size_t k = 0; k < means.size(); ++k) {
        // Where the doubles do as well, nobody wants a number of thousands of digits.
        common.fraction[k] = !short_enough && common.exact ? dyadic(common.point[k]).text() : means[k].text();
    }
    return contact;
}

}  // namespace

CellContact common_part(const Mesh& mesh, const CellPair& cells) {
    return common_part(mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron, cells,
                       corner_points(mesh, static_cast<std::size_t>(cells[0])),
                       corner_points(mesh, static_cast<std::size_t>(cells[1])));
}

CellContact common_part(const Surface& surface, const CellPair& triangles) {
    std::array<Corners, 2> at{};
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            at[i][k] = &surface.points[3 * static_cast<std::size_t>(
                                               surface.cells[3 * static_cast<std::size_t>(triangles[i]) + k])];
    }
    return common_part(Simplex::triangle3d, triangles, at[0], at[1]);
}

}  // namespace barycert::check

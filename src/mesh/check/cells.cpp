#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/vectors.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/index/exact_volumes.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/pulling.hpp"

namespace barycert::check {
namespace {

/// The sign of the volume as plain double arithmetic has it.
int plain_sign(int d, const double* const* p) {
    base::Vector3<double> e[3]{};
    for (int i = 0; i < d; ++i) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) e[i][k] = p[i + 1][k] - p[0][k];
    }
    const double det = d == 2 ? e[0][0] * e[1][1] - e[0][1] * e[1][0] : base::dot(e[0], base::cross(e[1], e[2]));
    return det > 0 ? 1 : det < 0 ? -1 : 0;
}

/// Which kind of degenerate cell it is. Requires: its volume is exactly zero.
const char* kind(int d, const double* const* p) {
    const double* other = nullptr;  // a second place
    for (int i = 1; i <= d; ++i) {
        if (!std::equal(p[0], p[0] + d, p[i])) other = p[i];
    }
    if (other == nullptr) return "a point";
    for (int i = 1; i <= d; ++i) {
        if (d == 3 && proper(3, {{}, {p[0], other, p[i]}})) return "coplanar";
    }
    return "collinear";
}

// Shape measures in plain floating point, from the edges of a cell from its first corner, divided by a power of two so
// that the largest component is in [1, 2), and its volume in the same unit, accurately: plain formulas lose all its
// digits on slivers. In double where the volume is at least 2^-300, for then no length is below that and no product of
// two underflows; else in long double, whose exponents are enough for any cell.

struct Shape {
    double radius_edge = 0, aspect = 0;     ///< see CellMeasures
    double min_angle = 0, max_angle = 180;  ///< degrees
};

using base::cross, base::dot, base::minus, base::Vector3;
template <class Real>
Real length(const Vector3<Real>& x) {
    return std::sqrt(dot(x, x));
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The regular simplex has aspect 1: its longest edge is 2 sqrt(6) inradii, in 2D 2 sqrt(3).
template <class Real>
Shape shape_of_lengths(int d, Real radius, Real inradius, Real shortest, Real longest, Real min_angle, Real max_angle) {
    const Real degrees = 180 / std::numbers::pi_v<Real>;
    const Real aspect = longest / (2 * std::sqrt(static_cast<Real>(d == 2 ? 3 : 6)) * inradius);
    return {static_cast<double>(radius / shortest), static_cast<double>(aspect),
            static_cast<double>(min_angle * degrees), static_cast<double>(max_angle * degrees)};
}

template <class Real>
Shape triangle(const Real* e, Real area) {
    const Vector3<Real> sides[] = {{e[0], e[1], 0}, {e[2], e[3], 0}, {e[2] - e[0], e[3] - e[1], 0}};
    const Real l[] = {length(sides[0]), length(sides[1]), length(sides[2])};
    const auto [shortest, longest] = std::minmax({l[0], l[1], l[2]});
    // Angles from twice the area and a scalar product: accurate near 0 and 180 degrees, where a cosine is not.
    const Real angles[] = {std::atan2(2 * area, dot(sides[0], sides[1])),
                           std::atan2(2 * area, -dot(sides[0], sides[2])),
                           std::atan2(2 * area, dot(sides[1], sides[2]))};
    const auto [min, max] = std::minmax({angles[0], angles[1], angles[2]});
    const Real radius = l[0] * l[1] * l[2] / (4 * area), inradius = 2 * area / (l[0] + l[1] + l[2]);
    return shape_of_lengths(2, radius, inradius, shortest, longest, min, max);
}

template <class Real>
Shape tetrahedron(const Real* e, Real volume) {
    const Vector3<Real> a{e[0], e[1], e[2]}, b{e[3], e[4], e[5]}, c{e[6], e[7], e[8]};
    const Vector3<Real> ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
    // Normals of the faces opposite to each corner, as long as twice the area, all inward or all outward.
    const Vector3<Real> normals[] = {cross(ab, ac), cross(c, b), cross(a, c), cross(b, a)};
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
    const Vector3<Real> x = cross(b, c), y = cross(c, a), z = cross(a, b);
    Vector3<Real> centre;
    for (std::size_t k = 0; k < 3; ++k) centre[k] = aa * x[k] + bb * y[k] + cc * z[k];
    const Real radius = length(centre) / (12 * volume);
    const Real inradius = 3 * volume / (area[0] + area[1] + area[2] + area[3]);
    return shape_of_lengths(3, radius, inradius, std::sqrt(shortest), std::sqrt(longest),
                            angle(*sharpest, sharpest_dot), angle(*flattest, flattest_dot));
}

/// Corners 1, 2 (and 3) less corner 0, d numbers each; |volume|, 0 for a degenerate cell.
template <class Real>
Shape shape(int d, const Real* edges, Real volume) {
    if (volume == 0) return {infinity, infinity, 0, 180};
    return d == 2 ? triangle(edges, volume) : tetrahedron(edges, volume);
}

/// Edges from corner 0, divided by a power of two so that the largest component is in [1, 2); its exponent. If a
/// difference overflows, some are infinite, and the exponent is above those of all doubles.
template <class Real>
int scaled_edges(int d, const double* const* p, Real* edges) {
    Real max = 0;
    for (int i = 0; i < d; ++i) {
        for (int k = 0; k < d; ++k) {
            edges[i * d + k] = static_cast<Real>(p[i + 1][k]) - static_cast<Real>(p[0][k]);
            max = std::max(max, std::fabs(edges[i * d + k]));
        }
    }
    if (max == 0) return 0;
    if (!std::isfinite(max)) return 1024;
    const int exponent = std::ilogb(max);
    const Real factor = std::scalbn(Real(1), -exponent);  // exact to multiply by unless it is infinite
    for (int i = 0; i < d * d; ++i) edges[i] *= factor;
    return exponent;
}

Shape shape_of(int d, const double* const* p, double volume, const Integer& exact, const ExactVolumes& volumes) {
    double edges[9] = {};
    const int exponent = scaled_edges(d, p, edges);
    const double scaled = std::scalbn(std::fabs(volume), -d * exponent);
    if (exact.sign() == 0 || (std::isnormal(volume) && scaled >= 0x1p-300 && scaled <= 8))
        return shape(d, edges, scaled);
    // Too thin for double, or its edges are too long. The volume, near 1 first: it may be no double.
    long double wide[9] = {};
    const int wide_exponent = scaled_edges(d, p, wide);
    const int scale = volumes.exponent(exact) / d;
    const long double near_one = std::fabs(volumes.rounded(exact, scale));
    return shape(d, wide, std::scalbn(near_one, d * (scale - wide_exponent)));
}

struct CellPart {
    DefectList defects;
    Integer total = {};
    std::uint64_t positive = 0, negative = 0, degenerate = 0;
};

struct CellChecker {
    Checked& c;
    CellMeasures& m = c.report.measures;

    bool usable(std::size_t cell, CellPart& part) const {
        const std::span nodes = c.mesh.corners_of(cell);
        bool is_finite = true, repeated = false;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i] < 0 || static_cast<std::size_t>(nodes[i]) >= c.finite.size()) {
                note(DefectKind::index_out_of_range, cell, part);
                return false;
            }
            is_finite = is_finite && c.finite[static_cast<std::size_t>(nodes[i])] != 0;
            for (std::size_t j = 0; j < i; ++j) repeated = repeated || nodes[i] == nodes[j];
        }
        if (!is_finite) m.defects[cell] |= defect_bit(DefectKind::not_finite);
        if (repeated) note(is_uncut(cell) ? DefectKind::uncut_cell : DefectKind::repeated_node, cell, part);
        return is_finite && !repeated;
    }

    void measure(std::size_t cell, CellPart& part) const {
        const auto corners = corner_points(c.mesh, cell);
        const double* const* const p = corners.data();
        const int d = c.mesh.dimension;
        const Integer volume = c.volumes.cell(p);
        const int sign = volume.sign();
        m.orientation[cell] = static_cast<std::int8_t>(sign);
        if (sign == 0 && c.mesh.shapes.types.empty()) note(DefectKind::degenerate_cell, cell, part, kind(d, p));
        if (sign == 0) c.defects.mark(static_cast<Mesh::Index>(cell), DefectKind::degenerate_cell);
        ++(sign == 0 ? part.degenerate : sign > 0 ? part.positive : part.negative);
        part.total = sign < 0 ? part.total - volume : part.total + volume;
        if (plain_sign(d, p) != sign) note(DefectKind::plain_sign_wrong, cell, part);
        if (m.volume.empty()) return;  // shapes are not asked for

        m.volume[cell] = c.volumes.rounded(volume);
        const Shape s = shape_of(d, p, m.volume[cell], volume, c.volumes);
        m.radius_edge[cell] = s.radius_edge;
        m.aspect[cell] = s.aspect;
        m.min_angle[cell] = s.min_angle;
        m.max_angle[cell] = s.max_angle;

        double vertices[12];
        for (int i = 0; i <= d; ++i) std::copy_n(p[i], d, vertices + i * d);
        m.condition[cell] = condition_number(d == 2 ? Simplex::triangle : Simplex::tetrahedron, vertices);
    }

    /// It stands for a cell of the file that cannot be cut.
    bool is_uncut(std::size_t cell) const {
        const std::vector<std::uint16_t>& inside = c.mesh.shapes.inside;
        return cell < inside.size() && inside[cell] == mesh::uncut_part;
    }

    void note(DefectKind defect, std::size_t cell, CellPart& part, const char* detail = "") const {
        part.defects.add_marked(defect, {.cells = {static_cast<Mesh::Index>(cell), -1}, .detail = detail});
    }
};

/// Shapes with parts in both orders, or without a volume: each once.
void find_folded(Checked& c) {
    const std::vector<Mesh::Index>& parts = c.mesh.shapes.parts;
    for (std::size_t shape = 0; shape + 1 < parts.size(); ++shape) {
        bool positive = false, negative = false, zero = false;
        const auto first = std::min(static_cast<std::size_t>(parts[shape]), c.orientation.size());
        const auto last = std::min(static_cast<std::size_t>(parts[shape + 1]), c.orientation.size());
        for (std::size_t cell = first; cell < last; ++cell) {
            positive |= c.orientation[cell] > 0;
            negative |= c.orientation[cell] < 0;
            zero |= c.usable[cell] != 0 && c.orientation[cell] == 0;
        }
        if (zero)
            c.defects.add(DefectKind::degenerate_cell,
                          {.cells = {parts[shape], -1}, .detail = positive || negative ? "in part" : "as a whole"});
        if (positive && negative) c.defects.add_marked(DefectKind::folded_cell, {.cells = {parts[shape], -1}});
    }
}

/// Cells in both orders: those of the rarer one are told.
void find_mixed(Checked& c) {
    if (c.report.positive == 0 || c.report.negative == 0) return;
    const std::int8_t rarer = c.report.negative <= c.report.positive ? -1 : 1;
    for (std::size_t cell = 0; cell < c.orientation.size(); ++cell) {
        if (c.orientation[cell] == rarer)
            c.defects.add_marked(DefectKind::mixed_orientation, {.cells = {static_cast<Mesh::Index>(cell), -1}});
    }
}

}  // namespace

void check_cells(Checked& c) {
    const std::size_t count = c.mesh.cell_count();
    CellMeasures& measures = c.report.measures;
    c.usable.assign(count, 0);
    measures.orientation.assign(count, 0);
    measures.defects.assign(count, 0);
    const bool shapes = !c.options.verdict_only;
    for (const auto& [name, values] : cell_measures) barycert::base::resize_large(measures.*values, shapes ? count : 0);
    const CellChecker check{c};
    in_blocks(
        count, 8192, CellPart{c.defects.part()},
        [&](std::size_t first, std::size_t last, CellPart& part) {
            for (std::size_t cell = first; cell < last; ++cell) {
                if (check.usable(cell, part)) {
                    c.usable[cell] = 1;
                    check.measure(cell, part);
                } else if (shapes) {
                    for (const auto& [name, values] : cell_measures)
                        (measures.*values)[cell] = std::numeric_limits<double>::quiet_NaN();
                }
            }
        },
        [&](const CellPart& part) {
            c.defects.append(part.defects);
            c.total = c.total + part.total;
            c.report.positive += part.positive;
            c.report.negative += part.negative;
            c.report.degenerate += part.degenerate;
        });
    find_folded(c);
    find_mixed(c);
}

}  // namespace barycert::check

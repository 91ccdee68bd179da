#include "barycert/check/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/base/large_pages.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/check/shape.hpp"
#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"

namespace barycert::check {
namespace {

/// The sign of the volume as plain double arithmetic has it.
int plain_sign(int d, const double* const* p) {
    double e[3][3]{};
    for (int i = 0; i < d; ++i) {
        for (int k = 0; k < d; ++k) e[i][k] = p[i + 1][k] - p[0][k];
    }
    const double det = d == 2 ? e[0][0] * e[1][1] - e[0][1] * e[1][0]
                              : e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                                    e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                                    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    return det > 0 ? 1 : det < 0 ? -1 : 0;
}

bool same_place(int d, const double* a, const double* b) {
    return std::equal(a, a + d, b);
}

/// On one line, exactly: no projection to an axis plane has an area.
bool collinear(int d, const double* a, const double* b, const double* c) {
    for (int k = 0; k < (d == 2 ? 1 : 3); ++k) {
        const int x = k, y = (k + 1) % 3;
        const double pa[] = {a[x], a[y]}, pb[] = {b[x], b[y]}, pc[] = {c[x], c[y]};
        if (orient2d(pa, pb, pc) != Sign::zero) return false;
    }
    return true;
}

/// Which kind of degenerate cell it is. Precondition: its volume is exactly zero.
const char* kind(int d, const double* const* p) {
    const double* other = nullptr;  // a second place
    for (int i = 1; i <= d; ++i) {
        if (!same_place(d, p[0], p[i])) other = p[i];
    }
    if (other == nullptr) return "a point";
    for (int i = 1; i <= d; ++i) {
        if (!collinear(d, p[0], other, p[i])) return "coplanar";
    }
    return "collinear";
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

struct Part {
    DefectList defects;
    Integer total;
    std::uint64_t positive = 0, negative = 0, degenerate = 0;
};

class CellChecker {
public:
    CellChecker(const Mesh& mesh, const std::vector<std::uint8_t>& finite, const ExactVolumes& volumes,
                CellMeasures& measures, std::vector<std::uint8_t>& usable)
        : mesh_(mesh), finite_(finite), volumes_(volumes), m_(measures), usable_(usable) {}

    void operator()(std::size_t cell, Part& part) const {
        if (!usable(cell, part)) {
            for (auto* measure : {&m_.volume, &m_.condition, &m_.radius_edge, &m_.aspect, &m_.min_angle, &m_.max_angle})
                if (!measure->empty()) (*measure)[cell] = std::numeric_limits<double>::quiet_NaN();
            return;
        }
        usable_[cell] = 1;
        const auto p = corner_points(mesh_, cell);
        measure(cell, p.data(), part);
    }

private:
    bool usable(std::size_t cell, Part& part) const {
        const Mesh::Index* const nodes = &mesh_.cells[cell * mesh_.corners()];
        const DefectPlace place{.cells = {static_cast<Mesh::Index>(cell), -1}};
        bool is_finite = true, repeated = false;
        for (std::size_t i = 0; i < mesh_.corners(); ++i) {
            if (nodes[i] < 0 || static_cast<std::size_t>(nodes[i]) >= finite_.size()) {
                note(DefectKind::index_out_of_range, cell, place, part);
                return false;
            }
            is_finite = is_finite && finite_[static_cast<std::size_t>(nodes[i])] != 0;
            for (std::size_t j = 0; j < i; ++j) repeated = repeated || nodes[i] == nodes[j];
        }
        if (!is_finite) m_.defects[cell] |= defect_bit(DefectKind::not_finite);
        if (repeated) note(DefectKind::repeated_node, cell, place, part);
        return is_finite && !repeated;
    }

    void measure(std::size_t cell, const double* const* p, Part& part) const {
        const int d = mesh_.dimension;
        const Integer volume = volumes_.cell(p);
        const int sign = volume.sign();
        m_.orientation[cell] = static_cast<std::int8_t>(sign);
        const DefectPlace place{.cells = {static_cast<Mesh::Index>(cell), -1}};
        if (sign == 0) {
            ++part.degenerate;
            DefectPlace degenerate = place;
            degenerate.detail = kind(d, p);
            note(DefectKind::degenerate_cell, cell, degenerate, part);
        } else {
            ++(sign > 0 ? part.positive : part.negative);
            part.total = sign > 0 ? part.total + volume : part.total - volume;
        }
        if (plain_sign(d, p) != sign) note(DefectKind::plain_sign_wrong, cell, place, part);
        if (m_.volume.empty()) return;  // shapes are not asked for

        m_.volume[cell] = volumes_.rounded(volume);
        const Shape s = shape_of(d, p, m_.volume[cell], volume, volumes_);
        m_.radius_edge[cell] = s.radius_edge;
        m_.aspect[cell] = s.aspect;
        m_.min_angle[cell] = s.min_angle;
        m_.max_angle[cell] = s.max_angle;

        double vertices[12];
        for (int i = 0; i <= d; ++i) std::copy_n(p[i], d, vertices + i * d);
        m_.condition[cell] = condition_number(d == 2 ? Simplex::triangle : Simplex::tetrahedron, vertices);
    }

    void note(DefectKind problem, std::size_t cell, const DefectPlace& place, Part& part) const {
        m_.defects[cell] |= defect_bit(problem);
        part.defects.add(problem, place);
    }

    const Mesh& mesh_;
    const std::vector<std::uint8_t>& finite_;
    const ExactVolumes& volumes_;
    CellMeasures& m_;
    std::vector<std::uint8_t>& usable_;
};

/// Cells in both orders: those of the rarer one are told.
void find_mixed(const Cells& cells, CellMeasures& measures, DefectList& defects) {
    if (cells.positive == 0 || cells.negative == 0) return;
    const std::int8_t rarer = cells.negative <= cells.positive ? -1 : 1;
    for (std::size_t cell = 0; cell < measures.orientation.size(); ++cell) {
        if (measures.orientation[cell] != rarer) continue;
        measures.defects[cell] |= defect_bit(DefectKind::mixed_orientation);
        defects.add(DefectKind::mixed_orientation, {.cells = {static_cast<Mesh::Index>(cell), -1}});
    }
}

}  // namespace

Cells check_cells(const Mesh& mesh, const std::vector<std::uint8_t>& finite, const ExactVolumes& volumes, bool shapes,
                  CellMeasures& measures, DefectList& defects) {
    const std::size_t count = mesh.cell_count();
    Cells cells;
    cells.usable.assign(count, 0);
    measures.orientation.assign(count, 0);
    measures.defects.assign(count, 0);
    for (auto* measure : {&measures.volume, &measures.condition, &measures.radius_edge, &measures.aspect,
                          &measures.min_angle, &measures.max_angle})
        barycert::base::resize_large(*measure, shapes ? count : 0);
    const CellChecker check(mesh, finite, volumes, measures, cells.usable);
    in_blocks(
        count, 8192,
        [&] {
            return Part{DefectList(defects.examples()), Integer(), 0, 0, 0};
        },
        [&](std::size_t first, std::size_t last, Part& part) {
            for (std::size_t cell = first; cell < last; ++cell) check(cell, part);
        },
        [&](const Part& part) {
            defects.append(part.defects);
            cells.total = cells.total + part.total;
            cells.positive += part.positive;
            cells.negative += part.negative;
            cells.degenerate += part.degenerate;
        });
    find_mixed(cells, measures, defects);
    return cells;
}

}  // namespace barycert::check

/// Pictures of a page on a mesh: cells that are worth a look, where they are, and histograms of measures.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/check/check_measures.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/mesh.hpp"
#include "draw/picture.hpp"  // IWYU pragma: keep

namespace barycert::report {

using namespace draw;

/// The worst cells and those with defects, drawn, and a map of the mesh that has them. Empty if there are none.
std::string exhibits(const CheckReport& report, const Mesh& mesh);

/// One or two cells that are worth a look.
struct Exhibit {
    std::array<Mesh::Index, 2> cells{-1, -1};  ///< the second is -1 if it is one cell
    std::string what;                          ///< why it is shown
    const CellContact* contact = nullptr;      ///< with a witness
    bool defect = false;                       ///< else it is just the worst by shape
};

/// The cells of smallest (dihedral) angle, smallest first, that are not degenerate and can be drawn; ties by index.
std::vector<Exhibit> worst_cells(const CheckReport& report, const Mesh& mesh, std::size_t max);

/// Cells with defects that can be drawn, each problem in turn, so that a few of one kind leave room for the others.
std::vector<Exhibit> defect_cells(const CheckReport& report, const Mesh& mesh, std::size_t max);

/// Where in the mesh they are, and which by their numbers.
std::string exhibit_map(const CheckReport& report, const Mesh& mesh, const std::vector<Exhibit>& exhibits);

// Cells as points that can be drawn, and the directions to draw them from.

using Vector = Eigen::Vector3d;
using Points = std::span<const Vector>;

/// True if all corners are nodes and have finite coordinates.
bool drawable(const Mesh& mesh, std::size_t cell);

/// Points in a box of edge 2 around the origin: their differences, rounded, as large as they go. In 2D z = 0.
class Normalised {
public:
    /// Requires: points of `d` coordinates each.
    Normalised(int d, const std::vector<const double*>& points);

    const std::vector<Vector>& points() const { return points_; }
    Vector place(const double* point) const;  ///< of a further point, mapped alike

private:
    int d_;
    Vector low_ = Vector::Zero();     // corner of their box
    Vector middle_ = Vector::Zero();  // of half their box, from there, in units of 2^exponent_
    int exponent_ = 0;
    double extent_ = 0;  // half of the largest one, in the same unit
    std::vector<Vector> points_;
};

/// An orthographic projection: x to the right, y up on the paper, z towards the eye.
struct View {
    Vector x = Vector::UnitX(), y = Vector::UnitY(), z = Vector::UnitZ();
    Vector operator()(const Vector& p) const { return {p.dot(x), p.dot(y), p.dot(z)}; }
};

/// Returns the view with the longest extent of the points to the right. If `up` is 1, the middle extent points upwards
/// (seen from above); if it is 0, the least.
View broad_view(const std::vector<Vector>& points, int up);

/// The edge of a tetrahedron with the smallest dihedral angle, as two corners.
std::array<std::size_t, 2> sharpest_edge(Points tetrahedron);

/// Along an edge of a tetrahedron, which so is a point, and its angle opens to the right.
View along_edge(Points tetrahedron, std::array<std::size_t, 2> edge);

/// Returns the vector of length 1; any such vector, if `a` is zero.
inline Vector unit(const Vector& a) {
    const double max = a.cwiseAbs().maxCoeff();
    return max > std::numeric_limits<double>::min() ? Vector((a / max).normalized()) : Vector(Vector::UnitX());
}

// Histograms of measures.

struct Bins {
    bool logarithmic = false;  ///< bins are of log10 of the values
    double low = 0, width = 1;
    std::vector<std::uint64_t> counts;

    // Counted apart.
    std::uint64_t unknown = 0;   ///< NaN
    std::uint64_t infinite = 0;  ///< or beyond the largest double
    std::uint64_t zero = 0;      ///< where bins are logarithmic

    double high() const { return low + width * static_cast<double>(counts.size()); }
};

/// Every value is in one bin or counted apart. Values are not negative.
Bins bins_of(const std::vector<double>& values, const BinRule& rule);

/// A figure a measure: bars, what was counted apart. Counts are logarithmic if the smallest is below 1 % of the
/// largest.
std::string histograms(const CheckReport& report);

/// Additions to the style of pages. Two pictures stand side by side where there is room.
inline constexpr std::string_view check_style = R"(
figure>img{max-width:100%;height:auto}
.views{display:flex;flex-wrap:wrap;justify-content:space-around}
.map{display:flex;flex-wrap:wrap;gap:12px 24px;align-items:center}.map svg,.map figure{flex:2 1 420px;min-width:0}.map>div{flex:1 1 240px}
.map table{font-size:14px;margin:0}
.badge{display:inline-block;min-width:22px;padding:0 6px;border-radius:11px;background:#0072b2;color:#fff;
 text-align:center;font-size:13px;line-height:22px}.badge.problem{background:#c8102e}
.swatch{display:inline-block;width:11px;height:11px;margin-right:6px;border-radius:2px}
.swatch.a{background:var(--bar)}.swatch.b{background:var(--second)}
svg .view{fill:var(--soft)}svg .id{font-size:11px}svg .id{paint-order:stroke;
 stroke:var(--ground);stroke-width:3px;stroke-opacity:.8}
svg .face{stroke:none;fill-opacity:.16}svg .face.a{fill:var(--bar)}svg .face.b{fill:var(--second)}
svg .edge{stroke-width:1.5px}svg .edge.a{stroke:var(--bar)}svg .edge.b{stroke:var(--second)}
svg .far{stroke-dasharray:4 4;stroke-width:1px}
.node{fill:var(--ink)}.witness{fill:var(--bar-bad);stroke:var(--ground);stroke-width:1.2px}
@media print{.figures{grid-template-columns:1fr 1fr;gap:14px 20px}.card p,.map table{font-size:10.5px}}
)";

}  // namespace barycert::report

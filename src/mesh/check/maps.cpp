// The isoparametric maps of cells: where their Jacobians are positive, or not, and whether they agree at facets.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "barycert/check_results.hpp"
#include "barycert/mesh.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/consistency.hpp"
#include "mesh/index/cell_maps.hpp"
#include "mesh/index/warped_sides.hpp"
#include "mesh/pulling.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::check {
namespace {

namespace iso = core::isoparametric;

/// A cell of the mesh, and its map if that is one of a curved simplex.
struct CurvedCell {
    std::span<const Mesh::Index> corners;
    const iso::Reference* reference = nullptr;
    mesh::CellMaps::Nodes nodes = {};
    iso::Places places = {};

    CurvedCell(const Mesh& mesh, const mesh::CellMaps& maps, std::size_t cell, Mesh::Index whole)
        : corners(mesh.corners_of(cell)) {
        const auto w = static_cast<std::size_t>(whole);
        const iso::Reference* const of = maps.reference(w);
        if (of == nullptr || !of->is_simplex()) return;
        reference = of;
        nodes = maps.nodes(w);
        places = maps.places(w);
    }

    /// nullptr: where it would be in the straight cell.
    const double* place(std::size_t node) const { return places.other[node] != nullptr ? nullptr : places.at[node]; }

    /// The node with as much of the corners as one of a cell with the same reference, all of which this one has.
    std::size_t node_like(const CurvedCell& other, std::size_t node) const {
        std::array<std::uint8_t, 4> index{};
        const std::span<const Mesh::Index> own = nodes.all().first(corners.size());
        for (std::size_t i = 0; i < own.size(); ++i) {
            const auto at = std::ranges::find(own, other.nodes.at[i]);
            if (at != own.end()) index[static_cast<std::size_t>(at - own.begin())] = other.reference->indices[node][i];
        }
        return static_cast<std::size_t>(std::ranges::find(reference->indices, index) - reference->indices.begin());
    }

    /// The largest distance between places of a node of the common facet in both cells. Beside a straight one, or one
    /// of another order, it should be where it is in a straight cell, up to rounding.
    double gap(const CurvedCell& beyond) const {
        double most = 0;
        for (std::size_t node = corners.size(); node < reference->nodes; ++node) {
            const auto& index = reference->indices[node];
            bool common = true;
            for (std::size_t i = 0; i < corners.size(); ++i)
                common &= index[i] == 0 || std::ranges::count(beyond.corners, nodes.at[i]) != 0;
            if (!common) continue;
            const double* const p = place(node);
            const double* const q =
                beyond.reference == reference ? beyond.place(beyond.node_like(*this, node)) : nullptr;
            std::array<double, 3> off{};
            double largest = 0;
            for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
                double straight = 0;
                for (std::size_t i = 0; i < corners.size(); ++i) {
                    straight += index[i] * (places.at[i][k] / reference->order);
                    largest = std::max(largest, std::fabs(places.at[i][k]));
                }
                off[k] = (p != nullptr ? p[k] : straight) - (q != nullptr ? q[k] : straight);
            }
            const double distance = std::hypot(off[0], off[1], off[2]);
            if (distance > (p != nullptr && q != nullptr ? 0 : 0x1p-48 * largest)) most = std::max(most, distance);
        }
        return most;
    }
};

/// Facets between a curved simplex and any other cell.
void compare_facets(const Checked& c, const mesh::CellMaps& maps, MapReport& report) {
    const Mesh& mesh = c.mesh;
    const std::vector<Mesh::Index> wholes = mesh::whole_of_parts(mesh);
    const auto curved = [&](Mesh::Index cell) {
        const auto i = static_cast<std::size_t>(cell);
        return CurvedCell(mesh, maps, i, wholes.empty() ? cell : wholes[i]);
    };
    in_blocks(
        mesh.cell_count(), 1024, MapReport{},
        [&](std::size_t first, std::size_t last, MapReport& part) {
            for (auto cell = static_cast<Mesh::Index>(first); cell < static_cast<Mesh::Index>(last); ++cell) {
                const CurvedCell own = curved(cell);
                if (own.reference == nullptr) continue;
                for (std::size_t i = 0; i < mesh.corners(); ++i) {
                    const Mesh::Index other = c.neighbours[mesh.corners() * static_cast<std::size_t>(cell) + i];
                    if (other < 0) continue;
                    const CurvedCell beyond = curved(other);
                    const bool both = beyond.reference != nullptr;
                    if (both && other < cell) continue;
                    ++part.curved_facets;
                    const double gap = std::max(own.gap(beyond), both ? beyond.gap(own) : 0);
                    if (gap == 0) continue;
                    ++part.split_facets;
                    part.max_gap = std::max(part.max_gap, gap);
                    if (part.split.size() < c.options.examples) part.split.push_back({cell, other});
                }
            }
        },
        [&](const MapReport& part) {
            report.curved_facets += part.curved_facets;
            report.split_facets += part.split_facets;
            report.max_gap = std::max(report.max_gap, part.max_gap);
            report.split.insert(report.split.end(), part.split.begin(), part.split.end());
            report.split.resize(std::min(report.split.size(), c.options.examples));
        });
}

void compare_sides(const Checked& c, const std::vector<std::uint8_t>& products, MapReport& report) {
    const std::vector<Mesh::Index>& parts = c.mesh.shapes.parts;
    const mesh::SidesOfCells sides = mesh::compare_sides(c.mesh, mesh::warped_sides(c.mesh, products));
    report.warped_sides = sides.warped;
    report.split_sides = sides.split.size();
    for (const mesh::SplitSide& side : sides.split) {
        if (report.split_at_sides.size() == c.options.examples) break;
        report.split_at_sides.push_back(
            {parts[static_cast<std::size_t>(side.whole)], parts[static_cast<std::size_t>(side.beyond)]});
    }
}

}  // namespace

std::optional<MapReport> check_maps(const Checked& c) {
    if ((c.mesh.shapes.types.empty() && c.mesh.mid_nodes.empty()) ||
        mesh::inconsistency_of_cells(c.mesh, mesh::FieldValues::any) != nullptr)
        return std::nullopt;
    using iso::JacobianSign;
    const mesh::CellMaps maps(c.mesh, true, c.options.curved == Curved::exact ? Curved::exact : Curved::isoparametric);
    const std::vector<Mesh::Index>& parts = c.mesh.shapes.parts;
    std::vector<std::int8_t> signs(c.mesh.whole_count());
    std::vector<std::uint8_t> mapped(signs.size()), products(signs.size());
    base::parallel_for_each(signs.size(), 256, [&](std::size_t whole) {
        const auto* const reference = maps.reference(whole);
        if (reference == nullptr) return;
        mapped[whole] = 1;
        JacobianSign sign = iso::jacobian_sign(*reference, maps.places(whole));
        // Files have wedges in both orders, and their parts are positive (mesh/pulling.cpp).
        const bool wedge = !c.mesh.shapes.types.empty() && c.mesh.shapes.types[whole] == vtk_wedge;
        if (wedge && sign == JacobianSign::negative) sign = JacobianSign::positive;
        signs[whole] = static_cast<std::int8_t>(sign);
    });
    MapReport report;
    std::vector<std::int8_t>& of_cells = c.report.measures.jacobian;
    of_cells.assign(c.mesh.cell_count(), 0);
    for (std::size_t whole = 0; whole < signs.size(); ++whole) {
        const auto first = parts.empty() ? whole : static_cast<std::size_t>(parts[whole]);
        const auto last = parts.empty() ? whole + 1 : static_cast<std::size_t>(parts[whole + 1]);
        for (std::size_t cell = first; cell < last; ++cell)
            of_cells[cell] = mapped[whole] != 0 ? signs[whole] : c.orientation[cell];
        if (mapped[whole] == 0) continue;
        ++report.cells;
        const auto sign = static_cast<JacobianSign>(signs[whole]);
        ++(sign == JacobianSign::positive   ? report.positive
           : sign == JacobianSign::negative ? report.negative
           : sign == JacobianSign::changes  ? report.changing
                                            : report.unknown);
        const bool good = sign == JacobianSign::positive || sign == JacobianSign::negative;
        products[whole] = good && !maps.reference(whole)->is_simplex() ? 1 : 0;
        if (!good && report.examples.size() < c.options.examples)
            report.examples.push_back(static_cast<Mesh::Index>(first));
    }
    if (std::ranges::find(products, 1) != products.end()) compare_sides(c, products, report);
    if (report.cells != 0 && c.neighbours.size() == c.mesh.cells.size()) compare_facets(c, maps, report);
    return report.cells == 0 ? std::nullopt : std::optional(report);
}

}  // namespace barycert::check

// Values at points outside: at the nearest point of a side, or of a cell's function continued beyond it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/isoparametric/gradient.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/patch.hpp"
#include "core/shape_functions.hpp"
#include "mesh/index/cell_maps.hpp"
#include "mesh/locate/mapped/mapped_cells.hpp"
#include "mesh/locate/mapped/nearest_side.hpp"

namespace barycert::locate {

namespace iso = core::isoparametric;

namespace {

/// Where a corner of a cell stands in its reference cell. The apex of a pyramid is where all r, s with t = 1 are.
std::array<double, 3> reference_corner(iso::Element element, std::size_t corner) {
    constexpr std::array<std::array<double, 3>, 8> cube{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    constexpr std::array<std::array<double, 3>, 6> wedge{
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
    constexpr std::array<std::array<double, 3>, 4> simplex{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    switch (element) {
        case iso::Element::triangle:
        case iso::Element::tetrahedron:
            return simplex[corner];
        case iso::Element::wedge:
            return wedge[corner];
        case iso::Element::pyramid:
            return corner == 4 ? std::array<double, 3>{0.5, 0.5, 1} : cube[corner];
        default:
            return cube[corner];
    }
}

/// Shape functions of a linear patch with the same corners as a side, at its point; about.
std::vector<std::pair<Mesh::Index, double>> weights_of_corners(const PointOnSide& on) {
    std::vector<std::pair<Mesh::Index, double>> out;
    const iso::Patch& patch = on.side.patch;
    const auto [u, v] = on.at.about();
    for (std::size_t n = 0; n < patch.count; ++n) {
        const auto& index = patch.nodes[n].index;
        if (patch.kind == iso::PatchKind::point) {
            out.emplace_back(on.side.nodes[n], 1);
        } else if (patch.kind == iso::PatchKind::square) {
            out.emplace_back(on.side.nodes[n], (index[1] != 0 ? u : 1 - u) * (index[2] != 0 ? v : 1 - v));
        } else {
            for (std::size_t c = 0; c < 3; ++c) {
                if (index[c] == patch.order) out.emplace_back(on.side.nodes[n], c == 0 ? 1 - u - v : c == 1 ? u : v);
            }
        }
    }
    return out;
}

/// The place of the reference cell that is taken to the point on its side; about.
std::array<double, 3> reference_place(const iso::Reference& reference, const mesh::CellMaps::Nodes& nodes,
                                      const PointOnSide& on) {
    const bool pyramid = reference.element == iso::Element::pyramid;
    std::array<double, 3> x{};
    double base = 0, apex = 0;
    for (const auto& [node, weight] : weights_of_corners(on)) {
        const auto corner = static_cast<std::size_t>(std::ranges::find(nodes.all(), node) - nodes.all().begin());
        if (pyramid && corner == 4) {
            apex = weight;
            continue;
        }
        base += weight;
        const std::array<double, 3> at = reference_corner(reference.element, corner);
        for (std::size_t k = 0; k < 3; ++k) x[k] += weight * at[k];
    }
    if (pyramid) {
        for (std::size_t k = 0; k < 2; ++k) x[k] = base > 0 ? x[k] / base : 0.5;
        x[2] = apex;
    }
    return x;
}

/// Unit vectors: component i is the weight of node i.
std::vector<double> unit_values(std::size_t count) {
    std::vector<double> units(count * count);
    for (std::size_t i = 0; i < count; ++i) units[i * count + i] = 1;
    return units;
}

}  // namespace

std::size_t MappedCells::gather(std::span<const Mesh::Index> nodes, const std::vector<const Field*>& fields,
                                Scratch& scratch) {
    scratch.clear();
    for (const Mesh::Index node : nodes) {
        for (const Field* const field : fields) {
            const auto width = static_cast<std::size_t>(field->components);
            const double* const from = field->data.data() + static_cast<std::size_t>(node) * width;
            scratch.insert(scratch.end(), from, from + width);
        }
    }
    return scratch.size() / nodes.size();
}

iso::Evaluated MappedCells::evaluate_on_side(PointOnSide& on, const std::vector<const Field*>& fields, Scratch& scratch,
                                             double* out) const {
    const std::size_t components = gather(std::span(on.side.nodes).first(on.side.patch.count), fields, scratch);
    return on.at.evaluate(scratch.data(), components, out);
}

iso::Evaluated MappedCells::evaluate_beyond(Mesh::Index cell, const PointOnSide& on, const double* point,
                                            const std::vector<const Field*>& fields, Scratch& scratch,
                                            double* out) const {
    const std::size_t own = whole(cell);
    const mesh::CellMaps::Nodes nodes = maps_.nodes(own);
    const iso::Reference& reference = *maps_.reference(own);
    const std::size_t components = gather(nodes.all(), fields, scratch);
    return iso::evaluate_beyond(reference, maps_.places(own), point, reference_place(reference, nodes, on),
                                scratch.data(), components, out);
}

iso::Evaluated MappedCells::gradients_outside(Mesh::Index cell, const PointOnSide& on, const double* point, bool beyond,
                                              const Field& field, double* out) const {
    const std::size_t own = whole(cell);
    const mesh::CellMaps::Nodes nodes = maps_.nodes(own);
    const iso::Reference& reference = *maps_.reference(own);
    const iso::Places places = maps_.places(own);
    const std::array<double, 3> at = reference_place(reference, nodes, on);
    Scratch values;
    const std::size_t components = gather(nodes.all(), {&field}, values);
    if (beyond) {
        const iso::Evaluated found =
            iso::evaluate_gradients_beyond(reference, places, point, at, values.data(), components, out);
        if (found.certainty != iso::Certainty::not_found) return found;
    }
    return iso::gradients_at_place(reference, places, at, values.data(), components, out);
}

mesh::CellMaps::Nodes MappedCells::weights_on_side(PointOnSide& on, double* out) const {
    mesh::CellMaps::Nodes nodes;
    nodes.count = on.side.patch.count;
    std::copy_n(on.side.nodes.begin(), nodes.count, nodes.at.begin());
    on.at.evaluate(unit_values(nodes.count).data(), nodes.count, out);
    return nodes;
}

mesh::CellMaps::Nodes MappedCells::weights_beyond(Mesh::Index cell, PointOnSide& on, const double* point,
                                                  double* out) const {
    const std::size_t own = whole(cell);
    const mesh::CellMaps::Nodes nodes = maps_.nodes(own);
    const iso::Reference& reference = *maps_.reference(own);
    const iso::Evaluated found =
        iso::evaluate_beyond(reference, maps_.places(own), point, reference_place(reference, nodes, on),
                             unit_values(nodes.count).data(), nodes.count, out);
    return found.certainty == iso::Certainty::not_found ? weights_on_side(on, out) : nodes;
}

}  // namespace barycert::locate

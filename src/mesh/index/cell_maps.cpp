#include "mesh/index/cell_maps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "barycert/mesh.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/mid_edges.hpp"

namespace barycert::mesh {

namespace iso = core::isoparametric;

CellMaps::CellMaps(const Mesh& mesh, bool products, Curved curved)
    : mesh_(mesh), products_(products), curves_(curved != Curved::straight) {
    if (curves_ && !mesh.mid_nodes.empty()) curved_cells(mesh, &curved_, curved == Curved::exact);
}

const iso::Reference* CellMaps::reference(std::size_t whole) const {
    if (!has_shapes())
        return curved_edges(whole) == 0 ? nullptr
                                        : iso::simplex_reference(mesh_.dimension, mesh_.dimension == 3 ? 10 : 6);
    const std::uint8_t type = mesh_.shapes.types[whole];
    if (!is_curved_simplex(type)) return products_ ? iso::linear_reference(type) : nullptr;
    return curves_ ? iso::simplex_reference(mesh_.dimension, mesh_.shapes.nodes_of(whole).size()) : nullptr;
}

/// VTK numbers the nodes of pixels and voxels row by row, those of the others round each layer.
CellMaps::Nodes CellMaps::nodes(std::size_t whole) const {
    Nodes nodes;
    const auto add = [&](std::span<const Mesh::Index> some) {
        std::ranges::copy(some, nodes.at.begin() + static_cast<std::ptrdiff_t>(nodes.count));
        nodes.count += some.size();
    };
    if (has_shapes()) {
        add(mesh_.shapes.nodes_of(whole));
        if (const std::uint8_t type = mesh_.shapes.types[whole]; numbered_round(type) != type) {
            std::swap(nodes.at[2], nodes.at[3]);
            std::swap(nodes.at[6], nodes.at[7]);
        }
    } else {
        const std::size_t mids = mesh_.mid_nodes.size() / std::max<std::size_t>(mesh_.cell_count(), 1);
        add(mesh_.corners_of(whole));
        if (mids != 0) add({&mesh_.mid_nodes[whole * mids], mids});
    }
    return nodes;
}

iso::Places CellMaps::places(std::size_t whole) const {
    iso::Places places;
    const Nodes nodes = this->nodes(whole);
    for (std::size_t i = 0; i < nodes.count; ++i) places.at[i] = mesh_.point(nodes.at[i]);
    const auto edges = edges_of(mesh_.dimension);
    for (std::size_t e = 0; !has_shapes() && e < edges.size(); ++e) {
        if ((curved_edges(whole) >> e & 1U) != 0) continue;
        places.at[mesh_.corners() + e] = mesh_.point(nodes.at[edges[e][0]]);
        places.other[mesh_.corners() + e] = mesh_.point(nodes.at[edges[e][1]]);
    }
    return places;
}

}  // namespace barycert::mesh

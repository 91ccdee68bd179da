/// Facets of cells with maps, their edges and vertices, as patches (core/isoparametric/patch.hpp).
///
/// A side does not depend on the cell that it is taken from: its corners are in the order of their numbers, so its
/// parameters and all that is computed from them are the same bits from every cell.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/patch.hpp"
#include "core/shape_functions.hpp"
#include "mesh/index/cell_maps.hpp"

namespace barycert::locate {

struct Side {
    core::isoparametric::Patch patch;
    std::array<Mesh::Index, core::isoparametric::patch_nodes> nodes{};  ///< of the patch

    /// Both have the same kind and the same nodes.
    bool same(const Side& other) const {
        return patch.kind == other.patch.kind && patch.count == other.patch.count &&
               std::equal(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(patch.count), other.nodes.begin());
    }
    /// Its corners, ascending, and how many; the others are -1.
    std::array<Mesh::Index, 4> corners() const;
    /// Brings nodes into one order. The last step of making one.
    void arrange();
    void add(Mesh::Index node, const core::isoparametric::PatchNode& at) {
        nodes[patch.count] = node;
        patch.add(at);
    }
};

/// The sides of a whole cell that has a map.
class CellSides {
public:
    CellSides(const mesh::CellMaps& maps, std::size_t whole, int dimension, std::uint8_t type);

    std::size_t facets() const;
    Side facet(std::size_t i) const;
    /// 1 or -1 as the facet's corners in their order run around it, seen from outside of a cell with positive Jacobian:
    /// two cells at a facet are on both sides of it if these signs, times those of their Jacobians, differ.
    int turn(std::size_t i) const;

private:
    /// Corners of the facet in turn, as seen from outside.
    std::array<std::size_t, 4> ring(std::size_t i, std::size_t& count) const;

    const core::isoparametric::Reference& reference_;
    mesh::CellMaps::Nodes nodes_;
    core::isoparametric::Places places_;
    std::size_t dimension_;
    std::uint8_t type_;
};

/// Edges of a facet in space; the two ends of a curve; the corners of any.
std::vector<Side> edges_of_side(const Side& side);
std::vector<Side> vertices_of_side(const Side& side);

/// The straight side with these nodes: a vertex, an edge, or a triangle.
Side straight_side(std::span<const Mesh::Index> nodes, const Mesh& mesh);

}  // namespace barycert::locate

/// Which cells are images of reference cells, and by which nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"

namespace barycert::mesh {

/// A cell as users know it is here a whole one: a shape, or else a cell.
class CellMaps {
public:
    /// `products`: of hexahedra, voxels, wedges, pyramids, quadrilaterals and pixels among Mesh::shapes. Unless
    /// `curved` is straight, of simplices of order 2 to 4 there, and of cells with mid-edge nodes off the middle by a
    /// curve; all of them count as such if it is exact.
    CellMaps(const Mesh& mesh, bool products, Curved curved);

    struct Nodes {
        std::array<Mesh::Index, core::isoparametric::max_nodes> at{};
        std::size_t count = 0;
        std::span<const Mesh::Index> all() const { return {at.data(), count}; }
    };

    /// nullptr: the cell is straight, or its parts. Whether the map is injective is another question.
    const core::isoparametric::Reference* reference(std::size_t whole) const;
    /// In the order of the reference cell; of a simplex of order 2 with its mid-edge nodes.
    Nodes nodes(std::size_t whole) const;
    core::isoparametric::Places places(std::size_t whole) const;
    /// A bit for each edge of a second-order cell that is curved; 0 of shapes.
    unsigned curved_edges(std::size_t whole) const { return curved_.empty() ? 0 : curved_[whole]; }

private:
    bool has_shapes() const { return !mesh_.shapes.types.empty(); }

    const Mesh& mesh_;
    bool products_, curves_;
    std::vector<std::uint8_t> curved_;
};

}  // namespace barycert::mesh

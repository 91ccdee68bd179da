/// Facets of cells with maps on which the nearest point of a mesh may lie.
///
/// The nearest point of all cells to a point outside lies on the boundary of their union. A facet that two cells have,
/// node by node, and that lie on both sides of it, is left out. A point of the boundary is on some other one: were all
/// facets at a point of this kind, the cells at it would close up around it, and as their Jacobians have one sign (the
/// degree of the map is not 0 anywhere around), they would fill its surroundings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/base/lists.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_maps.hpp"
#include "mesh/locate/mapped/cell_sides.hpp"

namespace barycert::locate {

class MapBoundary {
public:
    struct Facet {
        Mesh::Index whole;
        std::uint8_t number;
    };
    /// Groups of facets, or of groups, in preorder; the right child of an inner one.
    struct Group {
        index::Box box;
        std::uint32_t first = 0;  ///< facet, or the right child
        std::uint32_t count = 0;  ///< facets; 0 of an inner group
    };

    /// `signs`: of the Jacobian of each whole cell, 0 of those without a map. All must stay.
    MapBoundary(const Mesh& mesh, const mesh::CellMaps& maps, const std::vector<std::int8_t>& signs);

    const std::vector<Group>& groups() const { return groups_; }
    const Facet& facet(std::size_t i) const { return facets_[i]; }
    Side side(const Facet& facet) const { return sides(facet.whole).facet(facet.number); }
    /// The lowest whole cell that has the side: as its vertex, edge or facet.
    Mesh::Index lowest_with(const Side& side) const;
    std::size_t bytes() const {
        return facets_.size() * sizeof(Facet) + groups_.size() * sizeof(Group) + at_node_.bytes();
    }

private:
    CellSides sides(Mesh::Index whole) const;
    bool has(Mesh::Index whole, const Side& side) const;
    void find_facets();
    void group(std::size_t first, std::size_t last, std::vector<index::Box>& boxes, std::vector<std::uint32_t>& order);

    const Mesh& mesh_;
    const mesh::CellMaps& maps_;
    const std::vector<std::int8_t>& signs_;
    std::vector<Facet> facets_;
    std::vector<Group> groups_;
    base::Lists<Mesh::Index> at_node_;  ///< whole cells at each corner of these facets
};

}  // namespace barycert::locate

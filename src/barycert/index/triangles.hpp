/// Triangles in space in the order of a curve, nodes at one place as one.
#pragma once

#include "barycert/index/cell_index.hpp"
#include "barycert/index/facet_contact.hpp"
#include "barycert/index/ridges.hpp"

namespace barycert::index {

struct Triangles {
    CellIndex index;
    std::vector<Mesh::Index> degenerate;  ///< without an area: left out of all else; ascending

    // Of each place:
    std::vector<PlacedFacet> facets;  ///< nodes by their places, ascending: of those at one place the first
    std::vector<std::uint8_t> odd;    ///< its nodes in that order turn it round

    std::vector<Place> same;  ///< of each place of a node: the first at that place
    bool joined = false;      ///< some are at one place

    std::size_t size() const { return facets.size(); }
    /// Of the triangle as given.
    Mesh::Index number(std::size_t place) const { return index.original[place]; }
    Mesh::Index node(Mesh::Index place) const { return index.original_node[static_cast<std::size_t>(place)]; }
    std::array<Mesh::Index, 3> nodes(std::size_t place) const {
        const auto& n = facets[place].nodes;
        return {node(n[0]), node(n[1]), node(n[2])};
    }
    /// Corners as they were given, but for where they begin.
    std::array<const double*, 3> turned(std::size_t place) const {
        const auto& at = facets[place].at;
        return odd[place] != 0 ? std::array{at[1], at[0], at[2]} : at;
    }
    /// The triangle goes along the edge from its lower place to its higher one.
    bool ascends(const Ridge& edge) const { return (edge.other == 1) == (odd[edge.facet] != 0); }
    std::size_t bytes() const {
        return index.bytes() + size() * (sizeof(PlacedFacet) + 1) + same.size() * sizeof(Place);
    }
};

/// `corners` of `numbers`: three each. Preconditions: they are points, which are finite. Uses the threads of the
/// calling arena.
Triangles place_triangles(std::span<const double> points, std::span<const Mesh::Index> corners,
                          std::span<const Mesh::Index> numbers);

}  // namespace barycert::index

/// Triangles in space in the order of a curve, nodes at one place as one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/base/disjoint_sets.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/ridges.hpp"

namespace barycert::index {

struct Triangles {
    CellIndex index;
    std::vector<Mesh::Index> degenerate;  ///< without an area; ascending

    // For each place:
    std::vector<PlacedFacet> facets;  ///< nodes by their places, ascending: of those at one place the first
    std::vector<std::uint8_t> odd;    ///< its nodes in that order turn it round
    std::vector<std::uint8_t> flat;   ///< it has no area; empty if none does, or these are left out

    std::vector<Place> same;  ///< of each place of a node: the first at that place
    bool joined = false;      ///< some are at one place

    std::size_t size() const { return facets.size(); }
    bool is_flat(std::size_t place) const { return !flat.empty() && flat[place] != 0; }
    /// Numbers as they were given: of a triangle by its place, of a node by its place.
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
        return index.bytes() + size() * (sizeof(PlacedFacet) + 1) + flat.size() + same.size() * sizeof(Place);
    }
};

/// Rule for triangles without an area.
enum class Flat : std::uint8_t { left_out, kept };

/// `corners` of `numbers`: three each. Requires: they are points, which are finite. Uses the threads of the
/// calling arena.
Triangles place_triangles(std::span<const double> points, std::span<const Mesh::Index> corners,
                          std::span<const Mesh::Index> numbers, Flat of_flat = Flat::left_out);

/// Joins the sides of triangles that look into one part of space at an edge: side 2 f is where the normal of facet f
/// points, side 2 f + 1 the other one. `ring`: the ridges of the edge as RidgeTurn sorts them.
void join_sides(const Triangles& triangles, std::span<const Ridge> ring, base::DisjointSets& sides);

}  // namespace barycert::index

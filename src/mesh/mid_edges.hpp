/// In which order a file lists the mid-edge nodes of its second-order cells.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "barycert/mesh.hpp"

namespace barycert::mesh {

/// The corners of each edge, in the order `vtk`: 6 edges of a tetrahedron or 3 of a triangle.
std::span<const std::array<std::size_t, 2>> edges_of(int dimension);

/// Which edge (of edges_of) the k-th node of a cell in that order stands on. Requires: the order exists in that
/// dimension; otherwise the span is empty.
std::span<const std::size_t> edge_sequence(MidEdgeOrder order, int dimension);

struct MidEdgeVote {
    MidEdgeOrder order;
    bool guessed;  ///< no cell tells it
};

/// The order in which mesh.mid_nodes stand, told by the points: each cell votes for the order in which every node is
/// nearest to the midpoint of its own edge. It abstains where two are equally near (degenerate cells). Nothing if no
/// order has more than half of them; TetGen's or Triangle's, as a guess, if no cell votes.
std::optional<MidEdgeVote> detect_mid_edge_order(const Mesh& mesh);

/// Brings mesh.mid_nodes from mesh.mid_edge_order into the order `vtk`.
void normalise_mid_nodes(Mesh& mesh);

}  // namespace barycert::mesh

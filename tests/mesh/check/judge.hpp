/// Is a mesh a simplicial complex? The slow twin of check_mesh: every pair of cells is intersected as half-spaces, in
/// exact integers, and every extreme point of what they have in common is looked at. Shares nothing with src.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::testing {

/// The common part of two closed cells.
struct Meeting {
    int dimension = -1;          ///< of it; -1: nothing
    bool in_common_face = true;  ///< all of it lies in the convex hull of their common nodes
};

struct Judgement {
    bool complex = true;  ///< cells proper and distinct, and any two meet in the hull of their common nodes
    std::vector<std::array<Mesh::Index, 2>> overlaps;  ///< pairs of proper cells whose interiors meet, ascending
    std::size_t degenerate = 0;                        ///< cells of zero volume, whose nodes are different and finite
};

/// Any mesh with whole nodes and cells. Cells before `first` are taken for a complex: they are not looked at among
/// themselves.
Judgement judge(const Mesh& mesh, std::size_t first = 0);

/// Requires: two cells with different nodes, finite and not flat.
Meeting meeting(const Mesh& mesh, Mesh::Index a, Mesh::Index b);

}  // namespace barycert::testing

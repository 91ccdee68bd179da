/// Meshes of the unit cube of any size, for measuring how times grow with it.
#pragma once

#include <cstdint>

#include "barycert/mesh.hpp"

namespace barycert::bench {

/// n^3 lattice cubes of six tetrahedra each (Kuhn's subdivision), all of positive volume; inner nodes moved by up to
/// 0.15 / n along each axis; nodes and cells in random order.
///
/// It is a partition of the cube. The edges of such a cell along a path of lattice axes are e_k + d_k, in units of 1/n,
/// where e_k are unit vectors in some order and |d_k| <= 0.3 a coordinate: the matrix is diagonally dominant, 1 - 0.3 >
/// 0.3 + 0.3, while the nodes move, so no cell folds over; the boundary stays where it is. (Rounding moves nodes by
/// some 2^-53, which is nothing beside the 0.1 / n to spare.) Nobody needs to believe this: the meshes are checked.
/// Precondition: 1 <= n <= 700, so that indices fit.
Mesh jittered_cube(int n, std::uint64_t seed);

}  // namespace barycert::bench

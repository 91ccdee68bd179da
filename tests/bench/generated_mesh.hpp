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
/// Requires: 1 <= n <= 700, so that indices fit.
Mesh jittered_cube(int n, std::uint64_t seed);

/// Cells into which n^3 lattice cubes are cut. All fit together: a face of four nodes is one on both of its sides.
enum class CubeCells : std::uint8_t {
    hexahedra,
    wedges,    ///< two a cube, their triangles below and above
    pyramids,  ///< six a cube, around a node in its middle
    /// From below, in layers that grow higher: a quarter of wedges; a quarter of cubes with a node in the middle, over
    /// whose sides are pyramids, or two tetrahedra where wedges have their triangles; hexahedra.
    mixed,
};
/// Cut into simplices. Inner nodes are moved by up to `warp` / n along each axis, and so sides of four nodes are not
/// flat. `shuffled`: nodes and cells in random order, else along the lattice. The same precondition; warp <= 0.15.
Mesh shaped_cube(CubeCells what, int n, double warp, bool shuffled, std::uint64_t seed);

/// jittered_cube with nodes at mid-edges, where x > 1/2 moved smoothly, by up to `bend` / n a coordinate, on the
/// boundary of the cube within it: about half of the cells are curved. Corners are rounded to multiples of 2^-30, so
/// that the others are exactly in the middle: to nobody's definition does rounding matter.
Mesh curved_cube(int n, double bend, std::uint64_t seed);

}  // namespace barycert::bench

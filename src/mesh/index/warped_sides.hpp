/// Sides of four nodes that are not in one plane, of cells whose maps are products: pieces of hyperbolic paraboloids.
///
/// Two such cells with the same four nodes, in the same order round, have the same surface there. Any other cell beyond
/// has another one: two triangles, say, along either diagonal. Then cells overlap, or leave a gap, or both.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::mesh {

/// Returns, for each cell, whole as users know it, a bit for each of its sides of four nodes, in the order of
/// rings_of(), that is warped: not flat. `has_map`: 0 where the cell is taken as its parts, or its map is no product.
std::vector<std::uint8_t> warped_sides(const Mesh& mesh, std::span<const std::uint8_t> has_map);

/// A warped side, and the lowest cell beyond it that has another surface there; both are wholes.
struct SplitSide {
    Mesh::Index whole = -1, beyond = -1;
    std::array<Mesh::Index, 4> ring{};
};

struct SidesOfCells {
    std::uint64_t warped = 0;  ///< one in two cells counts once
    std::vector<SplitSide> split;
};
SidesOfCells compare_sides(const Mesh& mesh, std::span<const std::uint8_t> warped);

}  // namespace barycert::mesh

/// Which cells have others in their interiors?
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "barycert/index/candidates.hpp"
#include "barycert/index/cell_tree.hpp"

namespace barycert::index {

/// A cell as an item of candidates.hpp, its nodes by place.
Item item_of(const CellIndex& index, Place cell);

/// So many cells or facets at a node that it is not asked for all pairs of them (candidates.hpp).
inline constexpr std::size_t crowd = 256;

/// A node of more than `crowd` cells exists.
bool is_crowded(const CellIndex& index);

/// 1 for each of the cells `asked` whose interior meets that of another cell. Those that are degenerate (ascending) are
/// not looked at. On the threads of the calling arena.
std::vector<std::uint8_t> find_overlapped(const CellIndex& index, std::span<const Place> asked,
                                          std::span<const Place> degenerate,
                                          const std::function<const CellTree&()>& tree);

}  // namespace barycert::index

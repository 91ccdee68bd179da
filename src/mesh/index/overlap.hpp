/// Do the interiors of two cells meet? Exactly, by separating planes. Which cells have others in their interiors?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/index/candidates.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"

namespace barycert::index {

/// A cell that is not degenerate: d + 1 corners. Common ones need not be at the same address, but are told faster so.
using Corners = std::array<const double*, 4>;

/// False if a facet of one cell separates the interiors of both. May be true where they are disjoint.
bool may_overlap(int d, const Corners& a, const Corners& b);

/// True if the interiors have a point in common. Requires: not degenerate, coordinates finite.
bool interiors_meet(int d, const Corners& a, const Corners& b);

/// A cell as an item of candidates.hpp, its nodes by place.
Item item_of(const CellIndex& index, Place cell);

/// Which of an item and a cell a pair of them settles.
enum class Decided : std::uint8_t { nothing, item, cell };

/// use(i, cell) for each item i and each cell that may have a point in common with it beside the face of their common
/// nodes. Fewer items than `few` are looked up in the tree of all cells. If they are more, or if there is a node around
/// which the boxes of too many cells meet, all cells are looked up among them; then cells that have all nodes of an
/// item may be left out, and it returns false. `use` may be called again for what is decided: that ends the search
/// around the item (few) or the cell (many) alone. On the threads of the calling arena.
bool for_each_near_cell(const CellIndex& index, std::span<const Item> items, std::size_t few,
                        const std::function<const CellTree&()>& tree,
                        const std::function<Decided(std::size_t, Place)>& use);

/// 1 for each of the cells `asked` whose interior meets that of another cell. Cells that are degenerate (ascending) are
/// not looked at. On the threads of the calling arena.
std::vector<std::uint8_t> find_overlapped(const CellIndex& index, std::span<const Place> asked,
                                          std::span<const Place> degenerate,
                                          const std::function<const CellTree&()>& tree);

}  // namespace barycert::index

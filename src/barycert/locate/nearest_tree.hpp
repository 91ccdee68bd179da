/// Boxes of cells in doubles, to find the nearest cell from anywhere.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "barycert/locate/names.hpp"

namespace barycert::locate {

/// Closed; its numbers are coordinates of nodes, unrounded. So the point of a box that is nearest to a point has exact
/// coordinates, those of one or the other. In 2D the third axis is 0.
struct ExactBox {
    std::array<double, 3> low, high;

    void add(const std::array<double, 3>& p);
    void add(const ExactBox& b);
    std::array<double, 3> nearest(const std::array<double, 3>& p) const;
};

/// Boxes of eight neighbouring cells each, in the order of the index, then of eight such boxes, up to one. Those of the
/// cells themselves are made when they are asked for: 7 bytes a cell in all. The whole numbers of CellTree would not
/// do: from far away, a difference of 2^-31 of the mesh in depth outweighs all that distinguishes cells sideways.
class NearestTree {
public:
    static constexpr std::size_t fan = 8;

    /// Precondition: there is a cell. Time O(cells).
    explicit NearestTree(const CellIndex& index);

    std::size_t levels() const { return begin_.size() - 1; }
    /// Of a level, the least one 0.
    std::size_t count(std::size_t level) const { return begin_[level + 1] - begin_[level]; }
    const ExactBox& box(std::size_t level, std::size_t i) const { return boxes_[begin_[level] + i]; }
    std::size_t bytes() const { return boxes_.size() * sizeof(ExactBox); }

private:
    std::vector<std::size_t> begin_;
    std::vector<ExactBox> boxes_;
};

ExactBox box_of_cell(const CellIndex& index, std::size_t cell);

}  // namespace barycert::locate

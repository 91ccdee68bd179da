/// Points of a block in an order in which near ones follow each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/index/cell_index.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/names.hpp"
#include "mesh/locate/occupancy.hpp"

namespace barycert::locate {

/// A block of points in the order of the bins, near ones side by side. Keeps its memory from block to block.
class SortedPoints {
public:
    /// d coordinates a point. Sorted by the first bits of their bins alone: what lies together in one of those fits the
    /// nearest caches. Points that find_bins knows to be outside are left out. Returns whether all coordinates are
    /// finite. The points must stay where they are.
    bool sort(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points);

    /// How many are left, and how many not.
    std::size_t size() const { return size_; }
    std::size_t left_out() const { return count_ - size_; }
    /// Point i in the order of the caller.
    const double* point(std::size_t i) const { return points_.data() + d_ * i; }
    PointRecord record(std::size_t i, std::size_t number) const {
        const double* const from = point(i);
        return {{from[0], from[1], d_ == 3 ? from[d_ - 1] : 0}, static_cast<std::uint32_t>(number)};
    }
    struct Entry {
        std::uint32_t number;  ///< in the order of the caller
        std::uint32_t bin;
    };
    /// By place in this order.
    const Entry* entries() const { return order_.data(); }
    /// Sorts the points of places [first, first + count). The number of each is its place.
    void copy(std::size_t first, std::size_t count, PointRecord* to) const;

    /// use(i, place of point i in this order) for every point, in the order of the caller; the place of a point left
    /// out is size(). Results are written in this order and read in that one: reading at random can be asked for ahead,
    /// by ahead(place); writing cannot.
    template <class Ahead, class Use>
    void for_each_in_callers_order(Ahead ahead, Use use) const {
        constexpr std::size_t distance = 16;
        for (std::size_t i = 0; i < count_; ++i) {
            if (i + distance < count_) ahead(place_[i + distance]);
            use(i, place_[i]);
        }
    }

private:
    std::span<const double> points_;
    std::size_t d_ = 3, count_ = 0, size_ = 0;
    Buffer<Entry> order_;
    std::vector<std::uint32_t> next_;
    Buffer<std::uint32_t> place_;  ///< of each point, in the order of the caller; before that, its bin
};

}  // namespace barycert::locate

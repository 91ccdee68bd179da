/// Points in the order of the bins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/index/bins.hpp"
#include "barycert/index/buffer.hpp"
#include "barycert/locate/names.hpp"
#include "barycert/locate/walk_lanes.hpp"

namespace barycert::locate {

/// A block of points, near ones side by side. Keeps its memory from block to block.
class SortedPoints {
public:
    /// d coordinates a point, all finite. Sorted by the first bits of their bins alone: what lies together in one of
    /// those fits the nearest caches.
    void sort(std::size_t d, const Bins& bins, std::span<const double> points);

    std::size_t size() const { return size_; }
    /// The number of each record is its own place in this order.
    const PointRecord* data() const { return records_.data(); }

    /// use(i, place of point i in this order) for every point, in the order of the caller. Results are written in this
    /// order and read in that one: reading at random can be asked for ahead, by ahead(place); writing cannot.
    template <class Ahead, class Use>
    void for_each_in_callers_order(Ahead ahead, Use use) const {
        constexpr std::size_t distance = 16;
        for (std::size_t i = 0; i < size_; ++i) {
            if (i + distance < size_) ahead(place_[i + distance]);
            use(i, place_[i]);
        }
    }

private:
    Buffer<PointRecord> records_;
    std::size_t size_ = 0;
    std::vector<std::uint32_t> bin_, next_;
    std::vector<std::uint32_t> place_;  ///< of each point, in the order of the caller
};

}  // namespace barycert::locate

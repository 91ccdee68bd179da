/// Internal: points in the order of the bins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/locate/bins.hpp"
#include "barycert/locate/buffer.hpp"
#include "barycert/locate/walk_lanes.hpp"

namespace barycert::detail {

/// A block of points, near ones side by side. Keeps its memory from block to block.
class SortedPoints {
public:
    /// d coordinates a point, all finite. Sorted by the first bits of their bins alone: what lies together in one of
    /// those fits the nearest caches.
    void sort(std::size_t d, const Bins& bins, std::span<const double> points);

    std::size_t size() const { return size_; }
    const PointRecord* data() const { return records_.data(); }

private:
    Buffer<PointRecord> records_;
    std::size_t size_ = 0;
    std::vector<std::uint32_t> bin_, next_;
};

}  // namespace barycert::detail

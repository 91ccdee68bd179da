#include "mesh/locate/sorted_points.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "mesh/index/cell_index.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/occupancy.hpp"

namespace barycert::locate {

bool SortedPoints::sort(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points) {
    points_ = points;
    d_ = index.dimension();
    count_ = points.size() / d_;
    if (place_.size() < count_) {
        place_ = Buffer<std::uint32_t>(count_);
        order_ = Buffer<Entry>(count_ + 1);
    }
    constexpr int max_bits = 12;
    const int shift = std::max(0, index.bins.bits() - max_bits);
    // The last one is for points that are left out.
    const auto last = static_cast<std::uint32_t>(index.bins.count() >> shift);
    next_.assign(last + 1, 0);
    bool finite = true;
    constexpr std::size_t at_once = 2048;
    for (std::size_t at = 0; at < count_; at += at_once) {
        const std::size_t n = std::min(at_once, count_ - at);
        finite &= find_bins(index, occupancy, points.subspan(d_ * at, d_ * n), place_.data() + at);
        for (std::size_t i = at; i < at + n; ++i) ++next_[std::min(place_[i] >> shift, last)];
    }
    std::exclusive_scan(next_.begin(), next_.end(), next_.begin(), 0U);
    size_ = next_[last];
    for (std::size_t i = 0; i < count_; ++i) {
        const std::uint32_t bin = place_[i], stream = std::min(bin >> shift, last), at = next_[stream];
        next_[stream] += stream != last ? 1 : 0;
        order_[at] = {static_cast<std::uint32_t>(i), bin};
        place_[i] = at;
    }
    return finite;
}

void SortedPoints::copy(std::size_t first, std::size_t count, PointRecord* to) const {
    for (std::size_t i = 0; i < count; ++i) to[i] = record(order_[first + i].number, first + i);
}

}  // namespace barycert::locate

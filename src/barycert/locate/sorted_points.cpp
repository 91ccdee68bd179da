#include "barycert/locate/sorted_points.hpp"

#include <algorithm>
#include <utility>

namespace barycert::locate {
namespace {

constexpr int max_bits = 10;

template <std::size_t d>
void place(std::span<const double> points, const std::vector<std::uint32_t>& bin, int shift,
           std::vector<std::uint32_t>& next, PointRecord* records, std::uint32_t* places) {
    for (std::size_t i = 0; i < bin.size(); ++i) {
        const std::uint32_t at = places[i] = next[bin[i] >> shift]++;
        PointRecord& to = records[at];
        const double* const from = points.data() + d * i;
        to.at = {from[0], from[1], d == 3 ? from[d - 1] : 0};
        to.number = at;
        to.bin = bin[i];
    }
}

}  // namespace

void SortedPoints::sort(std::size_t d, const Bins& bins, std::span<const double> points) {
    size_ = points.size() / d;
    if (records_.size() < size_) records_ = Buffer<PointRecord>(size_);
    const int shift = std::max(0, bins.bits() - max_bits);
    bin_.resize(size_);
    next_.assign(bins.count() >> shift, 0);
    for (std::size_t i = 0; i < size_; ++i) {
        bin_[i] = bins.of(points.data() + d * i);
        ++next_[bin_[i] >> shift];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& n : next_) sum += std::exchange(n, sum);
    place_.resize(size_);
    d == 2 ? place<2>(points, bin_, shift, next_, records_.data(), place_.data())
           : place<3>(points, bin_, shift, next_, records_.data(), place_.data());
}

}  // namespace barycert::locate

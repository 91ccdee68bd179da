#include "mesh/index/bins.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace barycert::index {

std::vector<std::size_t> halved_axes(std::size_t d, const double* low, const double* high, std::size_t bins) {
    constexpr std::size_t max = std::size_t{1} << 27;
    const auto wanted = static_cast<std::size_t>(std::bit_width(std::min(bins, max) | 1)) - 1;

    // No axis gets more than its table should hold.
    constexpr int max_of_axis = 20;
    std::array<double, 3> side{-1, -1, -1};
    for (std::size_t k = 0; k < d; ++k) side[k] = high[k] * 0.5 - low[k] * 0.5;
    std::vector<std::size_t> axes;
    std::array<int, 3> given{};
    while (axes.size() < wanted) {
        const auto longest = static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
        if (side[longest] < 0) break;
        axes.push_back(longest);
        side[longest] = ++given[longest] < max_of_axis ? side[longest] * 0.5 : -1;
    }
    return axes;
}

Bins::Bins(std::size_t d, const double* low, const double* high, std::size_t bins) : quantizer_(d, low, high), d_(d) {
    // The axis of each bit of a bin, from the highest down.
    const std::vector<std::size_t> axes = halved_axes(d, low, high, bins);
    std::array<int, 3> given{};
    for (const std::size_t axis : axes) ++given[axis];
    bits_ = static_cast<int>(axes.size());
    for (std::size_t k = 0; k < d; ++k) {
        shift_[k] = Quantizer::bits - given[k];
        curve_[k].resize(std::size_t{1} << given[k]);
        for (std::size_t place = 0; place < curve_[k].size(); ++place) {
            std::uint32_t bin = 0;
            std::size_t left = place;
            for (std::size_t bit = 0; bit < axes.size(); ++bit) {
                if (axes[axes.size() - 1 - bit] != k) continue;
                bin |= static_cast<std::uint32_t>(left & 1) << bit;
                left >>= 1;
            }
            curve_[k][place] = bin;
        }
    }
}

}  // namespace barycert::index

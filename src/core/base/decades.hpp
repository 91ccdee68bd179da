/// Sizes of errors by powers of ten: the bins of histograms.
#pragma once

#include <algorithm>  // IWYU pragma: keep
#include <array>
#include <cstddef>
#include <string>

namespace barycert::base {

/// The upper edges of bins 1 to 20. A power of ten lies in the bin above its edge.
inline constexpr std::array<double, 20> decade_edges{1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8,
                                                     1e-7,  1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  1,     10,   100};

/// Bin 0 is left to those without an error, the last takes all from 100 on.
inline constexpr std::size_t decade_bins = decade_edges.size() + 2;

/// From 1 on. NaN lies in the last.
inline std::size_t decade_bin(double x) {
    const auto* const above = std::ranges::upper_bound(decade_edges, x);
    return 1 + static_cast<std::size_t>(above - decade_edges.begin());
}

/// "< 1e-16", of the last ">= 100". Requires: 1 <= bin < decade_bins.
inline std::string decade_label(std::size_t bin) {
    if (bin > decade_edges.size()) return ">= 100";
    const int exponent = static_cast<int>(bin) - 18, size = exponent < 0 ? -exponent : exponent;
    return std::string("< 1e") + (exponent < 0 ? '-' : '+') + static_cast<char>('0' + size / 10) +
           static_cast<char>('0' + size % 10);
}

}  // namespace barycert::base

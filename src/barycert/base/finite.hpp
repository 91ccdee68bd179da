/// Are all numbers finite?
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace barycert::base {

/// Differences of finite numbers with themselves are zero, all others NaN, and stay that in a sum. Eight sums, for one
/// would wait for each addition.
inline bool all_finite(std::span<const double> numbers) {
    std::array<double, 8> sums{};
    std::size_t i = 0;
    for (; i + 8 <= numbers.size(); i += 8) {
        for (std::size_t k = 0; k < 8; ++k) sums[k] += numbers[i + k] - numbers[i + k];
    }
    for (; i < numbers.size(); ++i) sums[0] += numbers[i] - numbers[i];
    bool finite = true;
    for (const double sum : sums) finite = finite && sum == 0;
    return finite;
}

}  // namespace barycert::base

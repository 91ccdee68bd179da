/// Are all numbers finite?
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "barycert/result.hpp"

namespace barycert::base {

/// x - x is zero of finite numbers, else NaN, and stays that in a sum. Eight sums: one would wait for each addition.
inline bool all_finite(std::span<const double> numbers) {
    std::array<double, 8> sums{};
    std::size_t i = 0;
    for (; i + 8 <= numbers.size(); i += 8) {
        for (std::size_t k = 0; k < 8; ++k) sums[k] += numbers[i + k] - numbers[i + k];
    }
    for (const double x : numbers.subspan(i)) sums[0] += x - x;
    return std::ranges::count(sums, 0.0) == 8;
}

/// The place of the first number that is not finite; numbers.size() if all are.
inline std::size_t first_not_finite(std::span<const double> numbers) {
    const auto bad = std::ranges::find_if(numbers, [](double x) { return !std::isfinite(x); });
    return static_cast<std::size_t>(bad - numbers.begin());
}

/// Returns the error that `what`, which is x, is not finite.
inline Error not_finite(std::string what, double x, std::string remedy = {}) {
    return file_error("argument.not-finite", {}, std::move(what), "a finite number", std::to_string(x),
                      std::move(remedy));
}

}  // namespace barycert::base

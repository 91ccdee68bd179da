/// Counts as bars.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"
#include "draw/axes.hpp"
#include "draw/picture.hpp"

namespace barycert::draw {

/// Bins of one width, from x.low to x.high.
struct Histogram {
    std::string title;  ///< what it is, to a reader who cannot see it
    Axis x;             ///< without pixels
    std::vector<std::uint64_t> counts;
    std::string counted = "cell";                       ///< one of them
    std::function<std::string(std::size_t bin)> range;  ///< "1 to 2"
    std::function<bool(std::size_t bin)> bad = {};      ///< in red
};

/// 520 by 262 pixels. Counts are logarithmic if the smallest is below 1 % of the largest.
Picture histogram(const Histogram& of);

/// Two beside each other, below a title, as file_text. Error: there are none.
Result<std::string> rows_text(std::string_view path, const std::vector<Picture>& all, const std::string& title);

}  // namespace barycert::draw

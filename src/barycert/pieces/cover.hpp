/// Few boxes in place of many.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "barycert/index/box_tree.hpp"

namespace barycert::pieces {

using index::Box;

/// The box that nothing lies in, and which meets none.
inline constexpr Box no_box{{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::infinity()},
                            {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}};

inline bool empty(const Box& box) {
    return !(box.low[0] <= box.high[0]);
}

/// At most `most` boxes, which together cover box_at(0), ..., box_at(count - 1); all of these lie in `around`. In
/// little memory, whatever their number: those whose middles lie near each other become one.
std::vector<Box> cover(const Box& around, std::size_t count, const std::function<Box(std::size_t)>& box_at,
                       std::size_t most);

}  // namespace barycert::pieces

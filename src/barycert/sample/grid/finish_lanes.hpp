/// After the cells have filled in what they can: features of all points, and numbers for those outside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/sample/grid/fill_lanes.hpp"
#include "barycert/table.hpp"

namespace barycert::sample {

struct FinishedPoints {
    LocationCounts locations;  ///< of those below
    std::uint64_t with_value = 0;
    std::uint64_t outside = 0;
    std::vector<std::uint32_t> others;  ///< those without a value, by their numbers, ascending
};

/// Points [first, last) of the target: sets features, and adds to `out`. Those outside get `*outside` for each of their
/// `stride` numbers; if that is nullptr they go to `others`.
void finish_points(const FillTarget& target, std::size_t first, std::size_t last, const double* outside,
                   FinishedPoints& out);

}  // namespace barycert::sample

/// Rows that are looked at again: every cell that contains the point may be the one that a tool took.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/verify.hpp"

namespace barycert::verify {

/// The values of a row by the cell whose largest error is least.
struct BestHolder {
    std::vector<double> values;  ///< one a column
    std::uint64_t cells = 0;     ///< how many contain the point
    bool other = false;          ///< it is not the owner
};

/// For each of the rows `which` of `claimed`, all of them inside. `ranges`: one a column.
Result<std::vector<BestHolder>> best_holders(const Sampler& sampler, const ClaimedRows& claimed,
                                             std::span<const std::size_t> which, std::span<const double> ranges);

}  // namespace barycert::verify

/// One kernel's answer held against the oracle's.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "barycert/audit/finding.hpp"
#include "barycert/exact/oracle.hpp"
#include "barycert/kernels/kernel.hpp"

namespace barycert::audit {

struct Comparison {
    Region claimed = Region::outside;
    std::array<std::uint8_t, finding_count> counts{};  ///< weights, or 1 for a case, per class of finding
    std::array<double, 4> weight_ulps{};               ///< error of each weight in ulps; -1 where there is no measure
    double value_ulp = -1;                             ///< error of the value in ulps; -1 where there is no measure
    double weight_error = 0;                           ///< largest |weight - exact weight|; infinite if not finite

    bool wrong() const {
        for (const auto n : counts) {
            if (n != 0) return true;
        }
        return false;
    }
};

/// There is no measure in ulps where the exact number is zero (a wrong weight is then a false_nonzero), where either
/// is not finite, or where the simplex is degenerate. A kernel that returns the correctly rounded weights, all of them,
/// has no findings, even where they under- or overflow.
Comparison compare(const Kernel& kernel, const Case& c, const exact::Answer& answer, int status,
                   std::span<const double> weights);

}  // namespace barycert::audit

/// One kernel's answer held against the oracle's.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "barycert/audit/finding.hpp"
#include "barycert/exact/oracle.hpp"
#include "barycert/kernels/kernel.hpp"

namespace barycert::audit {

/// What to hand to a kernel: weights that are not an answer.
inline constexpr std::array<double, 4> unset_weights = [] {
    std::array<double, 4> w{};
    w.fill(std::numeric_limits<double>::quiet_NaN());
    return w;
}();

struct Comparison {
    Region claimed = Region::outside;
    std::array<std::uint8_t, finding_count> counts{};  ///< weights, or 1 for a case, per class of finding
    std::array<double, 4> weight_ulps{};               ///< error of each weight in ulps; -1 where there is no measure
    double value_ulp = -1;                             ///< error of the value in ulps; -1 where there is no measure
    /// Largest |weight - exact weight|, infinite if a weight is not finite or none was given; for a missed degenerate
    /// simplex the largest weight.
    double weight_error = 0;

    bool wrong() const {
        for (const auto n : counts) {
            if (n != 0) return true;
        }
        return false;
    }
};

/// There is no measure in ulps where the exact number is zero (a wrong weight is then a false_nonzero), where either
/// is not finite, or where the simplex is degenerate. An exact weight beyond the largest double is measured from there.
/// `claimed` is always what the kernel's weights say; but a kernel whose weights are all correctly rounded has no
/// finding, even where they under- or overflow and so no longer tell the region.
Comparison compare(const Kernel& kernel, const Case& c, const exact::Answer& answer, int status,
                   std::span<const double> weights);

}  // namespace barycert::audit

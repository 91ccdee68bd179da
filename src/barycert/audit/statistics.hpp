/// Running totals of comparisons, of a size that does not depend on their number, and mergeable in any order.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "barycert/audit/comparison.hpp"

namespace barycert::audit {

/// Counts of non-negative numbers by magnitude. Bins are exact for the integers 0 to 16 and eight to an octave above,
/// up to 2^128; larger numbers share the last.
class LogHistogram {
public:
    void add(double x) { ++bins_[bin(x)]; }
    void merge(const LogHistogram& other);
    std::uint64_t total() const;

    /// The least bin edge that at least the given fraction of the numbers do not exceed; -1 if there are none.
    double quantile(double fraction) const;

private:
    static constexpr std::size_t bin_count = 1 + 8 * 128;
    static std::size_t bin(double x);
    static double upper_edge(std::size_t bin);
    std::array<std::uint64_t, bin_count> bins_{};
};

/// The largest value seen and the case it came from; of equal ones the first case, so that order does not matter.
struct Worst {
    double value = -1;
    std::uint64_t index = 0;  ///< of the case in its family

    void include(double v, std::uint64_t i) {
        if (v > value || (v == value && i < index)) *this = {v, i};
    }
};

/// What there is a witness of: every class of finding, then the error of a weight and of the value in ulps.
inline constexpr std::size_t witness_reasons = finding_count + 2;

/// "opposite_sign", ... "worst_weight_ulp", "worst_value_ulp".
constexpr std::string_view reason_name(std::size_t reason) {
    if (reason < finding_count) return finding_texts[reason].name;
    return reason == finding_count ? "worst_weight_ulp" : "worst_value_ulp";
}

struct Statistics {
    std::uint64_t cases = 0;
    std::uint64_t wrong_cases = 0;  ///< with at least one finding
    std::array<std::uint64_t, finding_count> counts{};
    std::array<std::array<std::uint64_t, 4>, 4> confusion{};  ///< [exact region][claimed region]
    LogHistogram weight_ulps;
    LogHistogram value_ulps;
    Worst weight_ulp;
    Worst value_ulp;
    Worst partition_residual;                      ///< |sum of weights - 1|, exact, rounded once
    Worst reproduction_residual;                   ///< |sum of weight * vertex - point|, exact, rounded once
    std::array<Worst, witness_reasons> witnesses;  ///< by Comparison::weight_error, the last two by ulps

    /// 99.9th percentiles: edges of bins, never above the worst; -1 if there is no measure.
    double p999_weight_ulp() const { return std::min(weight_ulps.quantile(0.999), weight_ulp.value); }
    double p999_value_ulp() const { return std::min(value_ulps.quantile(0.999), value_ulp.value); }

    void add(const Comparison& comparison, Region exact, std::uint64_t index);

    /// `index` of the result is the other's where the other is worse: merging different families needs care of that.
    void merge(const Statistics& other);
};

}  // namespace barycert::audit

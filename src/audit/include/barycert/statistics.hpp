/// Statistics of many answers: counts of findings, histograms of errors, the worst cases.
///
/// Example:
///
///     LogHistogram ulps;
///     for (const double error : {0.5, 0.5, 3.0}) ulps.add(error);
///     const double most = ulps.quantile(0.99);
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <vector>

#include "barycert/finding.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

/// How many numbers lie in each bin.
template <std::size_t n>
struct BinCounts {
    static constexpr std::size_t bins = n;
    std::array<std::uint64_t, n> counts{};

    void merge(const BinCounts& other) {
        for (std::size_t i = 0; i < n; ++i) counts[i] += other.counts[i];
    }
    std::uint64_t total() const { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }

    /// The first bin by which at least that many are reached, or the last.
    std::size_t bin_reaching(std::uint64_t wanted) const {
        std::size_t i = 0;
        for (std::uint64_t seen = counts[0]; seen < wanted && i + 1 < n;) seen += counts[++i];
        return i;
    }
};

/// Numbers >= 0 by magnitude. Bins are exact for the integers 0 to 16 and eight to an octave above, up to 2^128; larger
/// numbers share the last.
struct LogHistogram : BinCounts<1 + 8 * 128> {
    void add(double x) { ++counts[bin(x)]; }

    /// The min bin edge that at least the given fraction of the numbers do not exceed; -1 if there are no numbers.
    double quantile(double fraction) const;

private:
    static std::size_t bin(double x);
    static double upper_edge(std::size_t bin);
};

/// The max value and its case, of equal values the first: the order of insertion does not matter.
struct WorstCase {
    double value = -1;
    std::uint64_t index = 0;  ///< of the case in its family

    void include(double v, std::uint64_t i) {
        if (v > value || (v == value && i < index)) *this = {v, i};
    }
};

/// How large errors are, of one number a case: Comparison::relative_error. [0]: no error; [k]: 10^(k-19) <= error <
/// 10^(k-18), [1] all smaller ones, [21] all larger ones; [22]: no finite answer.
struct ErrorSizes : BinCounts<23> {
    WorstCase worst;  ///< of the finite ones

    void add(double error, std::uint64_t index);  ///< below 0: not counted; infinite: no finite answer
    void merge(const ErrorSizes& other);
    std::uint64_t unanswered() const { return counts[bins - 1]; }
    /// The upper edge of the first bin by which at least that share of the cases with a finite answer is reached: 0,
    /// 1e-17, ..., 100, infinity. -1 if there are no such cases.
    double within(double share) const;
};

/// The reasons for a witness: each class of finding, then the error of a weight and of the value in ulps.
inline constexpr std::size_t witness_reasons = finding_count + 2;

/// "opposite_sign", ... "worst_weight_ulp", "worst_value_ulp".
constexpr std::string_view reason_name(std::size_t reason) {
    if (reason < finding_count) return finding_texts[reason].name;
    return reason == finding_count ? "worst_weight_ulp" : "worst_value_ulp";
}

struct KernelStatistics {
    std::uint64_t cases = 0;
    std::uint64_t wrong_cases = 0;  ///< with at least one finding
    std::uint64_t not_run = 0;      ///< cases left out, none of the above: the kernel had failed to answer too often
    std::array<std::uint64_t, finding_count> counts{};
    std::array<std::array<std::uint64_t, 4>, 4> confusion{};  ///< [exact region][claimed region]
    LogHistogram weight_ulps;
    LogHistogram value_ulps;
    ErrorSizes errors;
    WorstCase weight_ulp;
    WorstCase value_ulp;
    WorstCase partition_residual;                      ///< |sum of weights - 1|, exact, rounded once
    WorstCase reproduction_residual;                   ///< |sum of weight * vertex - point|, exact, rounded once
    std::array<WorstCase, witness_reasons> witnesses;  ///< by Comparison::weight_error, the last two by ulps

    /// 99.9th percentiles: edges of bins, at most the worst; -1 if there are no errors to measure.
    double p999_weight_ulp() const { return std::min(weight_ulps.quantile(0.999), weight_ulp.value); }
    double p999_value_ulp() const { return std::min(value_ulps.quantile(0.999), value_ulp.value); }

    void add(const Comparison& comparison, Region exact, std::uint64_t index);

    /// Case indices are kept from either side: they mean nothing after merging different families.
    void merge(const KernelStatistics& other);
};

/// Errors of a kernel by the condition number kappa of the cell, one bit of log2(kappa) a bin. Where nothing under- or
/// overflows, a kernel that works with differences of coordinates has weights within C * 2^-53 * kappa of the exact
/// ones for points of the cell, with a small constant C (weights.hpp).
class Prediction {
public:
    static constexpr int last_bits = 1100;  ///< and more: above the log2 of every double

    struct Bin {
        int bits = 0;  ///< floor(log2(kappa))
        std::uint64_t cases = 0;
        double median = 0;  ///< of the cases' largest errors, in units of 2^-53; the upper edge of half an octave
        double worst = 0;   ///< the largest of them, likewise
    };

    /// One case: kappa >= 1 and the largest |weight - exact weight|, finite.
    void add(double kappa, double error);
    void merge(const Prediction& other);

    std::uint64_t cases() const;

    /// The C that would have held: the max error / (2^-53 kappa) over cases with kappa < 2^47, where the first-order
    /// prediction applies. -1 without such cases.
    double worst_factor() const { return worst_factor_; }

    /// The non-empty bins, ascending.
    std::vector<Bin> bins() const;

private:
    struct ErrorsOfBits {
        double worst = 0;
        std::vector<std::uint64_t> errors;  ///< by magnitude, as long as it takes
    };
    std::vector<ErrorsOfBits> rows_;  ///< by bits, likewise
    double worst_factor_ = -1;
};

}  // namespace barycert

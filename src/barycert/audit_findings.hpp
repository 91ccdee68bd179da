/// What an audit can find wrong with a kernel's answers, and the statistics of many answers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "barycert/simplex.hpp"

namespace barycert {

/// Worst first.
enum class Finding : std::uint8_t {
    crashed,  // per case from here on; the first seven are what a user's kernel does besides answering
    raised,
    hung,
    out_of_bounds,
    forked,
    changed_environment,
    printed,
    false_certificate,
    false_declaration,
    false_inside,
    false_outside,
    missed_degenerate,
    opposite_sign,  // per weight from here on
    false_zero,
    false_nonzero,
    not_finite,
};

inline constexpr std::size_t finding_count = 16;

struct FindingText {
    std::string_view name;
    std::string_view meaning;
};

inline constexpr std::array<FindingText, finding_count> finding_texts{{
    {"crashed", "the kernel's process ended: there is no answer"},
    {"raised", "the kernel, a callable of Python, raised an exception: there is no answer"},
    {"hung", "the kernel gave no answer within the time limit"},
    {"out_of_bounds", "the kernel touched memory beside its arrays, or wrote to its input"},
    {"forked", "the kernel left a process behind that it had started"},
    {"changed_environment", "the kernel came back with another rounding mode, or with subnormal numbers flushed"},
    {"printed", "the kernel wrote to stdout or stderr"},
    {"false_certificate", "the kernel certifies its answers, and this one has a finding or is not correctly rounded"},
    {"false_declaration", "the kernel declares a simplex degenerate that is not"},
    {"false_inside", "the point is outside; the kernel says interior or boundary"},
    {"false_outside", "the point is inside or on the boundary; the kernel says outside"},
    {"missed_degenerate", "the simplex is degenerate; the kernel gives finite weights"},
    {"opposite_sign", "a weight has the sign opposite to the exact one"},
    {"false_zero", "a weight is zero and the exact one is not"},
    {"false_nonzero", "a weight is not zero and the exact one is"},
    {"not_finite", "a weight is NaN or infinite and the simplex is not degenerate"},
}};

constexpr std::string_view name(Finding f) {
    return finding_texts[static_cast<std::size_t>(f)].name;
}

constexpr std::optional<Finding> finding_named(std::string_view text) {
    for (std::size_t i = 0; i < finding_count; ++i) {
        if (finding_texts[i].name == text) return static_cast<Finding>(i);
    }
    return std::nullopt;
}

/// One answer of a kernel, compared with the oracle's.
struct Comparison {
    Region claimed = Region::outside;
    std::array<std::uint8_t, finding_count> counts{};  ///< weights, or 1 for a case, per class of finding
    std::array<double, 4> weight_ulps{};               ///< error of each weight in ulps; -1 if undefined
    double value_ulp = -1;                             ///< error of the value in ulps; -1 if undefined
    /// Max |weight - exact weight|, infinite if a weight is not finite or none was given; for a missed degenerate
    /// simplex the max |weight|.
    double weight_error = 0;
    /// The same relative to 1, or to the largest exact weight where that is more: max |weight - exact weight| / max(1,
    /// max |exact weight|). Infinite if a weight is not finite or none was given; -1 if the simplex is degenerate.
    double relative_error = -1;

    bool wrong() const {
        for (const auto n : counts) {
            if (n != 0) return true;
        }
        return false;
    }
};

/// Counts of non-negative numbers by magnitude. Bins are exact for the integers 0 to 16 and eight to an octave above,
/// up to 2^128; larger numbers share the last.
class LogHistogram {
public:
    void add(double x) { ++bins_[bin(x)]; }
    void merge(const LogHistogram& other);
    std::uint64_t total() const;

    /// The min bin edge that at least the given fraction of the numbers do not exceed; -1 if there are no numbers.
    double quantile(double fraction) const;

private:
    static constexpr std::size_t bin_count = 1 + 8 * 128;
    static std::size_t bin(double x);
    static double upper_edge(std::size_t bin);
    std::array<std::uint64_t, bin_count> bins_{};
};

/// The max value and the case it came from; among equal values the first case, so the order of insertion does not
/// matter.
struct WorstCase {
    double value = -1;
    std::uint64_t index = 0;  ///< of the case in its family

    void include(double v, std::uint64_t i) {
        if (v > value || (v == value && i < index)) *this = {v, i};
    }
};

/// How large errors are, of one number a case: Comparison::relative_error.
struct ErrorSizes {
    static constexpr std::size_t bins = 23;
    /// [0]: no error; [k]: 10^(k-19) <= error < 10^(k-18), [1] all smaller ones, [21] all larger ones; [22]: no finite
    /// answer.
    std::array<std::uint64_t, bins> counts{};
    WorstCase worst;  ///< of the finite ones

    void add(double error, std::uint64_t index);  ///< below 0: not counted; infinite: no finite answer
    void merge(const ErrorSizes& other);
    std::uint64_t total() const;
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

/// The error of a kernel as the condition number kappa of the cell predicts it, beside the error that was measured.
///
/// Where nothing under- or overflows, a kernel that works with differences of coordinates has weights within C * 2^-53
/// * kappa of the exact ones for points of the cell, with a small constant C (condition.hpp). Cases are sorted by
/// log2(kappa), one bit a bin.
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

    /// The max error / (2^-53 kappa) over cases with kappa < 2^47, where the first-order prediction applies: the
    /// constant C that would have held. -1 without such cases.
    double worst_factor() const { return worst_factor_; }

    /// The non-empty bins, ascending.
    std::vector<Bin> bins() const;

private:
    struct Row {
        double worst = 0;
        std::vector<std::uint64_t> errors;  ///< by magnitude, as long as it takes
    };
    std::vector<Row> rows_;  ///< by bits, likewise
    double worst_factor_ = -1;
};

}  // namespace barycert

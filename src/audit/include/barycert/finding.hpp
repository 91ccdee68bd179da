/// Findings: what an audit can find wrong with one answer of a kernel, compared with the oracle's.
///
/// Example:
///
///     const std::optional<Finding> finding = finding_named("false_inside");
///     const std::string_view meaning = finding_texts[static_cast<std::size_t>(*finding)].meaning;
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "barycert/severity.hpp"
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
    std::string_view name, meaning;
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
    const auto at = std::ranges::find(finding_texts, text, &FindingText::name);
    return at == finding_texts.end() ? std::nullopt : std::optional(static_cast<Finding>(at - finding_texts.begin()));
}

/// Returns warning for what a kernel does besides answering and its answer can be right; error for all else.
constexpr Severity severity(Finding finding) {
    const bool beside =
        finding == Finding::forked || finding == Finding::changed_environment || finding == Finding::printed;
    return beside ? Severity::warning : Severity::error;
}

/// One answer of a kernel, compared with the oracle's.
struct Comparison {
    Region claimed = Region::outside;
    std::array<std::uint8_t, finding_count> counts{};  ///< weights, or 1 for a case, per class of finding
    std::array<double, 4> weight_ulps{};               ///< error of each weight in ulps; -1 if undefined
    double value_ulp = -1;                             ///< error of the value in ulps; -1 if undefined
    /// Max |weight - exact weight|, infinite without finite weights; for a missed degenerate simplex the max |weight|.
    double weight_error = 0;
    /// The same over max(1, max |exact weight|); -1 if the simplex is degenerate.
    double relative_error = -1;

    bool wrong() const { return counts != decltype(counts){}; }
    double worst_weight_ulp() const { return *std::max_element(weight_ulps.begin(), weight_ulps.end()); }
};

}  // namespace barycert

/// One step of a search: a case, the exact answer, the kernel's; and how bad it is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "audit/asking.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"

namespace barycert::audit {

struct Evaluation {
    Statement said;  ///< if it did not run, the kernel has been given up, and the members below say nothing of it
    OracleAnswer exact;
    Comparison comparison;
    double relative_error = -1;  ///< relative_error()
    std::string detail;          ///< what the kernel did besides answering, in words; empty if nothing
};

constexpr bool is_finding(std::size_t reason, Finding f) {
    return reason == static_cast<std::size_t>(f);
}

/// max |exact weight|, at least 1 / (number of weights), for they sum up to 1; grows as the cell gets flat. One beyond
/// the largest double is compared as that one. Requires: not degenerate.
inline double largest_weight(const OracleAnswer& exact) {
    double max = 0;
    for (const double w : exact.weights) max = std::max(max, std::fabs(w));
    return std::min(max, 0x1.fffffffffffffp+1023);
}

/// max |weight - exact| / max |exact|; -1 if degenerate, infinite if a weight is not finite or there is none.
inline double relative_error(const OracleAnswer& exact, const Comparison& comparison) {
    return exact.region == Region::degenerate ? -1 : comparison.weight_error / largest_weight(exact);
}

/// Requires: all numbers of the case are finite, depths above zero.
inline Evaluation evaluate(const Kernel& kernel, const Case& c) {
    Evaluation e;
    e.exact = ask_oracle(c);
    e.detail = ask_kernel(kernel, std::span(&c, 1), std::span(&e.said, 1), false).detail;
    e.comparison = compare(kernel, c, e.exact, e.said);
    ExactEnvironment::renew();
    e.relative_error = relative_error(e.exact, e.comparison);
    return e;
}

/// Reasons of witnesses, and the relative error.
inline constexpr std::size_t search_reasons = witness_reasons + 1;

constexpr std::string_view search_reason_name(std::size_t reason) {
    return reason < witness_reasons ? reason_name(reason) : "worst_relative_error";
}

/// Findings that may have cost the kernel its process.
constexpr bool is_accident(std::size_t reason) {
    return reason <= static_cast<std::size_t>(Finding::out_of_bounds);
}

/// Findings of what a kernel in a process of its own did besides answering.
constexpr bool is_incident(std::size_t reason) {
    return reason <= static_cast<std::size_t>(Finding::printed);
}

/// The number of a reason, or search_reasons if there is none of that name.
inline std::size_t search_reason_named(std::string_view name) {
    std::size_t reason = 0;
    while (reason < search_reasons && search_reason_name(reason) != name) ++reason;
    return reason;
}

/// The magnitude of a Witness.
inline double magnitude(std::size_t reason, const Evaluation& e) {
    if (reason == finding_count) return e.comparison.worst_weight_ulp();
    if (reason == finding_count + 1) return e.comparison.value_ulp;
    if (reason == witness_reasons) return e.relative_error;
    return e.comparison.weight_error;
}

/// How bad the case is for that reason; -1 if it does not show it. For findings that is the relative error, so that a
/// wrong sign counts by its effect on a value. If an answer is missing or not finite, the fault is worse the better the
/// cell is.
inline double badness(std::size_t reason, const Evaluation& e) {
    if (reason >= finding_count) return std::isfinite(magnitude(reason, e)) ? magnitude(reason, e) : -1;
    if (e.comparison.counts[reason] == 0) return -1;
    if (e.exact.region == Region::degenerate) return 0;  // as where the kernel misses that
    if (is_accident(reason) || is_finding(reason, Finding::not_finite) ||
        is_finding(reason, Finding::false_declaration))
        return 1 / largest_weight(e.exact);
    return std::isfinite(e.relative_error) ? e.relative_error : 0;
}

/// Where a walk towards that reason stands: a case that shows it is above one that does not; one that does not is the
/// higher the nearer it seems to be.
struct Height {
    double shown = -1;  ///< badness
    double near = 0;    ///< if it does not show
    friend bool operator==(const Height&, const Height&) = default;
    friend bool operator<(Height a, Height b) { return std::pair(a.shown, a.near) < std::pair(b.shown, b.near); }
};

inline Height height(std::size_t reason, const Evaluation& e) {
    const double shown = badness(reason, e);
    if (shown >= 0) return {shown, 0};
    if (e.exact.region == Region::degenerate)
        return {-1, is_finding(reason, Finding::missed_degenerate) ? HUGE_VAL : -1.0};
    if (is_finding(reason, Finding::missed_degenerate) || is_finding(reason, Finding::false_declaration) ||
        is_finding(reason, Finding::not_finite))
        return {-1, largest_weight(e.exact)};
    return {-1, e.comparison.worst_weight_ulp()};
}

}  // namespace barycert::audit

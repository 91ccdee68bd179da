/// One step of a search: a case, the exact answer, the kernel's; and how bad it is.
#pragma once

#include "barycert/audit/asking.hpp"

namespace barycert::audit {

struct Evaluation {
    Statement said;  ///< if it did not run, the kernel has been given up, and the members below say nothing of it
    OracleAnswer exact;
    Comparison comparison;
    double relative_error = -1;  ///< relative_error()
    std::string detail;          ///< what the kernel did besides answering, in words; empty if nothing
};

/// max |weight - exact| / max |exact|; -1 if degenerate, infinite if a weight is not finite or there is none.
double relative_error(const OracleAnswer& exact, const Comparison& comparison);

/// Precondition: all numbers of the case are finite, depths above zero.
Evaluation evaluate(const Kernel& kernel, const Case& c);

/// Those of witnesses, and the relative error.
inline constexpr std::size_t search_reasons = witness_reasons + 1;
inline constexpr std::string_view relative_error_reason = "worst_relative_error";

constexpr std::string_view search_reason_name(std::size_t reason) {
    return reason < witness_reasons ? reason_name(reason) : relative_error_reason;
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
std::size_t search_reason_named(std::string_view name);

/// How bad the case is for that reason; -1 if it does not show it. Of findings that is the relative error, so that a
/// wrong sign counts by what it does to a value; where an answer is missing or not finite the better cell is the worse
/// fault.
double badness(std::size_t reason, const Evaluation& e);

/// Where a walk towards that reason stands: a case that shows it is above one that does not; one that does not is the
/// higher the nearer it seems to be.
struct Height {
    double shown = -1;    ///< badness
    double nearness = 0;  ///< if it does not show
    friend bool operator==(const Height&, const Height&) = default;
    friend bool operator>(const Height& a, const Height& b) {
        return a.shown != b.shown ? a.shown > b.shown : a.nearness > b.nearness;
    }
};
Height height(std::size_t reason, const Evaluation& e);

/// The magnitude of a Witness.
double magnitude(std::size_t reason, const Evaluation& e);

}  // namespace barycert::audit

#include "barycert/audit/search/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "barycert/environment.hpp"

namespace barycert::audit {
namespace {

constexpr bool is(std::size_t reason, Finding f) {
    return reason == static_cast<std::size_t>(f);
}

/// max |exact weight|, at least 1 / (number of weights), for they sum up to 1; grows as the cell gets flat. One beyond
/// the largest double is compared as that one. Precondition: not degenerate.
double largest_weight(const OracleAnswer& exact) {
    double max = 0;
    for (const double w : exact.weights) max = std::max(max, std::fabs(w));
    return std::min(max, 0x1.fffffffffffffp+1023);
}

}  // namespace

double relative_error(const OracleAnswer& exact, const Comparison& comparison) {
    return exact.region == Region::degenerate ? -1 : comparison.weight_error / largest_weight(exact);
}

Evaluation evaluate(const Kernel& kernel, const Case& c) {
    Evaluation e;
    e.exact = ask_oracle(c);
    e.detail = ask_kernel(kernel, std::span(&c, 1), std::span(&e.said, 1), false).detail;
    e.comparison = compare(kernel, c, e.exact, e.said);
    ExactEnvironment::renew();
    e.relative_error = relative_error(e.exact, e.comparison);
    return e;
}

std::size_t search_reason_named(std::string_view name) {
    std::size_t reason = 0;
    while (reason < search_reasons && search_reason_name(reason) != name) ++reason;
    return reason;
}

double badness(std::size_t reason, const Evaluation& e) {
    if (reason >= finding_count) return std::isfinite(magnitude(reason, e)) ? magnitude(reason, e) : -1;
    if (e.comparison.counts[reason] == 0) return -1;
    if (e.exact.region == Region::degenerate) return 0;  // as where the kernel misses that
    if (is_accident(reason) || is(reason, Finding::not_finite) || is(reason, Finding::false_declaration))
        return 1 / largest_weight(e.exact);
    return std::isfinite(e.relative_error) ? e.relative_error : 0;
}

Height height(std::size_t reason, const Evaluation& e) {
    const double shown = badness(reason, e);
    if (shown >= 0) return {shown, 0};
    if (e.exact.region == Region::degenerate) return {-1, is(reason, Finding::missed_degenerate) ? HUGE_VAL : -1.0};
    if (is(reason, Finding::missed_degenerate) || is(reason, Finding::false_declaration) ||
        is(reason, Finding::not_finite))
        return {-1, largest_weight(e.exact)};
    return {-1, e.comparison.worst_weight_ulp()};
}

double magnitude(std::size_t reason, const Evaluation& e) {
    if (reason == finding_count) return e.comparison.worst_weight_ulp();
    if (reason == finding_count + 1) return e.comparison.value_ulp;
    if (reason == witness_reasons) return e.relative_error;
    return e.comparison.weight_error;
}

}  // namespace barycert::audit

#include "audit/asking.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ratio>
#include <span>
#include <string>

#include "audit/kernels/channel.hpp"
#include "audit/kernels/host.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/simplex.hpp"
#include "core/base/ulp.hpp"

namespace barycert::audit {
namespace {

/// The region by the kernel's rule; `own` is its own classification.
Region claim(const Kernel& kernel, const Statement& s, int own) {
    const auto n = static_cast<std::size_t>(vertex_count(kernel.simplex));
    if (kernel.rule != RegionRule::own) return claimed_region(kernel, s.status, std::span(s.weights).first(n));
    return s.status != 0 || own < 0 || own > 3 ? Region::degenerate : static_cast<Region>(own);
}

Asked ask_in_process(const Kernel& kernel, std::span<const Case> cases, std::span<Statement> statements) {
    using Clock = std::chrono::steady_clock;
    const WeightsFunction function = kernel.weights;
    // A weight that the kernel leaves unset must not look like an answer, least of all another kernel's.
    std::ranges::fill(statements, Statement{});
    std::string detail;
    const auto start = Clock::now();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        Statement& s = statements[i];
        s.status = function(cases[i].vertices.data(), cases[i].point.data(), s.weights.data());
        if (s.status == 0 || kernel.raised == nullptr) continue;
        const std::string raised = kernel.raised();
        if (raised.empty()) continue;
        s = {{}, true, false};
        s.incidents = kernels::incident_raised;
        if (detail.empty()) detail = raised;
    }
    const auto stop = Clock::now();
    // A kernel may leave another rounding mode behind: it is its own affair, not the oracle's or the next one's.
    ExactEnvironment::renew();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (statements[i].answered) complete(statements[i], kernel, cases[i]);
    }
    return {.ns = std::chrono::duration<double, std::nano>(stop - start).count() /
                  static_cast<double>(std::max<std::size_t>(cases.size(), 1)),
            .detail = detail};
}

Asked ask_host(const Kernel& kernel, std::span<const Case> cases, std::span<Statement> statements, bool timed) {
    using kernels::Host;
    Asked asked = kernel.host->run(cases, statements, timed ? Host::Asking::timed : Host::Asking::usual);
    const bool interpolates = kernel.host->description().interpolates;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        Statement& s = statements[i];
        if (!s.answered) continue;
        s.claimed = claim(kernel, s, s.region);
        if (s.status != 0)
            s.value = kernels::unset;
        else if (!interpolates)
            s.value = kernel.value(s.weights.data(), cases[i].values.data());
    }
    return asked;
}

void count(Comparison& r, Finding f) {
    ++r.counts[static_cast<std::size_t>(f)];
}

void count_incidents(Comparison& r, std::uint8_t incidents) {
    static_assert(kernels::incident_crashed == 1 && kernels::incident_hung == 1 << static_cast<int>(Finding::hung) &&
                  kernels::incident_printed == 1 << static_cast<int>(Finding::printed));
    for (std::size_t i = 0; i <= static_cast<std::size_t>(Finding::printed); ++i)
        r.counts[i] = static_cast<std::uint8_t>(incidents >> i & 1);
}

void compare_regions(Comparison& r, Region exact) {
    if (exact == Region::degenerate) {
        if (r.claimed != Region::degenerate) count(r, Finding::missed_degenerate);
    } else if (exact == Region::outside) {
        if (is_inside(r.claimed)) count(r, Finding::false_inside);
    } else if (r.claimed == Region::outside) {
        count(r, Finding::false_outside);
    }
}

void compare_weight(Comparison& r, std::size_t i, double w, double exact, int sign) {
    if (w == exact) {
        if (exact != 0 && std::isfinite(exact)) r.weight_ulps[i] = 0;
        return;
    }
    if (std::isinf(exact)) exact = std::copysign(std::numeric_limits<double>::max(), exact);
    if (!std::isfinite(w)) {
        count(r, Finding::not_finite);
        r.weight_error = std::numeric_limits<double>::infinity();
        return;
    }
    if (w == 0) {
        count(r, Finding::false_zero);
    } else if (sign == 0) {
        count(r, Finding::false_nonzero);
    } else if ((w > 0) != (sign > 0)) {
        count(r, Finding::opposite_sign);
    }
    r.weight_error = std::max(r.weight_error, std::fabs(w - exact));
    if (exact != 0) r.weight_ulps[i] = base::ulp_error_here(w, exact);
}

/// Comparison::relative_error of finite weights beside exact ones.
double relative_error(std::span<const double> weights, std::span<const double> exact) {
    constexpr double max = std::numeric_limits<double>::max();
    // Not denorm_min(): under -frounding-math GCC rounds it anew from a long double each time, which took half the
    // audit.
    constexpr double smallest = 0x1p-1074;
    double scale = 1, error = 0;
    for (const double x : exact) scale = std::max(scale, std::min(std::fabs(x), max));
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!std::isfinite(weights[i])) return std::numeric_limits<double>::infinity();
        const double to = std::clamp(exact[i], -max, max);
        if (weights[i] == to) continue;
        // Halved so that the difference cannot overflow; an error that underflows is an error.
        const double difference = std::fabs(weights[i] - to);
        const double e =
            std::isfinite(difference) ? difference / scale : std::fabs(weights[i] / 2 - to / 2) / (scale / 2);
        error = std::max({error, e, smallest});
    }
    return error;
}

}  // namespace

void complete(Statement& s, const Kernel& kernel, const Case& c) {
    int own = 0;
    if (s.status == 0) {
        if (kernel.classify != nullptr) own = kernel.classify(c.vertices.data(), c.point.data(), s.weights.data());
        s.value = kernel.interpolate != nullptr ? kernel.interpolate(c.vertices.data(), c.point.data(), c.values.data())
                                                : kernel.value(s.weights.data(), c.values.data());
        if (kernel.classify != nullptr || kernel.interpolate != nullptr) ExactEnvironment::renew();
    }
    s.claimed = claim(kernel, s, own);
}

std::string incident_of(const Kernel& kernel, const Case& c) {
    const ExactEnvironment environment;
    Statement said;
    if (kernel.host != nullptr)
        return kernel.host->run(std::span(&c, 1), std::span(&said, 1), kernels::Host::Asking::given_up_too).detail;
    return kernel.raised == nullptr ? "" : ask_in_process(kernel, std::span(&c, 1), std::span(&said, 1)).detail;
}

Asked ask_kernel(const Kernel& kernel, std::span<const Case> cases, std::span<Statement> statements, bool timed) {
    const ExactEnvironment environment;
    return kernel.host != nullptr ? ask_host(kernel, cases, statements, timed)
                                  : ask_in_process(kernel, cases, statements);
}

Comparison compare(const Kernel& kernel, const Case& c, const OracleAnswer& answer, const Statement& s) {
    Comparison r;
    r.weight_ulps.fill(-1);
    r.claimed = s.claimed;
    if (s.incidents != 0) count_incidents(r, s.incidents);
    if (!s.answered) {
        r.weight_error = std::numeric_limits<double>::infinity();
        if (answer.region != Region::degenerate) r.relative_error = r.weight_error;
        return r;
    }
    const auto n = static_cast<std::size_t>(vertex_count(c.simplex));
    const std::span weights(s.weights.data(), n), exact(answer.weights.data(), n);
    const bool degenerate = answer.region == Region::degenerate;
    const bool perfect = s.status == 0 && !degenerate && std::ranges::equal(weights, exact);
    if (!perfect || kernel.rule != RegionRule::sign) compare_regions(r, answer.region);
    if (degenerate) {
        if (r.wrong()) {
            for (const double w : weights) r.weight_error = std::max(r.weight_error, std::fabs(w));
            if (kernel.certifies) count(r, Finding::false_certificate);
        }
        return r;
    }
    if (s.status != 0) {
        count(r, Finding::false_declaration);
        r.weight_error = r.relative_error = std::numeric_limits<double>::infinity();
        return r;
    }
    // A classification may say degenerate of a simplex that has weights.
    if (kernel.rule == RegionRule::own && s.claimed == Region::degenerate) count(r, Finding::false_declaration);
    for (std::size_t i = 0; i < n; ++i) compare_weight(r, i, weights[i], exact[i], answer.signs[i]);
    r.relative_error = relative_error(weights, exact);
    if (std::isfinite(s.value) && std::isfinite(answer.value) && answer.value != 0)
        r.value_ulp = base::ulp_error_here(s.value, answer.value);
    const bool gives_values =
        kernel.interpolate != nullptr || (kernel.host != nullptr && kernel.host->description().interpolates);
    const bool wrong_value = gives_values && s.value != answer.value;
    if (kernel.certifies && (!perfect || wrong_value || r.wrong())) count(r, Finding::false_certificate);
    return r;
}

}  // namespace barycert::audit

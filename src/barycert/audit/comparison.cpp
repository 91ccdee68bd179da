#include "barycert/audit/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "barycert/base/ulp.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels/host.hpp"

namespace barycert::audit {
namespace {

void count(Comparison& r, Finding f) {
    ++r.counts[static_cast<std::size_t>(f)];
}

void count_incidents(Comparison& r, std::uint8_t incidents) {
    using namespace kernels;
    constexpr std::array<std::pair<Incident, Finding>, 7> all{{{incident_crashed, Finding::crashed},
                                                               {incident_raised, Finding::raised},
                                                               {incident_hung, Finding::hung},
                                                               {incident_beside, Finding::out_of_bounds},
                                                               {incident_forked, Finding::forked},
                                                               {incident_environment, Finding::changed_environment},
                                                               {incident_printed, Finding::printed}}};
    for (const auto& [incident, finding] : all) {
        if ((incidents & incident) != 0) count(r, finding);
    }
}

/// It has a function of its own for values.
bool gives_values(const Kernel& kernel) {
    return kernel.interpolate != nullptr || (kernel.host != nullptr && kernel.host->description().interpolates);
}

void compare_regions(Comparison& r, Region exact) {
    const bool inside = r.claimed == Region::interior || r.claimed == Region::boundary;
    if (exact == Region::degenerate) {
        if (r.claimed != Region::degenerate) count(r, Finding::missed_degenerate);
    } else if (exact == Region::outside) {
        if (inside) count(r, Finding::false_inside);
    } else if (r.claimed == Region::outside) {
        count(r, Finding::false_outside);
    }
}

void compare_weight(Comparison& r, std::size_t i, double w, double exact, int sign) {
    r.weight_ulps[i] = -1;
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

Comparison compare(const Kernel& kernel, const Case& c, const OracleAnswer& answer, const Statement& s) {
    const ExactEnvironment environment;
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
    const bool degenerate = answer.region == Region::degenerate;
    const bool perfect =
        s.status == 0 && !degenerate &&
        std::equal(s.weights.begin(), s.weights.begin() + static_cast<std::ptrdiff_t>(n), answer.weights.begin());
    if (!perfect || kernel.rule != RegionRule::sign) compare_regions(r, answer.region);
    if (degenerate) {
        if (r.wrong()) {
            for (std::size_t i = 0; i < n; ++i) r.weight_error = std::max(r.weight_error, std::fabs(s.weights[i]));
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
    for (std::size_t i = 0; i < n; ++i) compare_weight(r, i, s.weights[i], answer.weights[i], answer.signs[i]);
    r.relative_error = relative_error(std::span(s.weights).first(n), std::span(answer.weights).first(n));
    if (std::isfinite(s.value) && std::isfinite(answer.value) && answer.value != 0)
        r.value_ulp = base::ulp_error_here(s.value, answer.value);
    const bool wrong_value = gives_values(kernel) && s.value != answer.value;
    if (kernel.certifies && (!perfect || wrong_value || r.wrong())) count(r, Finding::false_certificate);
    return r;
}

Comparison compare(const Kernel& kernel, const Case& c, const OracleAnswer& answer, int status,
                   std::span<const double> weights) {
    const ExactEnvironment environment;
    Statement s;
    s.status = status;
    std::copy(weights.begin(), weights.end(), s.weights.begin());
    complete(s, kernel, c);
    return compare(kernel, c, answer, s);
}

}  // namespace barycert::audit

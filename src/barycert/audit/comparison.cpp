#include "barycert/audit/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/base/ulp.hpp"
#include "barycert/environment.hpp"

namespace barycert::audit {
namespace {

void count(Comparison& r, Finding f) {
    ++r.counts[static_cast<std::size_t>(f)];
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
    if (exact != 0) r.weight_ulps[i] = base::ulp_error(w, exact);
}

/// Comparison::relative_error of finite weights beside exact ones.
double relative_error(std::span<const double> weights, std::span<const double> exact) {
    constexpr double max = std::numeric_limits<double>::max();
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
        error = std::max({error, e, std::numeric_limits<double>::denorm_min()});
    }
    return error;
}

}  // namespace

Comparison compare(const Kernel& kernel, const Case& c, const OracleAnswer& answer, int status,
                   std::span<const double> weights) {
    const ExactEnvironment environment;
    Comparison r;
    r.weight_ulps.fill(-1);
    const auto n = static_cast<std::size_t>(vertex_count(c.simplex));
    const bool degenerate = answer.region == Region::degenerate;
    const bool perfect =
        status == 0 && !degenerate &&
        std::equal(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(n), answer.weights.begin());
    r.claimed = claimed_region(kernel, status, weights.first(n));
    if (!perfect || kernel.rule != RegionRule::sign) compare_regions(r, answer.region);
    if (degenerate) {
        if (r.wrong()) {
            for (std::size_t i = 0; i < n; ++i) r.weight_error = std::max(r.weight_error, std::fabs(weights[i]));
            if (kernel.certifies) count(r, Finding::false_certificate);
        }
        return r;
    }
    if (status != 0) {
        count(r, Finding::false_declaration);
        r.weight_error = r.relative_error = std::numeric_limits<double>::infinity();
        return r;
    }
    for (std::size_t i = 0; i < n; ++i) compare_weight(r, i, weights[i], answer.weights[i], answer.signs[i]);
    r.relative_error = relative_error(weights.first(n), std::span(answer.weights).first(n));
    const double value = kernel.interpolate != nullptr
                             ? kernel.interpolate(c.vertices.data(), c.point.data(), c.values.data())
                             : kernel.value(weights.data(), c.values.data());
    if (std::isfinite(value) && std::isfinite(answer.value) && answer.value != 0)
        r.value_ulp = base::ulp_error(value, answer.value);
    const bool wrong_value = kernel.interpolate != nullptr && value != answer.value;
    if (kernel.certifies && (!perfect || wrong_value || r.wrong())) count(r, Finding::false_certificate);
    return r;
}

}  // namespace barycert::audit

/// The error of one value, and where it is counted.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>

#include "barycert/verify.hpp"
#include "core/base/decades.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/ulp.hpp"

namespace barycert::verify {

enum class Compared : std::uint8_t { both_nan, missing, spurious, identical, different };

struct ValueError {
    Compared compared = Compared::identical;
    double ulps = 0, relative = 0;

    /// Whether the value is wrong under these options.
    bool over(const VerifyOptions& options) const {
        if (compared == Compared::missing || compared == Compared::spurious) return true;
        if (compared != Compared::different) return false;
        return options.exact || !(relative <= options.tolerance);
    }
};

/// |a - b| / range, without overflow on the way. Requires: range > 0, finite.
inline double relative_error(double a, double b, double range) {
    const double difference = std::fabs(a - b);
    if (!std::isinf(difference)) return difference / range;
    return std::fabs(a * 0.5 - b * 0.5) / (range * 0.5);  // infinite still, if one of them is
}

inline ValueError compare(double claimed, double exact, double range) {
    const bool no_claim = std::isnan(claimed), no_value = std::isnan(exact);
    if (no_claim && no_value) return {Compared::both_nan};
    if (no_claim || no_value)
        return {no_claim ? Compared::missing : Compared::spurious, 0, std::numeric_limits<double>::infinity()};
    if (claimed == exact) return {Compared::identical};
    ValueError error{Compared::different};
    error.relative = relative_error(claimed, exact, range);
    if (std::isinf(claimed) || std::isinf(exact)) {
        error.ulps = std::numeric_limits<double>::max();
    } else if (exact != 0) {
        error.ulps = base::ulp_error(claimed, exact);
    } else {
        error.ulps =
            std::min(std::ldexp(std::fabs(claimed), -base::ulp_exponent(range)), std::numeric_limits<double>::max());
    }
    return error;
}

static_assert(std::tuple_size_v<decltype(ValueErrors::by_relative)> == base::decade_bins);

inline void count(const ValueError& error, double claimed, const VerifyOptions& options, ValueErrors& to) {
    if (error.compared == Compared::both_nan) return;
    if (error.compared == Compared::missing) return void(++to.missing);
    if (error.compared == Compared::spurious) return void(++to.spurious);
    ++to.values;
    to.floats += static_cast<double>(static_cast<float>(claimed)) == claimed ? 1 : 0;
    if (error.compared == Compared::identical) {
        ++to.identical;
        ++to.by_ulps[0];
        ++to.by_relative[0];
        return;
    }
    to.over += error.over(options) ? 1 : 0;
    to.max_ulps = std::max(to.max_ulps, error.ulps);
    to.max_relative = std::max(to.max_relative, error.relative);
    const int bin = std::clamp(std::ilogb(std::max(error.ulps, 0.5)) + 2, 1, static_cast<int>(to.by_ulps.size()) - 1);
    ++to.by_ulps[static_cast<std::size_t>(bin)];
    ++to.by_relative[base::decade_bin(error.relative)];
}

}  // namespace barycert::verify

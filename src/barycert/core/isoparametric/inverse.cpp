#include "barycert/core/isoparametric/inverse.hpp"

#include "barycert/core/isoparametric/newton.hpp"

namespace barycert::core::isoparametric {
namespace {

/// One component: the values of active nodes, below 1 in size, and the exponent that gives them back. What underflows
/// is below 2^-1074, for which value_of() has room.
struct Component {
    std::array<double, max_nodes> values{};
    int exponent = 0;
    double off = 0;  ///< Evaluated::off
};

template <class T>
Ball<T> sum_of(const Reference& of, const std::array<Ball<T>, max_nodes>& n, const Component& c) {
    Ball<T> sum(0);
    for (std::size_t i = 0; i < of.nodes; ++i) {
        if (c.values[i] != 0) sum = sum + n[i] * Ball<T>(T(c.values[i]));
    }
    return of.scale == 1 ? sum : sum * inverse_of<T>(of.scale);
}

/// The value, if all numbers of the ball round to it.
std::optional<double> value_of(const Ball<TwoDoubles>& b, int exponent) {
    const auto [high, low] = b.mid;
    const double off = b.radius * (1 + 0x1p-40) + 0x1p-52 * std::abs(low) + 0x1p-1000;
    if (high + (low - off) != high || high + (low + off) != high) return std::nullopt;
    const double value = std::ldexp(high, exponent);
    if (!(std::abs(value) >= 0x1p-1021) || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// Rounded, the exact value and the middle lie between the ends of the ball.
template <unsigned bits>
std::optional<double> value_of(const Ball<Wide<bits>>& b, int exponent, double* middle, double* off) {
    using Wider = Wide<2400>;  // sums with radii, 2^-1000 or more, are exact or off by far less than the room
    const auto end = [&](double by) { return rounded(Rational(ldexp(Wider(Wider(b.mid) + by), exponent))); };
    const double radius = b.radius * (1 + 0x1p-40);  // room for what underflowed
    const double low = end(-radius), high = end(radius);
    *middle = end(0);
    *off = high - low;
    return low == high ? std::optional(low) : std::nullopt;
}

template <class T>
bool values_in(const Reference& of, const Inverse& inverse, std::vector<Component>& all, double goal,
               std::vector<std::uint8_t>& open, double* out, Vector<double>* about) {
    std::array<Ball<T>, 3> x;
    if (!inverse.enclose<T>(x, goal) || !inverse.may_be_inside(x)) return false;
    std::array<Ball<T>, max_nodes> n;
    inverse.functions(x, n);
    for (std::size_t c = 0; c < all.size(); ++c) {
        if (open[c] == 0) continue;
        const Ball<T> sum = sum_of(of, n, all[c]);
        std::optional<double> value;
        if constexpr (std::is_same_v<T, TwoDoubles>) {
            value = value_of(sum, all[c].exponent);
        } else {
            value = value_of(sum, all[c].exponent, &out[c], &all[c].off);
        }
        if (!value) continue;
        out[c] = *value + 0.0;
        open[c] = 0;
    }
    if constexpr (std::is_same_v<T, TwoDoubles>) {
        for (std::size_t k = 0; k < of.dimension(); ++k) (*about)[k] = x[k].mid.high;
    }
    return true;
}

}  // namespace

Evaluated evaluate(const Reference& of, const Places& places, const double* point, std::uint64_t active,
                   const double* values, std::size_t components, double* out) {
    std::vector<Component> all(components);
    std::vector<std::uint8_t> open(components, 0);
    bool any = false;
    for (std::size_t c = 0; c < components; ++c) {
        Component& own = all[c];
        double most = 0;
        bool finite = true;
        for (std::size_t i = 0; i < of.nodes; ++i) {
            if ((active >> i & 1U) == 0) continue;
            own.values[i] = values[components * i + c];
            finite = finite && std::isfinite(own.values[i]);
            most = std::max(most, std::abs(own.values[i]));
        }
        out[c] = finite ? 0 : std::numeric_limits<double>::quiet_NaN();
        if (!finite || most == 0) continue;
        own.exponent = exponent_above(most);
        for (double& x : own.values) x = std::ldexp(x, -own.exponent);
        open[c] = 1;
        any = true;
    }
    if (!any) return {Certainty::proved, Tier::double_double};
    Inverse inverse(of, places, point, true);
    const auto left = [&] { return std::ranges::count(open, 1) != 0; };
    Vector<double> about{};
    const bool found = inverse.search() && values_in<TwoDoubles>(of, inverse, all, 0x1p-88, open, out, &about);
    if (found && !left()) return {Certainty::proved, Tier::double_double};
    if (const auto x = inverse.exactly(about)) {
        std::array<Rational, max_nodes> n;
        shape_functions(of, *x, n, nullptr);
        for (std::size_t c = 0; c < components; ++c) {
            if (open[c] == 0) continue;
            Rational sum = 0;
            for (std::size_t i = 0; i < of.nodes; ++i) {
                if ((active >> i & 1U) != 0) sum += n[i] * Rational(values[components * i + c]);
            }
            out[c] = rounded(sum / of.scale);
        }
        return {Certainty::proved, Tier::exact};
    }
    if (!found || !values_in<Wide<300>>(of, inverse, all, 0x1p-250, open, out, nullptr)) return {};
    if (left()) values_in<Wide<1200>>(of, inverse, all, 0x1p-940, open, out, nullptr);
    Evaluated result{Certainty::proved, Tier::exact};
    for (std::size_t c = 0; c < components; ++c) {
        if (open[c] == 0) continue;
        result.certainty = Certainty::undecided;
        result.off = std::max(result.off, all[c].off);
    }
    return result;
}

}  // namespace barycert::core::isoparametric

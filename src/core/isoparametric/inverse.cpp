#include "core/isoparametric/inverse.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "barycert/simplex.hpp"
#include "core/isoparametric/affine_function.hpp"
#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/component.hpp"
#include "core/isoparametric/continuation.hpp"
#include "core/isoparametric/newton.hpp"
#include "core/isoparametric/places.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {
namespace {

template <class T>
bool values_in(const Reference& of, const Inverse& inverse, bool beyond, std::vector<Component>& all, double goal,
               std::vector<std::uint8_t>& open, double* out, Vector<double>* about) {
    std::array<Ball<T>, 3> x;
    if (!inverse.enclose<T>(x, goal) || !(beyond || inverse.may_be_inside(x))) return false;
    std::array<Ball<T>, max_nodes> n;
    inverse.functions(x, n);
    for (std::size_t c = 0; c < all.size(); ++c) {
        if (open[c] == 0) continue;
        const Ball<T> sum = sum_of(of.nodes, of.scale, n, all[c]);
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

/// At what `search` finds, true if it did; `beyond`: also outside of the cell.
template <class Search>
Evaluated evaluate_at(const Reference& of, const Places& places, const double* point, std::uint64_t active,
                      const double* values, std::size_t components, double* out, bool beyond, Search search) {
    std::vector<Component> all(components);
    std::vector<std::uint8_t> open(components, 0);
    const bool any = scale_components(of.nodes, active, values, all, open, out);
    if (!any && !beyond) return {Certainty::proved, Tier::double_double};
    Inverse inverse(of, places, point, !beyond);
    const auto left = [&] { return std::ranges::count(open, 1) != 0; };
    Vector<double> about{};
    const bool found = search(inverse) && values_in<TwoDoubles>(of, inverse, beyond, all, 0x1p-88, open, out, &about);
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
    // At a tie no ball would tell.
    for (std::size_t c = 0; c < components; ++c) {
        if (open[c] == 0) continue;
        const auto f = affine_function(of, places, values + c, components);
        if (!f) continue;
        out[c] = rounded(f->at(places, point, of.dimension()));
        open[c] = 0;
    }
    if (found && !left()) return {Certainty::proved, Tier::exact};
    if (!found || !values_in<Wide<300>>(of, inverse, beyond, all, 0x1p-250, open, out, nullptr)) return {};
    if (left()) values_in<Wide<1200>>(of, inverse, beyond, all, 0x1p-940, open, out, nullptr);
    Evaluated result{Certainty::proved, Tier::exact};
    for (std::size_t c = 0; c < components; ++c) {
        if (open[c] == 0) continue;
        result.certainty = Certainty::undecided;
        result.off = std::max(result.off, all[c].off);
    }
    return result;
}

}  // namespace

Evaluated evaluate(const Reference& of, const Places& places, const double* point, std::uint64_t active,
                   const double* values, std::size_t components, double* out) {
    return evaluate_at(of, places, point, active, values, components, out, false,
                       [](Inverse& inverse) { return inverse.search(); });
}

Evaluated evaluate_beyond(const Reference& of, const Places& places, const double* point,
                          const std::array<double, 3>& from, const double* values, std::size_t components,
                          double* out) {
    // An affine map is one to one everywhere, and all is rational. No other map passes here: 0.1 has too many bits.
    if (Inverse(of, places, point).exactly({0.1, 0.1, 0.1}))
        return evaluate_at(of, places, point, ~std::uint64_t{0}, values, components, out, true,
                           [](Inverse&) { return false; });
    return evaluate_at(of, places, point, ~std::uint64_t{0}, values, components, out, true, [&](Inverse& inverse) {
        const auto place = continue_inverse(of, inverse, from);
        return place && inverse.search_near(place->about, place->radius);
    });
}

}  // namespace barycert::core::isoparametric

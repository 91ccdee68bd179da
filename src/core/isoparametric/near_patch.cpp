// Answers about a point of a patch: whether it is inside, how near, where, and the values there.

#include "core/isoparametric/near_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <type_traits>
#include <vector>

#include "barycert/simplex.hpp"
#include "core/base/finite.hpp"
#include "core/base/vectors.hpp"
#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/component.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/patch.hpp"
#include "core/isoparametric/places.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

bool NearPatch::inside() {
    if (variables() == 0 || !is_critical_) return true;
    const bool square = patch_->kind == PatchKind::square;
    const auto judge = [&]<class N>(const Params<N>& x, const auto& sign_of) {
        std::optional<int> least = 1;
        const auto add = [&](const N& y) {
            const std::optional<int> own = sign_of(y);
            if (least != -1 && (!own || *own <= 0)) least = own;
        };
        N rest(1);
        for (std::size_t i = 0; i < variables(); ++i) {
            add(x[i]);
            rest = rest - x[i];
            if (square) add(N(N(1) - x[i]));
        }
        if (!square) add(rest);
        return least;
    };
    const auto of_ball = [](const auto& b) { return b.sign(); };
    if (const auto known = judge(enclosed<TwoDoubles>().x, of_ball)) return *known > 0;
    if (exactly()) return *judge(**exact_, [](const Rational& r) { return std::optional(r.sign()); }) > 0;
    const auto known = judge(enclosed<Wide<300>>().x, of_ball);
    return known && *known > 0;
}

template <class T>
std::optional<int> NearPatch::sign_of_difference(NearPatch& other) {
    const Map<T>&a = map<T>(), &b = other.map<T>();
    const PatchJet<Ball<T>> x(a, enclosed<T>().x, 0), y(b, other.enclosed<T>().x, 0);
    const double *from = patch_->origin(), *to = other.patch_->origin();
    int extent = std::min(units_.extent, other.units_.extent);
    double most = 0;
    for (std::size_t k = 0; k < patch_->dimension; ++k) most = std::max(most, std::abs(from[k] / 2 - to[k] / 2));
    if (most > 0) extent = std::min(extent, -exponent_above(most) - 1);
    const int away = std::min(units_.away, other.units_.away);
    Ball<T> sum(0);
    for (std::size_t k = 0; k < patch_->dimension; ++k) {
        const Ball<T> between = Made<Ball<T>>::times(Made<Ball<T>>::difference(from[k], to[k], extent), patch_scale) +
                                x.d[k] * Made<Ball<T>>::power(extent - units_.extent) -
                                y.d[k] * Made<Ball<T>>::power(extent - other.units_.extent);
        sum = sum + between * (x.at[k] * Made<Ball<T>>::power(away - units_.away) +
                               y.at[k] * Made<Ball<T>>::power(away - other.units_.away));
    }
    return sum.sign();
}

int NearPatch::compare(NearPatch& other) {
    if (const auto sign = sign_of_difference<TwoDoubles>(other)) return *sign;
    if (exactly() && other.exactly()) {
        const PatchJet<Rational> x(*rational_, **exact_, 0), y(*other.rational_, **other.exact_, 0);
        return Rational(base::dot(x.at, x.at) - base::dot(y.at, y.at)).sign();
    }
    return sign_of_difference<Wide<300>>(other).value_or(0);
}

template <class T>
Ball<T> NearPatch::square() {
    const Enclosed<T> at = enclosed<T>();
    const PatchJet<Ball<T>> jet(map<T>(), at.middle, 0);
    Ball<T> sum = base::dot(jet.at, jet.at);
    // The square has twice the derivatives of its half; two variables may both be off.
    const double ratio = map<T>().ratio.most();
    sum.radius = (sum.radius + 4 * ratio * taken_.most_slope * at.radius * at.radius) * (1 + 0x1p-40);
    return sum;
}

bool NearPatch::round_quickly(RoundedDistance& out) {
    const Ball<TwoDoubles> s = square<TwoDoubles>();
    const double part = s.radius / s.mid.high;
    if (!(s.mid.high > 0x1p-600 && part < 0x1p-50)) return false;
    // root^2 + rest = s; what a step of Newton's leaves is below the square of the correction, 2^-104 of the root.
    const double root = std::sqrt(s.mid.high);
    const double rest = (s.mid - TwoDoubles::product(root, root)).high / (2 * root);
    const double q = root / patch_scale, left = std::fma(-q, patch_scale, root) + rest;
    const TwoDoubles d = TwoDoubles::sum(q, left / patch_scale);
    const double off = d.high * (part + 0x1p-95);
    if (d.high + (d.low - off) != d.high || d.high + (d.low + off) != d.high) return false;
    out.value = std::ldexp(d.high, -units_.away);
    return std::isfinite(out.value) && out.value >= 0x1p-1021;
}

template <unsigned bits>
bool NearPatch::round_distance(RoundedDistance& out) {
    using N = Wide<bits>;
    const Ball<N> s = square<N>();
    const auto end = [&](double by, double grow) {
        const N x = s.mid + N(by) * N(1 + 0x1p-40);
        if (!(x > 0)) return 0.0;
        return rounded(Rational(ldexp(N(sqrt(x) / N(patch_scale) * (N(1) + N(grow))), -units_.away)));
    };
    const double low = end(-s.radius, -0x1p-280), high = end(s.radius, 0x1p-280);
    out = {end(0, 0), high - low};
    return low == high;
}

RoundedDistance NearPatch::distance() {
    RoundedDistance out;
    if (round_quickly(out) || round_distance<300>(out)) return out;
    if (!exactly()) {
        round_distance<1200>(out);
        return out;
    }
    // It is amid two doubles, or zero, or so near to one of them that more bits tell.
    const PatchJet<Rational> jet(*rational_, **exact_, 0);
    const Rational square = base::dot(jet.at, jet.at) / Rational(patch_scale * patch_scale);
    for (const double neighbour : {std::nextafter(out.value, -HUGE_VAL), std::nextafter(out.value, HUGE_VAL)}) {
        if (!std::isfinite(neighbour) || !std::isfinite(out.value)) continue;
        const Rational middle = (Rational(out.value) + Rational(neighbour)) / 2;
        if (square == middle * middle) return {rounded(middle), 0};
    }
    if (square == 0) return {};
    round_distance<1200>(out);
    return out;
}

std::array<double, 3> NearPatch::place() {
    const PatchJet<Ball<TwoDoubles>> jet(map<TwoDoubles>(), enclosed<TwoDoubles>().middle, 0);
    std::array<double, 3> out{};
    const double* const origin = patch_->origin();
    for (std::size_t k = 0; k < patch_->dimension; ++k) {
        const TwoDoubles& d = jet.d[k].mid;
        const double q = d.high / patch_scale, left = (std::fma(-q, patch_scale, d.high) + d.low) / patch_scale;
        const TwoDoubles by = TwoDoubles::sum(std::ldexp(q, -units_.extent), std::ldexp(left, -units_.extent));
        out[k] = (TwoDoubles(origin[k]) + by).high;
    }
    return out;
}

template <class T>
void NearPatch::shapes(const Params<T>& x, std::array<T, max_nodes>& n) const {
    const PatchBasis& basis = patch_basis(*patch_);
    const PatchPowers<T> powers(x, basis.degree);
    for (std::size_t i = 0; i < patch_->count; ++i) n[i] = T(0);
    for (std::size_t t = 0; t < basis.terms.size(); ++t) {
        const T one = powers.at(basis.terms[t]);
        for (std::size_t i = 0; i < patch_->count; ++i) {
            const double factor = basis.row(patch_->nodes[i])[t];
            if (factor != 0) n[i] = n[i] + Made<T>::times(one, factor);
        }
    }
}

std::uint64_t NearPatch::active_nodes() {
    std::uint64_t active = ~std::uint64_t{0};
    if (!exactly()) return active;
    std::array<Rational, max_nodes> n;
    shapes(**exact_, n);
    for (std::size_t i = 0; i < patch_->count; ++i) {
        if (n[i] == 0) active &= ~(std::uint64_t{1} << i);
    }
    return active;
}

Evaluated NearPatch::evaluate(const double* values, std::size_t components, double* out) {
    std::vector<Component> all(components);
    std::vector<std::uint8_t> open(components, 0);
    const std::uint64_t active =
        base::all_finite({values, components * patch_->count}) ? ~std::uint64_t{0} : active_nodes();
    if (!scale_components(patch_->count, active, values, all, open, out))
        return {Certainty::proved, Tier::double_double};
    std::array<Ball<TwoDoubles>, max_nodes> n;
    shapes(enclosed<TwoDoubles>().x, n);
    bool left = false;
    for (std::size_t c = 0; c < components; ++c) {
        if (open[c] == 0) continue;
        const auto value = value_of(sum_of(patch_->count, patch_scale, n, all[c]), all[c].exponent);
        if (value) out[c] = *value + 0.0;
        open[c] = value ? 0 : 1;
        left = left || !value;
    }
    if (!left) return {Certainty::proved, Tier::double_double};
    Evaluated result{Certainty::proved, Tier::exact};
    if (exactly()) {
        std::array<Rational, max_nodes> exact;
        shapes(**exact_, exact);
        for (std::size_t c = 0; c < components; ++c) {
            if (open[c] == 0) continue;
            Rational sum = 0;
            for (std::size_t i = 0; i < patch_->count; ++i) {
                if ((active >> i & 1U) != 0) sum += exact[i] * Rational(values[components * i + c]);
            }
            out[c] = rounded(sum / patch_scale);
        }
        return result;
    }
    const auto widely = [&]<unsigned bits>(std::integral_constant<unsigned, bits>) {
        std::array<Ball<Wide<bits>>, max_nodes> wide;
        shapes(enclosed<Wide<bits>>().x, wide);
        for (std::size_t c = 0; c < components; ++c) {
            if (open[c] == 0) continue;
            const auto value =
                value_of(sum_of(patch_->count, patch_scale, wide, all[c]), all[c].exponent, &out[c], &all[c].off);
            if (value) out[c] = *value + 0.0;
            open[c] = value ? 0 : 1;
        }
    };
    widely(std::integral_constant<unsigned, 300>());
    if (std::ranges::count(open, 1) != 0) widely(std::integral_constant<unsigned, 1200>());
    for (std::size_t c = 0; c < components; ++c) {
        if (open[c] == 0) continue;
        result.certainty = Certainty::undecided;
        result.off = std::max(result.off, all[c].off);
    }
    return result;
}

}  // namespace barycert::core::isoparametric

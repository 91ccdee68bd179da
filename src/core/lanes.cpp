#include "core/lanes.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/lanes.cpp"
#include "core/foreach_target.hpp"

#include "core/lane_loop-inl.hpp"
#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

/// out[n * l + i] = lane l of w[i].
template <int n, class D, class V = hn::Vec<D>>
HWY_INLINE void store_interleaved(D tag, const V (&w)[n], double* out) {
    if constexpr (n == 2) hn::StoreInterleaved2(w[0], w[1], tag, out);
    if constexpr (n == 3) hn::StoreInterleaved3(w[0], w[1], w[2], tag, out);
    if constexpr (n == 4) hn::StoreInterleaved4(w[0], w[1], w[2], w[3], tag, out);
}

template <Simplex s>
std::size_t signs_of(const CaseBlock& cases, WeightSigns* out, std::uint32_t* undecided) {
    return for_lanes(cases.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using D = decltype(tag);
        const hn::RebindToUnsigned<D> bits;
        const hn::Rebind<WeightSigns::Bits, D> narrow;
        Relative<s, hn::Vec<D>> c;
        load_relative<s>(tag, cases.vertices, cases.point, at, c);
        hn::Vec<decltype(bits)> packed;
        const auto certain = filter<s>(tag, c, packed);
        // A WeightSigns is its bits: their address may stand for its own.
        static_assert(std::is_standard_layout_v<WeightSigns> && sizeof(WeightSigns) == sizeof(WeightSigns::Bits));
        hn::StoreU(hn::TruncateTo(narrow, packed), narrow, reinterpret_cast<WeightSigns::Bits*>(out + at));
        return certain;
    });
}

template <Simplex s>
std::size_t weights_of(const CaseBlock& cases, double* out, std::uint32_t* undecided) {
    return for_lanes(cases.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using D = decltype(tag);
        constexpr int n = vertex_count(s);
        const RefinedValues<s, D> refined(tag, load_absolute<s>(tag, cases.vertices, cases.point, at));
        auto certain = refined.certain();
        hn::Vec<D> w[n];
        for (int i = 0; i < n; ++i) w[i] = weight(tag, refined.r, i, certain);
        store_interleaved<n>(tag, w, out + at * n);
        return certain;
    });
}

template <Simplex s, template <Simplex, class, class> class Values>
std::size_t values_of(const CaseBlock& cases, const double* const* f, int components, double* out,
                      std::uint32_t* undecided) {
    const auto stride = static_cast<std::size_t>(components);
    return for_lanes(cases.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using D = decltype(tag);
        using V = hn::Vec<D>;
        constexpr int n = vertex_count(s);
        const Values<s, D, V> values(tag, load_absolute<s>(tag, cases.vertices, cases.point, at));
        auto certain = values.certain();
        for (int c = 0; c < components; ++c) {
            V nodal[n];
            for (int i = 0; i < n; ++i) nodal[i] = hn::LoadU(tag, f[n * c + i] + at);
            const V value = values.at(tag, nodal, certain);
            if constexpr (!Values<s, D, V>::proved)
                certain = hn::And(certain, hn::Eq(value - value, hn::Zero(tag)));  // finite
            store_strided(tag, value, out + at * stride + static_cast<std::size_t>(c), stride);
        }
        return certain;
    });
}

bool contract() {
    // (1 + 2^-30)^2 = 1 + 2^-29 + 2^-60: the product rounded on its own loses 2^-60, fused it does not.
    volatile double root = 1 + 0x1p-30, minus = -(1 + 0x1p-29);
    const double x = root, y = minus;
    return x * x + y == 0x1p-60;
}

std::int64_t own_target() {
    return HWY_TARGET;
}

// One entry for all simplices: Highway's tables hold plain functions.
std::size_t signs(Simplex s, const CaseBlock& cases, WeightSigns* out, std::uint32_t* undecided) {
    return with_simplex(s, [&]<Simplex known>() { return signs_of<known>(cases, out, undecided); });
}

std::size_t weights(Simplex s, const CaseBlock& cases, double* out, std::uint32_t* undecided) {
    return with_simplex(s, [&]<Simplex known>() { return weights_of<known>(cases, out, undecided); });
}

std::size_t values(Rounding rounding, Simplex s, const CaseBlock& cases, const double* const* f, int components,
                   double* out, std::uint32_t* undecided) {
    return with_simplex(s, [&]<Simplex known>() {
        const auto of = rounding == Rounding::plain ? values_of<known, PlainValues> : values_of<known, RefinedValues>;
        return of(cases, f, components, out, undecided);
    });
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::core {

HWY_EXPORT(signs);
HWY_EXPORT(weights);
HWY_EXPORT(values);
HWY_EXPORT(own_target);
HWY_EXPORT(contract);

std::size_t sign_lanes(Simplex s, const CaseBlock& cases, WeightSigns* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(signs)(s, cases, out, undecided);
}

std::size_t weight_lanes(Simplex s, const CaseBlock& cases, double* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(weights)(s, cases, out, undecided);
}

std::size_t value_lanes(Rounding rounding, Simplex s, const CaseBlock& cases, const double* const* f, int components,
                        double* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(values)(rounding, s, cases, f, components, out, undecided);
}

bool lanes_contract() {
    return HWY_DYNAMIC_DISPATCH(contract)();
}

namespace {

std::string target_name(std::int64_t target) {
    if (target == HWY_AVX3) return "AVX-512";
    if (target == HWY_EMU128 || target == HWY_SCALAR) return "scalar";
    return hwy::TargetName(target);
}

/// The targets that this build has and this processor can run. Asked once: asking Highway again would choose anew.
const std::vector<std::int64_t>& supported_targets() {
    static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
    return targets;
}

std::int64_t chosen_target() {
    return HWY_DYNAMIC_DISPATCH(own_target)();
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

std::vector<std::string> simd_targets() {
    std::vector<std::string> names;
    for (const std::int64_t target : core::supported_targets()) names.push_back(core::target_name(target));
    return names;
}

std::string simd_target() {
    return core::target_name(core::chosen_target());
}

bool use_simd_target(std::string_view name) {
    if (name.empty()) {
        hwy::GetChosenTarget().DeInit();  // the next call asks the processor again
        return true;
    }
    for (const std::int64_t target : core::supported_targets()) {
        if (core::target_name(target) != name) continue;
        hwy::GetChosenTarget().Update(target);
        return true;
    }
    return false;
}

}  // namespace barycert
#endif

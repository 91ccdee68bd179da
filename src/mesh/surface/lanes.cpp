#include <algorithm>
#include <cstddef>
#include <cstdint>
#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "mesh/surface/parts.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/surface/lanes.cpp"
#include "core/foreach_target.hpp"

#include "core/lane_loop-inl.hpp"
#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::surface::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace core = barycert::core::HWY_NAMESPACE;

// Which cells have corners in the set and outside. Indices are checked on SIMD lanes. Bits are loaded one by one:
// gathers are not faster, and one bit a node leaves most of them in the first cache.

/// Whether all are nodes: a negative index is a large one.
bool all_fit(const Mesh::Index* indices, std::size_t count, std::uint32_t nodes) {
    const hn::ScalableTag<std::int32_t> tag;
    const hn::RebindToUnsigned<decltype(tag)> numbers;
    const std::size_t lanes = hn::Lanes(tag);
    auto most = hn::Zero(numbers), next = most;
    std::size_t i = 0;
    for (; i + 2 * lanes <= count; i += 2 * lanes) {
        most = hn::Max(most, hn::BitCast(numbers, hn::LoadU(tag, indices + i)));
        next = hn::Max(next, hn::BitCast(numbers, hn::LoadU(tag, indices + i + lanes)));
    }
    return hn::AllTrue(numbers, hn::Lt(hn::Max(most, next), hn::Set(numbers, nodes))) &&
           indices_fit({indices + i, count - i}, nodes);
}

template <std::size_t n>
std::size_t mixed(const Mesh::Index* corners, std::size_t count, const States& states, std::uint32_t* out) {
    constexpr std::size_t at_a_time = 256;  // for a near cache
    const std::uint64_t* const in_set = states.in_set.data();
    const std::uint64_t every = states.all_known ? 0 : 1;
    std::size_t found = 0;
    for (std::size_t begin = 0; begin < count; begin += at_a_time) {
        const std::size_t end = std::min(count, begin + at_a_time);
        if (!all_fit(corners + n * begin, n * (end - begin), static_cast<std::uint32_t>(states.of.size())))
            return no_node;
        for (std::size_t cell = begin; cell < end; ++cell) {
            const Mesh::Index* const c = corners + n * cell;
            __builtin_prefetch(corners + n * std::min(cell + 2 * at_a_time, count - 1));
            const auto bit = [&](std::size_t i) {
                const auto node = static_cast<std::uint32_t>(c[i]);
                return in_set[node / 64] >> (node % 64);
            };
            const std::uint64_t first = bit(0);
            std::uint64_t differ = every;
            for (std::size_t i = 1; i < n; ++i) differ |= first ^ bit(i);
            out[found] = static_cast<std::uint32_t>(cell);
            found += differ & 1;
        }
    }
    return found;
}

std::size_t find_mixed(const Mesh::Index* corners, std::size_t n, std::size_t count, const States& states,
                       std::uint32_t* out) {
    return n == 4 ? mixed<4>(corners, count, states, out) : mixed<3>(corners, count, states, out);
}

// The number that a linear function has where g is zero on an edge: in double-double, with a bound on the error.
//
// Notation: a the end with g >= 0, b the other; p = g(a) >= 0, q = -g(b) > 0, D = p + q. The weights of a and b are q/D
// and p/D, both from 0 to 1. u = 2^-53. P, Q, S: p, q and D as double-double numbers; bounds for x + y and x * y are
// those of error_free-inl.hpp.
//
// |P - p| and |Q - q| together are at most e:
//   a field     p = f_a - value, q = value - f_b: exact (two_difference), e = 0.
//   a plane     g = d - n.x. Three products, exact as double-double numbers, then (n_0 x_0 + n_1 x_1) + (n_2 x_2 - d):
//               with M the sum of |n_k x_k| and |d|, each of two sums on the first level, together 4 u^2 M, and one of
//               sums of at most 1.01 M, 4.04 u^2 M; e = 9 u^2 (M_a + M_b), where 0.9 u^2 cover the roundings of M.
// If e <= 2^-12 S, then |S - D| <= 4.04 u^2 S + e, and weights as refinement-inl.hpp has it for simplices that are
// projected on, l = fl(N_high / S_high) and c = (N - l S) / S_high, where N is P or Q: the leading difference is exact
// (Sterbenz), so is the next, and what remains rounds by 1.1 u^2 + 2.1 u^2 + 3.1 u^2 of |N|; c itself, at most 3.1 u l,
// by 3.1 u in the division. So
//   |l + c - exact weight| <= 17 u^2 l + 1.01 (e + l (4.04 u^2 S + e)) / S <= 22 u^2 + 2.1 e / S,
// of which the code takes 24 u^2 + 2.2 e / S_high: what is left covers the roundings of the bound, and what underflows.
// The sum of |c| is at most 3.1 u L, less than the 5.5 u L that `value` of refinement-inl.hpp allows for.
//
// Ranges: 2^-800 <= S_high <= 2^900. Then 1/S_high is normal, and p, q <= 1.01 S. Underflow of a product l S loses at
// most 2^-1070, of l itself 2^-1075 S, and so on: below 20 * 2^-1070 against u^2 S >= 2^-906. In n.x, where S <= 1.01
// (M_a + M_b), three products an end lose 2^-1070 each against 0.5 u^2 (M_a + M_b). An infinite or NaN difference makes
// S_high infinite or NaN; an infinite M makes e infinite. Comparisons with NaN are false: undecided.

/// p and q, and a bound on the sum of their errors.
template <class V>
struct Sides {
    core::DoubleDouble<V> p, q;
    V error;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE core::Refined<Simplex::segment, D> refine_crossing(D tag, const Sides<V>& sides) {
    constexpr double u = 0x1p-53;
    const auto constant = [&](double x) { return hn::Set(tag, x); };
    core::Refined<Simplex::segment, D> out;
    const core::DoubleDouble<V> sum = sides.p + sides.q;
    const V inverse = constant(1) / sum.high;
    const core::DoubleDouble<V> numerators[2] = {sides.q, sides.p};
    out.magnitude = constant(1);
    for (int i = 0; i < 2; ++i) {
        const core::DoubleDouble<V>& n = numerators[i];
        const V w = n.high / sum.high;
        const core::TwoTerms<V> product = core::two_product(w, sum.high);
        const V rest = ((n.high - product.high) - product.low) + (n.low - w * sum.low);
        out.weight[i] = w;
        out.correction[i] = rest * inverse;
        out.magnitude = out.magnitude + hn::Abs(w);
    }
    out.error = constant(24 * u * u) + constant(2.2) * (sides.error * inverse);
    out.valid =
        hn::And(core::within(tag, sum.high, 0x1p-800, 0x1p900), hn::Le(sides.error, constant(0x1p-12) * sum.high));
    return out;
}

/// Runs sides(tag, at) and interpolates between the ends.
template <class Get>
HWY_INLINE std::size_t crossings(const EdgeBlock& edges, double* out, std::uint32_t* undecided, Get sides) {
    const auto stride = static_cast<std::size_t>(edges.components);
    return core::for_lanes(edges.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using V = hn::Vec<decltype(tag)>;
        const auto refined = refine_crossing(tag, sides(tag, at));
        auto certain = refined.valid;
        for (std::size_t c = 0; c < stride; ++c) {
            const V f[2] = {hn::LoadU(tag, edges.values[2 * c] + at), hn::LoadU(tag, edges.values[2 * c + 1] + at)};
            const V value = core::value<Simplex::segment>(tag, refined, f, certain);
            core::store_strided(tag, value, out + stride * at + c, stride);
        }
        return certain;
    });
}

std::size_t level_crossings(double value, const double* const* f, const EdgeBlock& edges, double* out,
                            std::uint32_t* undecided) {
    return crossings(edges, out, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using V = hn::Vec<decltype(tag)>;
        const V level = hn::Set(tag, value);
        return Sides<V>{core::two_difference(hn::LoadU(tag, f[0] + at), level),
                        core::two_difference(level, hn::LoadU(tag, f[1] + at)), hn::Zero(tag)};
    });
}

/// n.x - d at the ends `end`, and M.
template <class D, class V = hn::Vec<D>>
HWY_INLINE core::DoubleDouble<V> height(D tag, const Plane& plane, const EdgeBlock& edges, std::size_t end,
                                        std::size_t at, V& magnitude) {
    core::DoubleDouble<V> term[3];
    const V offset = hn::Set(tag, plane.offset);
    magnitude = hn::Abs(offset);
    for (std::size_t k = 0; k < 3; ++k) {
        term[k] = core::two_product(hn::Set(tag, plane.normal[k]), hn::LoadU(tag, edges.values[2 * k + end] + at));
        magnitude = magnitude + hn::Abs(term[k].high);
    }
    return (term[0] + term[1]) + (term[2] - core::DoubleDouble<V>{offset, hn::Zero(tag)});
}

std::size_t plane_crossings(const Plane& plane, const EdgeBlock& edges, double* out, std::uint32_t* undecided) {
    constexpr double u = 0x1p-53;
    return crossings(edges, out, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using V = hn::Vec<decltype(tag)>;
        V magnitude_a, magnitude_b;
        const core::DoubleDouble<V> a = height(tag, plane, edges, 0, at, magnitude_a);
        const core::DoubleDouble<V> b = height(tag, plane, edges, 1, at, magnitude_b);
        return Sides<V>{{hn::Neg(a.high), hn::Neg(a.low)}, b, hn::Set(tag, 9 * u * u) * (magnitude_a + magnitude_b)};
    });
}

}  // namespace barycert::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::surface {

HWY_EXPORT(find_mixed);
HWY_EXPORT(level_crossings);
HWY_EXPORT(plane_crossings);

std::size_t mixed_cells(const Mesh::Index* corners, std::size_t n, std::size_t count, const States& states,
                        std::uint32_t* out) {
    return HWY_DYNAMIC_DISPATCH(find_mixed)(corners, n, count, states, out);
}

std::size_t level_lanes(double value, const double* const* f, const EdgeBlock& edges, double* out,
                        std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(level_crossings)(value, f, edges, out, undecided);
}

std::size_t plane_lanes(const Plane& plane, const EdgeBlock& edges, double* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(plane_crossings)(plane, edges, out, undecided);
}

}  // namespace barycert::surface
#endif

// Krawczyk's operator (inverse.hpp) in double, and one step of Newton's method and the value in double-double.
//
// u = 2^-53; q_i = p_i - p as double-double, Q the largest |q_i| by coordinates, F the largest |f_i|. x, found in
// double, is taken as exact. Near the reference cell, its coordinates, and the sum of those in which that is a triangle
// or tetrahedron, are in [-2^-20, 1 + 2^-20]. There these are bounds, for products first (wedges as well), for
// tetrahedra with L the barycentric coordinates second:
//   N           sum |N_i|            1 + 2^-17; sum |L| |2 L - 1| <= 1 + 2^-17 at corners, and at edges
//                                    sum 4 |L_a L_b| <= 2 (sum |L|)^2 - 2 sum L^2 <= 3/2 + 2^-15: in all 2.51
//   N'          sum |dN_i / dx_j|    2 + 2^-16; by L_c, |4 L_c - 1| + sum 4 |L_d| <= 5.01: by x_j 10.02, as L_0 is
//                                    1 - r - s - t
//   N''         sum |d2 N_i / dx_j dx_k|   4 + 2^-16, and none by one coordinate twice; 16
// From these, with the rounding of each operation:
//   X'          in double            off by 24 u (2 + 2^-16) Q < 49 u Q; 4 L - 1 by 19 u, 4 L by 16 u, as L_0 is off by
//                                    4 u, the q and four sums of products by 25 u: by L_c 60 u Q, by x_j 140 u Q
//   over a box of radius R around x: changes by 2 R (4 + 2^-10) Q < 9 R Q; 3 R 16 Q = 48 R Q
//   m           |1 - Y X'| by rows, computed: off by 8 u |Y| |X'|, |X'| <= 3 Q; 10.1 Q. So
//               m <= max over rows of sum |(1 - Y X')_rc| + 3 (73 u + 9 R) Q sum_k |Y_rk|; with (221 u + 48 R)
//   X(x) - p    in double-double     factors 1 - r exact, two products by 18 u^2, with q by 9 u^2, seven sums by 28
//   u^2:
//                                    56 u^2 Q; L_0 by 24 u^2, 2 L - 1 by 60 u^2, L (2 L - 1) by 93 u^2, 4 L_a L_b by
//                                    132 u^2: sum 1164 u^2, q amid two places by 8 u^2, products 9 u^2, each
//                                    times 2.51, nine sums by 181 u^2: 1400 u^2 Q
//   d = Y (X(x) - p)                 products by 9 u^2, sums by 8 u^2, |X(x) - p| <= 1.1 Q; 2.6 Q: 80 u^2 Q |Y|;
//                                    1450 u^2 Q |Y|
//   the point   x - d, with a sum rounded by 4 u^2 (1 + R): off by e = 2 |d| m + that + 5 u^2
//   the value   from the point 3 (2 + 2^-16) e F < 6.1 e F; 30.1 e F. In double-double factors 1 - r by 5 u^2 each,
//               products by 18 u^2, with f by 9 u^2, sums by 28 u^2: 70 u^2 F; as for X(x) - p 1400 u^2 F
// Bounds are computed in double: 1 + 2^-40 covers that. Ranges outside which nothing is certain: Q and F in
// [2^-300, 2^300], or F = 0; then nothing under- or overflows: |Y| <= 2^330 is asked for.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/isoparametric/lanes.cpp"
#include "core/foreach_target.hpp"
// After the targets.
#include "core/isoparametric/lanes.hpp"
#include "core/lane_loop-inl.hpp"
#include "core/lanes.hpp"
#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::isoparametric::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using core::HWY_NAMESPACE::DoubleDouble;
using core::HWY_NAMESPACE::two_difference;
using core::HWY_NAMESPACE::within;
using D = hn::CappedTag<double, max_lanes>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;

template <LaneElement element>
struct Bounds {
    static constexpr bool simplex = element == LaneElement::tetrahedron;
    static constexpr double around = simplex ? 221 : 73, over_box = simplex ? 48 : 9;  ///< of X', in u and in R
    static constexpr double of_d = simplex ? 1450 : 80, of_sum = simplex ? 1400 : 70;  ///< in u^2
    static constexpr double of_point = simplex ? 30.1 : 6.1;                           ///< of the value, in e
};

/// Values at x of the functions of the nodes.
template <LaneElement element, class N>
HWY_INLINE void functions(const N& one, const N (&x)[3], N (&n)[lane_nodes(element)]) {
    if constexpr (element == LaneElement::tetrahedron) {
        const N l[4] = {one - x[0] - x[1] - x[2], x[0], x[1], x[2]};
        N twice[4];
        for (int c = 0; c < 4; ++c) {
            twice[c] = l[c] + l[c];
            n[c] = l[c] * (twice[c] - one);
        }
        for (int e = 0; e < 6; ++e) n[4 + e] = twice[core::quadratic_edges[e][0]] * twice[core::quadratic_edges[e][1]];
        return;
    } else {
        const N r1 = one - x[0], s1 = one - x[1], t1 = one - x[2];
        N flat[4];
        if constexpr (element == LaneElement::wedge) {
            flat[0] = r1 - x[1];
            flat[1] = x[0];
            flat[2] = x[1];
            flat[3] = one - one;
        } else {
            flat[0] = r1 * s1;
            flat[1] = x[0] * s1;
            flat[2] = x[0] * x[1];
            flat[3] = r1 * x[1];
        }
        for (int i = 0; i < 4; ++i) {
            n[i] = flat[i] * t1;
            n[i + 4] = flat[i] * x[2];
        }
    }
}

/// X(x) - p and its Jacobian in double.
struct Linear {
    V rest[3], jacobian[3][3];
};

template <LaneElement element>
HWY_INLINE Linear linearise(D tag, const V (&x)[3], const V (&q)[10][3]) {
    const V one = hn::Set(tag, 1), four = hn::Set(tag, 4);
    const V l[4] = {one - x[0] - x[1] - x[2], x[0], x[1], x[2]};
    V n[10], times_four[4];
    functions<element>(one, x, n);
    for (int c = 0; c < 4; ++c) times_four[c] = four * l[c];
    Linear out;
    for (int k = 0; k < 3; ++k) {
        V by[4];
        out.rest[k] = hn::Zero(tag);
        for (int c = 0; c < 4; ++c) by[c] = (times_four[c] - one) * q[c][k];
        for (int e = 0; e < 6; ++e) {
            const auto [a, b] = core::quadratic_edges[e];
            by[a] = hn::MulAdd(times_four[b], q[4 + e][k], by[a]);
            by[b] = hn::MulAdd(times_four[a], q[4 + e][k], by[b]);
        }
        for (int i = 0; i < 10; ++i) out.rest[k] = hn::MulAdd(n[i], q[i][k], out.rest[k]);
        for (int j = 0; j < 3; ++j) out.jacobian[k][j] = by[j + 1] - by[0];
    }
    return out;
}

template <LaneElement element>
HWY_INLINE Linear linearise(D tag, const V (&x)[3], const V (&q)[8][3]) {
    constexpr bool wedge = element == LaneElement::wedge;
    const V one = hn::Set(tag, 1), zero = hn::Zero(tag);
    const V r1 = one - x[0], s1 = one - x[1], t1 = one - x[2];
    const V by_r[4] = {wedge ? hn::Neg(one) : hn::Neg(s1), wedge ? one : s1, wedge ? zero : x[1],
                       wedge ? zero : hn::Neg(x[1])};
    const V by_s[4] = {wedge ? hn::Neg(one) : hn::Neg(r1), wedge ? zero : hn::Neg(x[0]), wedge ? one : x[0],
                       wedge ? zero : r1};
    V flat[4];
    flat[0] = wedge ? r1 - x[1] : r1 * s1;
    flat[1] = wedge ? x[0] : x[0] * s1;
    flat[2] = wedge ? x[1] : x[0] * x[1];
    flat[3] = wedge ? zero : r1 * x[1];
    Linear out;
    for (int k = 0; k < 3; ++k) {
        V low[3] = {zero, zero, zero}, high[3] = {zero, zero, zero};
        for (int i = 0; i < 4; ++i) {
            low[0] = hn::MulAdd(by_r[i], q[i][k], low[0]);
            low[1] = hn::MulAdd(by_s[i], q[i][k], low[1]);
            low[2] = hn::MulAdd(flat[i], q[i][k], low[2]);
            high[0] = hn::MulAdd(by_r[i], q[i + 4][k], high[0]);
            high[1] = hn::MulAdd(by_s[i], q[i + 4][k], high[1]);
            high[2] = hn::MulAdd(flat[i], q[i + 4][k], high[2]);
        }
        for (int j = 0; j < 2; ++j) out.jacobian[k][j] = hn::MulAdd(t1, low[j], x[2] * high[j]);
        out.jacobian[k][2] = high[2] - low[2];
        out.rest[k] = hn::MulAdd(t1, low[2], x[2] * high[2]);
    }
    return out;
}

/// About its inverse, by cofactors; not finite where it is singular.
HWY_INLINE void invert(D tag, const V (&a)[3][3], V (&y)[3][3]) {
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        for (int c = 0; c < 3; ++c) {
            const int e = (c + 1) % 3, f = (c + 2) % 3;
            y[c][i] = a[j][e] * a[k][f] - a[j][f] * a[k][e];
        }
    }
    const V det = a[0][0] * y[0][0] + a[0][1] * y[1][0] + a[0][2] * y[2][0];
    const V by = hn::Set(tag, 1) / det;
    for (auto& row : y) {
        for (V& entry : row) entry = entry * by;
    }
}

HWY_INLINE V largest(const V (&v)[3]) {
    return hn::Max(hn::Max(hn::Abs(v[0]), hn::Abs(v[1])), hn::Abs(v[2]));
}

/// Lanes from `first` on of row i of an array.
HWY_INLINE V row_of(D tag, const double* rows, std::size_t i, std::size_t first) {
    return hn::LoadU(tag, rows + i * max_lanes + first);
}

/// The nodes from the point, also rounded, and Q.
template <LaneElement element>
struct Offsets {
    DoubleDouble<V> q[lane_nodes(element)][3];
    V high[lane_nodes(element)][3], size;
};

template <LaneElement element>
HWY_INLINE void set_offsets(D tag, const LaneCases& cases, std::size_t first, Offsets<element>& out) {
    out.size = hn::Zero(tag);
    for (std::size_t i = 0; i < lane_nodes(element); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const V p = row_of(tag, cases.point, k, first);
            DoubleDouble<V>& q = out.q[i][k];
            q = two_difference(row_of(tag, cases.places, 3 * i + k, first), p);
            if (Bounds<element>::simplex && i >= 4) {
                const V half = hn::Set(tag, 0.5);
                q = q + two_difference(row_of(tag, cases.others, 3 * (i - 4) + k, first), p);
                q = {q.high * half, q.low * half};
            }
            out.high[i][k] = q.high;
            out.size = hn::Max(out.size, hn::Abs(q.high));
        }
    }
}

/// Newton's method: x, the Jacobian there and Y. Where x is far from the reference cell nothing stays certain.
template <LaneElement element>
HWY_INLINE void search(D tag, const Offsets<element>& from, V (&x)[3], Linear& at, V (&y)[3][3], Mask& certain) {
    using B = Bounds<element>;
    const V one = hn::Set(tag, 1), zero = hn::Zero(tag);
    const V across = hn::Set(tag, B::simplex ? 0.25 : element == LaneElement::wedge ? 1.0 / 3 : 0.5);
    x[0] = x[1] = across;
    x[2] = hn::Set(tag, B::simplex ? 0.25 : 0.5);
    at = linearise<element>(tag, x, from.high);
    for (int step = 0; step < 12; ++step) {
        invert(tag, at.jacobian, y);
        V moved = zero;
        for (int k = 0; k < 3; ++k) {
            const V by = y[k][0] * at.rest[0] + y[k][1] * at.rest[1] + y[k][2] * at.rest[2];
            moved = hn::Max(moved, hn::Abs(by));
            x[k] = x[k] - hn::Max(hn::Min(by, one), hn::Neg(one));
        }
        at = linearise<element>(tag, x, from.high);
        if (hn::AllFalse(tag, hn::And(certain, hn::Gt(moved, hn::Set(tag, 0x1p-26))))) break;
    }
    invert(tag, at.jacobian, y);
    const auto near = [&](V own) HWY_ATTR { return within(tag, own, -0x1p-20, 1 + 0x1p-20); };
    for (const V& own : x) certain = hn::And(certain, near(own));
    if (element != LaneElement::hexahedron)
        certain = hn::And(certain, near(B::simplex ? x[0] + x[1] + x[2] : x[0] + x[1]));
}

/// Sets d; returns e, which bounds how far x - d is off. Where that is not proved nothing stays certain.
template <LaneElement element>
HWY_INLINE V prove(D tag, const Offsets<element>& from, const V (&x)[3], const Linear& at, const V (&y)[3][3],
                   DoubleDouble<V> (&d)[3], Mask& certain) {
    using B = Bounds<element>;
    constexpr double u = 0x1p-53;
    const V one = hn::Set(tag, 1), zero = hn::Zero(tag), more = hn::Set(tag, 1 + 0x1p-40);
    // X(x) - p, and d.
    const DoubleDouble<V> place[3] = {{x[0], zero}, {x[1], zero}, {x[2], zero}};
    DoubleDouble<V> n[lane_nodes(element)], rest[3];
    functions<element>(DoubleDouble<V>{one, zero}, place, n);
    V step[3], rows_of_y[3], m = zero;
    for (int k = 0; k < 3; ++k) {
        rest[k] = n[0] * from.q[0][k];
        for (std::size_t i = 1; i < lane_nodes(element); ++i) rest[k] = rest[k] + n[i] * from.q[i][k];
    }
    for (int k = 0; k < 3; ++k) {
        d[k] = DoubleDouble<V>{y[k][0], zero} * rest[0] + DoubleDouble<V>{y[k][1], zero} * rest[1] +
               DoubleDouble<V>{y[k][2], zero} * rest[2];
        step[k] = d[k].high;
        rows_of_y[k] = hn::Abs(y[k][0]) + hn::Abs(y[k][1]) + hn::Abs(y[k][2]);
    }
    const V y_size = hn::Max(hn::Max(rows_of_y[0], rows_of_y[1]), rows_of_y[2]);
    const V off = hn::Set(tag, B::of_d * u * u) * from.size * y_size;
    const V by = (largest(step) + off) * more, radius = hn::Set(tag, 4) * by + hn::Set(tag, 0x1p-45);
    for (int r = 0; r < 3; ++r) {
        V sum = zero;
        for (int c = 0; c < 3; ++c) {
            const V product = y[r][0] * at.jacobian[0][c] + y[r][1] * at.jacobian[1][c] + y[r][2] * at.jacobian[2][c];
            sum = sum + hn::Abs(r == c ? one - product : product);
        }
        const V around = hn::Set(tag, B::around * u) + hn::Set(tag, B::over_box) * radius;
        m = hn::Max(m, sum + hn::Set(tag, 3) * around * from.size * rows_of_y[r]);
    }
    m = m * more;
    certain = hn::And(certain, hn::And(hn::Lt(m, hn::Set(tag, 0.25)), hn::Le(radius, hn::Set(tag, 0x1p-20))));
    certain = hn::And(certain, hn::Le(y_size, hn::Set(tag, 0x1p330)));
    return (hn::Set(tag, 2) * by * m + off + hn::Set(tag, 5 * u * u)) * more;
}

/// Sets the place x - d, which is off by at most `error`; returns where it is inside. Where it is outside nothing stays
/// certain.
template <LaneElement element>
HWY_INLINE Mask inside_of(D tag, const V (&x)[3], const DoubleDouble<V> (&d)[3], V error, DoubleDouble<V> (&place)[3],
                          Mask& certain) {
    constexpr bool simplex = Bounds<element>::simplex;
    const V one = hn::Set(tag, 1);
    // Each sum below is off by less than 4 u.
    const V blur = hn::Set(tag, 3) * error + hn::Set(tag, 8 * 0x1p-53);
    Mask inside = certain;
    for (int k = 0; k < 3; ++k) {
        place[k] = DoubleDouble<V>{x[k], hn::Zero(tag)} - d[k];
        V room = place[k].high;
        if (element == LaneElement::hexahedron || (k == 2 && !simplex)) room = hn::Min(room, one - room);
        if (k == 1 && element == LaneElement::wedge) room = hn::Min(room, one - place[0].high - place[1].high);
        if (k == 2 && simplex) room = hn::Min(room, one - place[0].high - place[1].high - place[2].high);
        inside = hn::And(inside, hn::Gt(room, blur));
        certain = hn::And(certain, hn::Ge(room, hn::Neg(blur)));  // else another point that is taken there
    }
    return inside;
}

/// Writes the values at the place, which is off by at most `error`. Where one's rounding is not certain nothing stays
/// so.
template <LaneElement element>
HWY_INLINE void write_values(D tag, const LaneCases& cases, std::size_t first, const DoubleDouble<V> (&place)[3],
                             V error, Mask& certain) {
    using B = Bounds<element>;
    constexpr std::size_t nodes = lane_nodes(element);
    constexpr double u = 0x1p-53;
    const V zero = hn::Zero(tag);
    DoubleDouble<V> n[nodes];
    functions<element>(DoubleDouble<V>{hn::Set(tag, 1), zero}, place, n);
    for (std::size_t c = 0; c < cases.components; ++c) {
        V most = zero;
        DoubleDouble<V> value{zero, zero};
        for (std::size_t i = 0; i < nodes; ++i) {
            const V f = row_of(tag, cases.values, nodes * c + i, first);
            most = hn::Max(most, hn::Abs(f));
            const DoubleDouble<V> term = n[i] * DoubleDouble<V>{f, zero};
            value = i == 0 ? term : value + term;
        }
        const V bound = most * (hn::Set(tag, B::of_point) * error + hn::Set(tag, B::of_sum * u * u));
        certain = hn::And(certain, hn::Or(within(tag, most, 0x1p-300, 0x1p300), hn::Eq(most, zero)));
        const V rounded = core::HWY_NAMESPACE::rounded_sum(tag, value.high, value.low, bound, certain) + zero;
        hn::StoreU(rounded, tag, cases.out + c * max_lanes + first);
    }
}

template <LaneElement element>
void evaluate_some(const LaneCases& cases, std::size_t first, LanesProved& proved) {
    const D tag;
    Offsets<element> from;
    set_offsets<element>(tag, cases, first, from);
    Mask certain = within(tag, from.size, 0x1p-300, 0x1p300);
    V x[3], y[3][3];
    Linear at;
    search<element>(tag, from, x, at, y, certain);
    DoubleDouble<V> d[3], place[3];
    const V error = prove<element>(tag, from, x, at, y, d, certain);
    const Mask inside = inside_of<element>(tag, x, d, error, place, certain);
    write_values<element>(tag, cases, first, place, error, certain);
    const auto bits_of = [&](Mask mask) HWY_ATTR {
        const std::size_t count = std::min(hn::Lanes(tag), cases.count - first);
        return (core::HWY_NAMESPACE::mask_bits(tag, mask) & ((std::uint32_t{1} << count) - 1)) << first;
    };
    proved.inside |= bits_of(inside);
    proved.values |= bits_of(certain);
}

LanesProved evaluate_all(const LaneCases& cases) {
    LanesProved proved;
    for (std::size_t first = 0; first < cases.count; first += hn::Lanes(D())) {
        if (cases.element == LaneElement::hexahedron) evaluate_some<LaneElement::hexahedron>(cases, first, proved);
        if (cases.element == LaneElement::wedge) evaluate_some<LaneElement::wedge>(cases, first, proved);
        if (cases.element == LaneElement::tetrahedron) evaluate_some<LaneElement::tetrahedron>(cases, first, proved);
    }
    return proved;
}

}  // namespace barycert::core::isoparametric::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::core::isoparametric {

HWY_EXPORT(evaluate_all);

LanesProved evaluate_lanes(const LaneCases& cases) {
    return HWY_DYNAMIC_DISPATCH(evaluate_all)(cases);
}

}  // namespace barycert::core::isoparametric
#endif

// Krawczyk's operator (inverse.hpp) in double, and one step of Newton's method and the value in double-double.
//
// u = 2^-53; q_i = p_i - p exactly, as double-double; Q the largest |q_i| by coordinates, F the largest |f_i|. x, found
// in double, is taken as exact. Near the reference cell, with coordinates in [-2^-20, 1 + 2^-20]:
//   sums over the corners   sum |N_i| <= 1 + 2^-17, sum |dN_i / dx_j| <= 2 + 2^-16, sum |d2 N_i / dx_j dx_k| <= 4 +
//   2^-16
//                           (of a wedge as well; second derivatives by one coordinate are zero)
//   X'                      computed in double: off by at most 24 u (2 + 2^-16) Q < 49 u Q. Over the box of radius R
//                           around x it changes by at most 2 R (4 + 2^-10) Q < 9 R Q, for R <= 2^-20.
//   m                       |1 - Y X'| by rows, computed: off by at most 8 u |Y| |X'|, with |X'| <= 3 Q: 24 u Q |Y|. So
//                           m <= max over rows of sum |(1 - Y X')_rc| + 3 (73 u + 9 R) Q sum_k |Y_rk|.
//   X(x) - p                in double-double: factors 1 - r are exact, two products of them off by 18 u^2, the product
//                           with q by 9 u^2, seven sums by 28 u^2: 56 u^2 Q in all.
//   d = Y (X(x) - p)        products by 9 u^2, sums by 8 u^2: off by (56 Q + 17 |X(x) - p|) u^2 |Y|, |X(x) - p| <= 1.1
//   Q:
//                           80 u^2 Q |Y|.
//   the point               x - d, with a sum rounded by 4 u^2 (1 + R): off by e = 2 |d| m + 80 u^2 Q |Y| + 5 u^2.
//   the value               3 (2 + 2^-16) e F < 6.1 e F from the point; in double-double factors 1 - r by 5 u^2 each,
//                           products by 18 u^2, with f by 9 u^2, sums by 28 u^2: 70 u^2 F.
// Bounds are computed in double: 1 + 2^-40 covers that. Ranges outside which nothing is certain: Q and F in
// [2^-300, 2^300], or F = 0; then nothing under- or overflows: |Y| <= 2^330 as |Y| Q >= 1/3 - m, and is asked for.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/core/isoparametric/lanes.cpp"
#include "barycert/core/foreach_target.hpp"
// After the targets.
#include "barycert/core/isoparametric/lanes.hpp"
#include "barycert/core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::isoparametric::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using core::HWY_NAMESPACE::DoubleDouble;
using core::HWY_NAMESPACE::two_difference;
using D = hn::CappedTag<double, max_lanes>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;

HWY_INLINE V minus(D tag, V x, V y) {
    static_cast<void>(tag);
    return x - y;
}
HWY_INLINE DoubleDouble<V> minus(D tag, const DoubleDouble<V>& x, const DoubleDouble<V>& y) {
    static_cast<void>(tag);
    return x - y;
}

/// Functions of four corners round a layer, and their sums with 1 - t and t.
template <class N>
HWY_INLINE void functions(D tag, bool wedge, const N& one, const N (&x)[3], N (&n)[8]) {
    const N r1 = minus(tag, one, x[0]), s1 = minus(tag, one, x[1]), t1 = minus(tag, one, x[2]);
    N flat[4];
    if (wedge) {
        flat[0] = minus(tag, r1, x[1]);
        flat[1] = x[0];
        flat[2] = x[1];
        flat[3] = minus(tag, one, one);
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

/// X(x) - p and its Jacobian in double.
struct Linear {
    V rest[3], jacobian[3][3];
};

HWY_INLINE Linear linearise(D tag, bool wedge, const V (&x)[3], const V (&q)[8][3]) {
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

HWY_INLINE Mask in_range(D tag, V size) {
    return hn::And(hn::Ge(size, hn::Set(tag, 0x1p-300)), hn::Le(size, hn::Set(tag, 0x1p300)));
}

void evaluate_some(const LaneCases& cases, std::size_t first, LanesProved& proved) {
    const D tag;
    constexpr double u = 0x1p-53;
    const V one = hn::Set(tag, 1), zero = hn::Zero(tag), more = hn::Set(tag, 1 + 0x1p-40);
    const auto row = [&](const double* rows, std::size_t i)
                         HWY_ATTR { return hn::LoadU(tag, rows + i * max_lanes + first); };
    DoubleDouble<V> q[8][3];
    V high[8][3], size = zero;
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            q[i][k] = two_difference(row(cases.places, 3 * i + k), row(cases.point, k));
            high[i][k] = q[i][k].high;
            size = hn::Max(size, hn::Abs(q[i][k].high));
        }
    }
    Mask certain = in_range(tag, size);
    const V third = hn::Set(tag, cases.wedge ? 1.0 / 3 : 0.5);
    V x[3] = {third, third, hn::Set(tag, 0.5)}, y[3][3];
    Linear at = linearise(tag, cases.wedge, x, high);
    for (int step = 0; step < 12; ++step) {
        invert(tag, at.jacobian, y);
        V moved = zero;
        for (int k = 0; k < 3; ++k) {
            const V by = y[k][0] * at.rest[0] + y[k][1] * at.rest[1] + y[k][2] * at.rest[2];
            moved = hn::Max(moved, hn::Abs(by));
            x[k] = x[k] - hn::Max(hn::Min(by, one), hn::Neg(one));
        }
        at = linearise(tag, cases.wedge, x, high);
        if (hn::AllFalse(tag, hn::And(certain, hn::Gt(moved, hn::Set(tag, 0x1p-26))))) break;
    }
    invert(tag, at.jacobian, y);
    for (const V& own : x)
        certain =
            hn::And(certain, hn::And(hn::Ge(own, hn::Set(tag, -0x1p-20)), hn::Le(own, hn::Set(tag, 1 + 0x1p-20))));

    // X(x) - p, and d.
    const DoubleDouble<V> unit{one, zero};
    DoubleDouble<V> from[3] = {{x[0], zero}, {x[1], zero}, {x[2], zero}}, n[8], rest[3], d[3];
    functions(tag, cases.wedge, unit, from, n);
    V step[3], rows_of_y[3], m = zero;
    for (int k = 0; k < 3; ++k) {
        rest[k] = n[0] * q[0][k];
        for (int i = 1; i < 8; ++i) rest[k] = rest[k] + n[i] * q[i][k];
    }
    for (int k = 0; k < 3; ++k) {
        d[k] = DoubleDouble<V>{y[k][0], zero} * rest[0] + DoubleDouble<V>{y[k][1], zero} * rest[1] +
               DoubleDouble<V>{y[k][2], zero} * rest[2];
        step[k] = d[k].high;
        rows_of_y[k] = hn::Abs(y[k][0]) + hn::Abs(y[k][1]) + hn::Abs(y[k][2]);
    }
    const V y_size = hn::Max(hn::Max(rows_of_y[0], rows_of_y[1]), rows_of_y[2]);
    const V off = hn::Set(tag, 80 * u * u) * size * y_size;
    const V by = (largest(step) + off) * more, radius = hn::Set(tag, 4) * by + hn::Set(tag, 0x1p-45);
    for (int r = 0; r < 3; ++r) {
        V sum = zero;
        for (int c = 0; c < 3; ++c) {
            const V product = y[r][0] * at.jacobian[0][c] + y[r][1] * at.jacobian[1][c] + y[r][2] * at.jacobian[2][c];
            sum = sum + hn::Abs(r == c ? one - product : product);
        }
        const V around = hn::Set(tag, 73 * u) + hn::Set(tag, 9) * radius;
        m = hn::Max(m, sum + hn::Set(tag, 3) * around * size * rows_of_y[r]);
    }
    m = m * more;
    certain = hn::And(certain, hn::And(hn::Lt(m, hn::Set(tag, 0.25)), hn::Le(radius, hn::Set(tag, 0x1p-20))));
    certain = hn::And(certain, hn::Le(y_size, hn::Set(tag, 0x1p330)));
    const V error = (hn::Set(tag, 2) * by * m + off + hn::Set(tag, 5 * u * u)) * more;
    Mask inside = certain;
    for (int k = 0; k < 3; ++k) {
        from[k] = from[k] - d[k];
        V room = from[k].high;  // each sum is off by less than 2 u
        if (k == 2 || !cases.wedge) room = hn::Min(room, one - room);
        if (k == 1 && cases.wedge) room = hn::Min(room, one - from[0].high - from[1].high);
        inside = hn::And(inside, hn::Gt(room, hn::Set(tag, 3) * error + hn::Set(tag, 8 * u)));
    }
    functions(tag, cases.wedge, unit, from, n);
    for (std::size_t c = 0; c < cases.components; ++c) {
        V most = zero;
        DoubleDouble<V> value{zero, zero};
        for (std::size_t i = 0; i < 8; ++i) {
            const V f = row(cases.values, 8 * c + i);
            most = hn::Max(most, hn::Abs(f));
            const DoubleDouble<V> term = n[i] * DoubleDouble<V>{f, zero};
            value = i == 0 ? term : value + term;
        }
        const V bound = most * (hn::Set(tag, 6.1) * error + hn::Set(tag, 70 * u * u)) * more +
                        hn::Set(tag, 0x1p-52) * hn::Abs(value.low);
        certain = hn::And(certain, hn::Or(in_range(tag, most), hn::Eq(most, zero)));
        const V rounded = core::HWY_NAMESPACE::rounded_if_certain<D>(value.high, value.low, bound, certain) + zero;
        hn::StoreU(rounded, tag, cases.out + c * max_lanes + first);
    }
    const auto bits_of = [&](Mask mask) HWY_ATTR {
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(tag, mask, bits);
        const std::uint32_t all = bits[0] | static_cast<std::uint32_t>(bits[1]) << 8;
        const std::size_t count = std::min(hn::Lanes(tag), cases.count - first);
        return (all & ((std::uint32_t{1} << count) - 1)) << first;
    };
    proved.inside |= bits_of(inside);
    proved.values |= bits_of(certain);
}

LanesProved evaluate_all(const LaneCases& cases) {
    LanesProved proved;
    for (std::size_t first = 0; first < cases.count; first += hn::Lanes(D())) evaluate_some(cases, first, proved);
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

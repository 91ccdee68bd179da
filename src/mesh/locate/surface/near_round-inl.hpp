// Internal: which feature of a triangle is nearest to a point, and the nearest point, correctly rounded.
//
// Let w = p - a, e = b - a, f = c - a, and W, E the sums over the axes of |w| and of the larger of |e|, |f|.
//
// Which feature, in plain double, u = 2^-53. A product w.e or e.f is off by at most 5 u W E or 5 u E^2: a rounding of
// each difference, one of the product, two of sums. The numerators of b and c in the projection to the plane,
// (w.e)(f.f) - (w.f)(e.f) and (w.f)(e.e) - (w.e)(e.f), by at most 2 (5 + 5 + 2) u W E^3, and det = (e.e)(f.f) - (e.f)^2
// by 24 u E^4: 64 u is used for each and for what is made of two of them, 16 u for the first. A feature is certain if
// all of these signs are:
//   vertex a   w.e < 0 and w.f < 0
//   edge ab    0 < w.e < e.e, and the numerator of c is negative
//   face       both numerators are positive, and their sum is below det
// which are sufficient for a point of a convex triangle to be the nearest (near_feature.cpp), though the first two ask
// for more than equality. Corners take turns as a.
//
// The nearest point, in double-double (error_free-inl.hpp), u^2 = 2^-106. Differences are exact. Weights are quotients
// n / d of numerators and denominator that are off by at most 17 u^2 W E and 17 u^2 E^2 (edge), or 528 u^2 W E^3 and
// 528 u^2 E^4 (face: 12 monomials, 44 u^2 each: refinement-inl.hpp); l = fl(n / d) and c = (n - l d) / d: off by at
// most 1.01 (E_n + l E_d) / d + 25 u^2 l. The point a + s e + t f, and y = w - s e - t f, are then off on each axis by
// the errors of s and t times |e| and |f|, and 9 u^2 of each product, 4 u^2 of each sum: 20 u^2 of |a| (or |w|) + |e| +
// |f|. The square of the distance by 2 sum |y_k| times that of y_k, its square, and 26 u^2 of itself; its root r,
// corrected by (q - r^2) / 2 r, by the error of q over r and 4 u^2 r. A number high + low with an error below b is
// rounded correctly if high + (low - b) and high + (low + b) round to the same double: sums of two doubles are rounded
// once.
//
// Numbers are at most 16, and nothing is certain if E or the distance is below 2^-100 but zero: nothing underflows.
//
// Included once per SIMD target.
#if defined(BARYCERT_LOCATE_NEAR_ROUND_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_LOCATE_NEAR_ROUND_INL_HPP
#undef BARYCERT_LOCATE_NEAR_ROUND_INL_HPP
#else
#define BARYCERT_LOCATE_NEAR_ROUND_INL_HPP
#endif

#include "mesh/locate/surface/near_lanes-inl.hpp"
#include "mesh/locate/surface/surface_data.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate::HWY_NAMESPACE {

/// One pair a lane.
struct Pairs {
    Lanes p[3], at[3][3];

    HWY_INLINE Pairs(const NearPair* pairs, std::size_t count) {
        HWY_ALIGN double rows[12][width];
        for (std::size_t l = 0; l < width; ++l) {
            const NearPair& pair = pairs[std::min(l, count - 1)];
            for (std::size_t k = 0; k < 3; ++k) {
                rows[k][l] = pair.point[k];
                for (std::size_t i = 0; i < 3; ++i) rows[3 + 3 * i + k][l] = pair.at[i][k];
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = hn::Load(Tag(), rows[k]);
            for (std::size_t i = 0; i < 3; ++i) at[i][k] = hn::Load(Tag(), rows[3 + 3 * i + k]);
        }
    }
};

HWY_INLINE Lanes set(double x) {
    return hn::Set(Tag(), x);
}

void classify(const NearPair* pairs, std::size_t count, std::uint8_t* masks) {
    constexpr double u = 0x1p-53;
    const Lanes zero = set(0);
    for (std::size_t first = 0; first < count; first += width) {
        const std::size_t here = std::min(width, count - first);
        const Pairs at(pairs + first, here);
        Lanes found = zero;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, m = (i + 2) % 3;
            Lanes w[3], e[3], f[3], big_w = zero, big_e = zero;
            for (int k = 0; k < 3; ++k) {
                w[k] = at.p[k] - at.at[i][k];
                e[k] = at.at[j][k] - at.at[i][k];
                f[k] = at.at[m][k] - at.at[i][k];
                big_w = big_w + hn::Abs(w[k]);
                big_e = big_e + hn::Max(hn::Abs(e[k]), hn::Abs(f[k]));
            }
            const Lanes we = dot(w, e), wf = dot(w, f), ee = dot(e, e), ef = dot(e, f), ff = dot(f, f);
            const Lanes of_w = set(16 * u) * big_w * big_e, of_e = set(16 * u) * big_e * big_e;
            const auto vertex = hn::And(hn::Lt(we, hn::Neg(of_w)), hn::Lt(wf, hn::Neg(of_w)));
            const Lanes n_b = we * ff - wf * ef, n_c = wf * ee - we * ef, det = ee * ff - ef * ef;
            const Lanes cube = big_e * big_e * big_e, of_n = set(64 * u) * big_w * cube,
                        of_det = set(64 * u) * big_e * cube;
            const auto on_edge = hn::And(hn::Gt(we, of_w), hn::Gt(ee - we, of_w + of_e));
            const auto edge = hn::And(on_edge, hn::Lt(n_c, hn::Neg(of_n)));
            const auto put = [&](Mask here_it_is, unsigned mask)
                                 HWY_ATTR { found = hn::IfThenElse(here_it_is, set(mask), found); };
            put(vertex, 1U << i);
            put(edge, 1U << i | 1U << j);
            if (i == 0)
                put(hn::And(hn::And(hn::Gt(n_b, of_n), hn::Gt(n_c, of_n)),
                            hn::Gt(det - (n_b + n_c), of_n + of_n + of_det)),
                    7);
            found = hn::IfThenElse(hn::Ge(big_e, set(0x1p-100)), found, zero);
        }
        HWY_ALIGN double out[width];
        hn::Store(found, Tag(), out);
        for (std::size_t l = 0; l < here; ++l) masks[first + l] = static_cast<std::uint8_t>(out[l]);
    }
}

/// A number and a bound of its error.
struct Bounded {
    Wide value;
    Lanes error;
};

HWY_INLINE Bounded quotient(const Wide& n, Lanes of_n, const Wide& d, Lanes of_d) {
    const Lanes l = n.high / d.high;
    const TwoTerms<Lanes> product = two_product(l, d.high);
    const Lanes c = ((n.high - product.high) - product.low + (n.low - l * d.low)) / d.high;
    const Lanes error = set(1.02) * (of_n + hn::Abs(l) * of_d) / d.high + set(25 * 0x1p-106) * hn::Abs(l);
    return {quick_two_sum(l, c), error};
}

/// The rounded number; takes lanes out of `certain`.
HWY_INLINE Lanes rounded(const Bounded& x, Mask& certain) {
    // A little more for the roundings of low - b and low + b themselves.
    const Lanes b = x.error * set(1 + 0x1p-20) + hn::Abs(x.value.low) * set(0x1p-51);
    const Lanes low = x.value.high + (x.value.low - b), high = x.value.high + (x.value.low + b);
    certain = hn::And(certain, hn::Eq(low, high));
    return low;
}

template <int corners>
HWY_INLINE void round_lanes(const Pairs& at, Lanes (&out)[7], Mask& certain) {
    constexpr double uu = 0x1p-106;
    const Lanes zero = set(0), one = set(1);
    Wide w[3], e[3], f[3];
    Lanes big_w = zero, big_e = zero;
    for (int k = 0; k < 3; ++k) {
        w[k] = two_difference(at.p[k], at.at[0][k]);
        e[k] = two_difference(corners > 1 ? at.at[1][k] : at.at[0][k], at.at[0][k]);
        f[k] = two_difference(corners > 2 ? at.at[2][k] : at.at[0][k], at.at[0][k]);
        big_w = big_w + hn::Abs(w[k].high);
        big_e = big_e + hn::Max(hn::Abs(e[k].high), hn::Abs(f[k].high));
    }
    big_w = big_w * set(1 + 0x1p-50);
    big_e = big_e * set(1 + 0x1p-50);
    Bounded s{{zero, zero}, zero}, t = s;
    certain = hn::Eq(zero, zero);
    if constexpr (corners == 2) {
        const Lanes factor = set(18 * uu) * big_e;
        s = quotient(dot(w, e), factor * big_w, dot(e, e), factor * big_e);
    } else if constexpr (corners == 3) {
        Wide n[3], wf[3], ew[3];
        cross(e, f, n);
        cross(w, f, wf);
        cross(e, w, ew);
        const Wide d = dot(n, n);
        const Lanes factor = set(530 * uu) * big_e * big_e * big_e;
        certain = hn::Gt(d.high * set(0x1p-10), factor * big_e);
        s = quotient(dot(wf, n), factor * big_w, d, factor * big_e);
        t = quotient(dot(ew, n), factor * big_w, d, factor * big_e);
    }
    if constexpr (corners > 1) certain = hn::And(certain, hn::Ge(big_e, set(0x1p-100)));
    Wide q{zero, zero};
    Lanes q_error = zero;
    for (int k = 0; k < 3; ++k) {
        const Wide step = corners == 1   ? Wide{zero, zero}
                          : corners == 2 ? s.value * e[k]
                                         : s.value * e[k] + t.value * f[k];
        const Lanes parts = s.error * hn::Abs(e[k].high) + t.error * hn::Abs(f[k].high);
        const Lanes size = hn::Abs(e[k].high) + hn::Abs(f[k].high);
        const Wide x = Wide{at.at[0][k], zero} + step, y = w[k] - step;
        const Lanes x_error = corners == 1 ? zero : parts * set(1.01) + set(20 * uu) * (hn::Abs(at.at[0][k]) + size);
        const Lanes y_error = corners == 1 ? zero : parts * set(1.01) + set(20 * uu) * (hn::Abs(w[k].high) + size);
        out[1 + k] = corners == 1 ? at.at[0][k] : rounded({x, x_error}, certain);
        q = q + y * y;
        q_error = q_error + y_error * (set(2.01) * hn::Abs(y.high) + y_error);
    }
    q_error = q_error + set(26 * uu) * q.high;
    const Lanes r = hn::Sqrt(q.high);
    const TwoTerms<Lanes> square = two_product(r, r);
    const Lanes more = ((q.high - square.high) - square.low + q.low) / (r + r);
    const Lanes distance = rounded({quick_two_sum(r, more), set(1.01) * q_error / r + set(8 * uu) * r}, certain);
    const auto at_it = hn::And(hn::Eq(q.high, zero), set(corners) == one);
    out[0] = hn::IfThenElse(at_it, zero, distance);
    certain = hn::And(hn::Or(certain, at_it), hn::Or(at_it, hn::Ge(r, set(0x1p-100))));
    const Wide rest = Wide{one, zero} - s.value - t.value;
    out[4] = corners == 1 ? one : rounded({rest, (s.error + t.error) * set(1.01) + set(40 * uu)}, certain);
    out[5] = corners == 1 ? zero : rounded(s, certain);
    out[6] = corners < 3 ? zero : rounded(t, certain);
}

void round_all(const NearPair* pairs, std::size_t count, int corners, NearRounded* to) {
    for (std::size_t first = 0; first < count; first += width) {
        const std::size_t here = std::min(width, count - first);
        const Pairs at(pairs + first, here);
        Lanes out[7];
        Mask certain;
        corners == 1   ? round_lanes<1>(at, out, certain)
        : corners == 2 ? round_lanes<2>(at, out, certain)
                       : round_lanes<3>(at, out, certain);
        HWY_ALIGN double rows[7][width];
        for (int i = 0; i < 7; ++i) hn::Store(out[i], Tag(), rows[i]);
        const std::uint32_t bits = mask_bits(Tag(), certain);
        for (std::size_t l = 0; l < here; ++l) {
            NearRounded& one = to[first + l];
            one.distance = rows[0][l];
            for (std::size_t k = 0; k < 3; ++k) one.at[k] = rows[1 + k][l], one.weights[k] = rows[4 + k][l];
            one.certain = (bits >> l & 1) != 0;
        }
    }
}

}  // namespace barycert::locate::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

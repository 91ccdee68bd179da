// Bounds of the distance of a point p from a triangle a, a + e, a + f. Let u = 2^-53, w = p - a, and m the sum over the
// axes of |w| + |e| + |f|, all as computed: differences are off by a part u of themselves.
//
// For numbers s, t >= 0 with s + t <= 1, up to a rounding, x = a + s e + t f is a point of the triangle, up to 2 u m;
// how s and t were found does not matter. y = w - s e - t f is p - x, off by at most 4 u times that axis' part of m. So
// q = y.y is |p - x|^2 but for (2 * 4 + 3) u m^2 and what is of u^2, and the triangle has a point as near but for 4 u
// m^2 more. No point of it is nearer than |p - x|^2 - 2 max over its corners c of y.(c - x), which is 2 (max(0, y.e,
// y.f) - (s y.e + t y.f)): each product is off by 7 u m^2, all of it by less than 40. Together less than 55 u m^2, and
// 128 is used; what underflows is below 2^-1000, as all numbers but products are at most 2^8. None of this asks for an
// area: where a triangle has none, quotients by zero may be NaN, and what is NaN leaves nothing out.
//
// The distance of p from a box takes a difference an axis, squares and sums: a part 4 u of itself, and 8 is used.
#include "mesh/locate/surface/surface_data.hpp"

#include <tbb/parallel_invoke.h>

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/locate/surface/nearest_lanes.cpp"
#include "core/foreach_target.hpp"

#include "core/error_free-inl.hpp"
#include "core/lane_loop-inl.hpp"
#include "core/numerators-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Lanes = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;
using Wide = DoubleDouble<Lanes>;
inline constexpr std::size_t width = hn::MaxLanes(Tag());

/// A bit for each box that may have a point nearer than sqrt(best), and the squares of the distances.
HWY_INLINE unsigned near_boxes(const NearGroups::Boxes& boxes, const double (&p)[3], double best, double (&key)[8]) {
    const Tag tag;
    unsigned bits = 0;
    for (std::size_t l = 0; l < 8; l += width) {
        Lanes q = hn::Zero(tag);
        for (int k = 0; k < 3; ++k) {
            const Lanes x = hn::Set(tag, p[k]);
            const Lanes away = hn::Max(
                hn::Max(hn::Load(tag, boxes.low[k] + l) - x, x - hn::Load(tag, boxes.high[k] + l)), hn::Zero(tag));
            q = hn::MulAdd(away, away, q);
        }
        hn::Store(q, tag, key + l);
        const auto near = hn::Le(q * hn::Set(tag, 1 - 0x1p-50), hn::Set(tag, best));
        bits |= mask_bits(tag, near) << l;
    }
    return bits;
}

HWY_INLINE Lanes fused(const Lanes (&x)[3], const Lanes (&y)[3]) {
    return hn::MulAdd(x[2], y[2], hn::MulAdd(x[1], y[1], x[0] * y[0]));
}

/// Squares of distances of eight triangles: no point is nearer than `low`, some point is as near as `high`.
HWY_INLINE void bounds(const NearGroups::Triangles& t, const double (&p)[3], double (&low)[8], double (&high)[8]) {
    const Tag tag;
    const Lanes zero = hn::Zero(tag), one = hn::Set(tag, 1.0), two = hn::Set(tag, 2.0);
    for (std::size_t l = 0; l < 8; l += width) {
        Lanes w[3], e[3], f[3], size = zero;
        for (int k = 0; k < 3; ++k) {
            const Lanes a = hn::Load(tag, t.at[0][k] + l);
            w[k] = hn::Set(tag, p[k]) - a;
            e[k] = hn::Load(tag, t.at[1][k] + l) - a;
            f[k] = hn::Load(tag, t.at[2][k] + l) - a;
            size = size + (hn::Abs(w[k]) + (hn::Abs(e[k]) + hn::Abs(f[k])));
        }
        const Lanes ee = fused(e, e), ef = fused(e, f), ff = fused(f, f), we = fused(w, e), wf = fused(w, f);
        // The nearest point of each edge, by how much nearer it is than the first corner.
        const auto unit = [&](Lanes x) HWY_ATTR { return hn::Min(hn::Max(x, zero), one); };
        Lanes s = unit(we / ee), t2 = zero, best = s * (s * ee - two * we);
        const Lanes on_f = unit(wf / ff), of_f = on_f * (on_f * ff - two * wf);
        const auto f_nearer = hn::Lt(of_f, best);
        s = hn::IfThenElse(f_nearer, zero, s);
        t2 = hn::IfThenElse(f_nearer, on_f, t2);
        best = hn::Min(best, of_f);
        const Lanes r = unit(((wf - we) + (ee - ef)) / ((ee - ef) + (ff - ef))), r1 = one - r;
        const Lanes of_r = r1 * (r1 * ee - two * we) + r * (r * ff - two * wf) + two * r * r1 * ef;
        const auto r_nearer = hn::Lt(of_r, best);
        s = hn::IfThenElse(r_nearer, r1, s);
        t2 = hn::IfThenElse(r_nearer, r, t2);
        // Or within.
        const Lanes det = ee * ff - ef * ef, s0 = we * ff - wf * ef, t0 = wf * ee - we * ef;
        const auto within = hn::And(hn::And(hn::Gt(s0, zero), hn::Gt(t0, zero)), hn::Lt(s0 + t0, det));
        const Lanes inverse = one / det;
        s = unit(hn::IfThenElse(within, s0 * inverse, s));
        t2 = hn::Min(hn::Max(hn::IfThenElse(within, t0 * inverse, t2), zero), one - s);
        Lanes y[3];
        for (int k = 0; k < 3; ++k) y[k] = w[k] - s * e[k] - t2 * f[k];
        const Lanes q = fused(y, y), ye = fused(y, e), yf = fused(y, f);
        const Lanes beyond = hn::Max(hn::Max(hn::Max(ye, yf), zero) - (s * ye + t2 * yf), zero);
        const Lanes error = hn::MulAdd(hn::Set(tag, 0x1p-46) * size, size, hn::Set(tag, 0x1p-1000));
        hn::Store(q - two * beyond - error, tag, low + l);
        hn::Store(q + error, tag, high + l);
    }
}

struct Open {
    double key;
    std::uint32_t level, group;
};

void candidates(const NearGroups& groups, const double (&p)[3], double square, std::uint32_t& hint,
                NearCandidates& found) {
    HWY_ALIGN double low[8], high[8], key[8];
    found.number.clear();
    found.low.clear();
    double best = std::min(square, std::numeric_limits<double>::max());
    std::size_t room = 64;  // to be filled before those that are farther by now are looked for
    const auto drop_farther = [&] {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < found.number.size(); ++i) {
            if (found.low[i] > best) continue;  // a NaN proves nothing
            found.low[kept] = found.low[i];
            found.number[kept++] = found.number[i];
        }
        found.low.resize(kept);
        found.number.resize(kept);
        room = std::max(room, 2 * kept);
    };
    const auto look = [&](std::size_t group, bool keep) HWY_ATTR {
        bounds(groups.triangles[group], p, low, high);
        const std::size_t here = std::min<std::size_t>(8, groups.count - 8 * group);
        for (std::size_t l = 0; l < here; ++l) {
            if (!(high[l] < best)) continue;
            best = high[l];
            hint = static_cast<std::uint32_t>(8 * group + l);
        }
        if (!keep) return;
        for (std::size_t l = 0; l < here; ++l) {
            if (low[l] > best) continue;
            if (found.number.size() == room) drop_farther();
            found.low.push_back(low[l]);
            found.number.push_back(static_cast<std::uint32_t>(8 * group + l));
        }
    };
    if (hint < groups.count) look(hint / 8, false);
    Open stack[8 * 12];
    std::size_t top = 0;
    stack[top++] = {0, static_cast<std::uint32_t>(groups.levels.size() - 1), 0};
    while (top > 0) {
        const Open now = stack[--top];
        if (now.key > best) continue;
        unsigned bits = near_boxes(groups.boxes[groups.levels[now.level] + now.group], p, best, key);
        // The nearest on top.
        const std::size_t bottom = top;
        for (; bits != 0; bits &= bits - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(bits));
            const double k = key[i] * (1 - 0x1p-50);
            std::size_t at = top++;
            for (; at > bottom && stack[at - 1].key < k; --at) stack[at] = stack[at - 1];
            stack[at] = {k, now.level - 1, static_cast<std::uint32_t>(8 * now.group + i)};
        }
        if (now.level != 0) continue;
        while (top > bottom) {
            const Open group = stack[--top];
            if (!(group.key > best)) look(group.group, true);
        }
    }
    drop_farther();
}

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

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(candidates);
HWY_EXPORT(classify);
HWY_EXPORT(round_all);

void find_candidates(const NearGroups& groups, const double (&point)[3], double square, std::uint32_t& hint,
                     NearCandidates& found) {
    HWY_DYNAMIC_DISPATCH(candidates)(groups, point, square, hint, found);
}

void classify_nearest(const NearPair* pairs, std::size_t count, std::uint8_t* masks) {
    HWY_DYNAMIC_DISPATCH(classify)(pairs, count, masks);
}
void round_nearest(const NearPair* pairs, std::size_t count, int corners, NearRounded* to) {
    HWY_DYNAMIC_DISPATCH(round_all)(pairs, count, corners, to);
}

namespace {

using Middle = std::array<float, 3>;

/// Orders a part so that each half has whole groups, as many as a power of two in the first, and so on.
void halve(std::uint32_t* first, std::uint32_t* last, const std::vector<Middle>& middles) {
    const auto count = static_cast<std::size_t>(last - first);
    if (count <= 8) return;
    Middle low = middles[*first], high = low;
    for (const std::uint32_t* i = first; i != last; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], middles[*i][k]);
            high[k] = std::max(high[k], middles[*i][k]);
        }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    const std::size_t groups = (count + 7) / 8;
    std::uint32_t* const middle = first + 8 * std::bit_floor(groups - 1);
    // Ties by number, so that the order depends on the triangles alone.
    std::nth_element(first, middle, last, [&](std::uint32_t a, std::uint32_t b) {
        return middles[a][axis] != middles[b][axis] ? middles[a][axis] < middles[b][axis] : a < b;
    });
    if (count > 8192) {
        tbb::parallel_invoke([&] { halve(first, middle, middles); }, [&] { halve(middle, last, middles); });
    } else {
        halve(first, middle, middles);
        halve(middle, last, middles);
    }
}

}  // namespace

NearGroups::NearGroups(const CellIndex& index) : count(index.cell_count()) {
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, std::fabs(index.low[k]), std::fabs(index.high[k])});
    std::frexp(largest, &exponent);
    exponent = -exponent;
    if (std::abs(exponent) > 1000) return;
    to_unit = std::ldexp(1, exponent);
    from_unit = std::ldexp(1, -exponent);
    for (std::size_t i = 0; i < index.nodes.size(); ++i) {
        for (const double x : index.nodes[i].at) {
            if (x * to_unit * from_unit != x) return;
        }
    }
    usable = true;
    order.resize(count);
    std::vector<Middle> middles(count);
    base::parallel_for_each(count, 4096, [&](std::size_t i) {
        order[i] = static_cast<std::uint32_t>(i);
        const auto corners = index.corner_points(static_cast<Place>(i));
        for (std::size_t k = 0; k < 3; ++k)
            middles[i][k] = static_cast<float>((corners[0][k] + corners[1][k] + corners[2][k]) * to_unit);
    });
    halve(order.data(), order.data() + count, middles);

    std::vector<std::size_t> sizes{(count + 7) / 8};
    while (sizes.back() > 8) sizes.push_back((sizes.back() + 7) / 8);
    std::size_t all = 0;
    for (const std::size_t size : sizes) {
        levels.push_back(all);
        all += (size + 7) / 8;
    }
    triangles = Buffer<Triangles>(sizes[0]);
    boxes = Buffer<Boxes>(all);
    constexpr double none = std::numeric_limits<double>::infinity();
    for (std::size_t level = 0; level < levels.size(); ++level) {
        base::parallel_for_each((sizes[level] + 7) / 8, 64, [&](std::size_t b) {
            Boxes& to = boxes[levels[level] + b];
            for (std::size_t l = 0; l < 8; ++l) {
                for (int k = 0; k < 3; ++k) to.low[k][l] = none, to.high[k][l] = -none;
                const std::size_t below = 8 * b + l;
                for (std::size_t i = 0; i < 8 && below < sizes[level]; ++i) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        double low = none, high = -none;
                        if (level != 0) {
                            low = boxes[levels[level - 1] + below].low[k][i];
                            high = boxes[levels[level - 1] + below].high[k][i];
                        } else {
                            const std::uint32_t cell = order[std::min(8 * below + i, count - 1)];
                            const auto corners = index.corner_points(static_cast<Place>(cell));
                            for (std::size_t c = 0; c < 3; ++c) {
                                const double x = corners[c][k] * to_unit;
                                triangles[below].at[c][k][i] = x;
                                low = std::min(low, x);
                                high = std::max(high, x);
                            }
                        }
                        to.low[k][l] = std::min(to.low[k][l], low);
                        to.high[k][l] = std::max(to.high[k][l], high);
                    }
                }
            }
        });
    }
}

}  // namespace barycert::locate
#endif

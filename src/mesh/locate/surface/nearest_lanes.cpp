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

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/locate/surface/nearest_lanes.cpp"
#include "core/foreach_target.hpp"

#include "mesh/locate/surface/near_round-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate::HWY_NAMESPACE {

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

}  // namespace barycert::locate
#endif

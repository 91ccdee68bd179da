// Bounds of the distance of a point p from a triangle a, a + e, a + f. Let u = 2^-53, w = p - a, and m the sum over the
// axes of |w| + |e| + |f|, all as computed: differences are off by a part u of themselves.
//
// For numbers s, t >= 0 with s + t <= 1, up to a rounding, x = a + s e + t f is a point of the triangle, up to 2 u m;
// how s and t were found does not matter. y = w - s e - t f is p - x, off by at most 4 u times that axis' part of m. So
// q = y.y is |p - x|^2 but for (2 * 4 + 3) u m^2 and what is of u^2, and the triangle has a point as near but for 4 u
// m^2 more. No point of it is nearer than |p - x|^2 - 2 max over its corners c of y.(c - x), which is 2 (max(0, y.e,
// y.f) - (s y.e + t y.f)): each product is off by 7 u m^2, all of it by less than 40. Together less than 55 u m^2, and
// 128 is used; what underflows is below 2^-1000, as all numbers but products are at most 2^8.
//
// The distance of p from a box takes a difference an axis, squares and sums: a part 4 u of itself, and 8 is used.
#include "barycert/locate/surface/nearest_lanes.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "barycert/base/arena.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/locate/surface/nearest_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/core/lane_loop-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Lanes = hn::Vec<Tag>;
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
        bits |= core::HWY_NAMESPACE::mask_bits(tag, near) << l;
    }
    return bits;
}

HWY_INLINE Lanes dot(const Lanes (&x)[3], const Lanes (&y)[3]) {
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
        const Lanes ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), we = dot(w, e), wf = dot(w, f);
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
        const Lanes q = dot(y, y), ye = dot(y, e), yf = dot(y, f);
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

bool candidates(const NearGroups& groups, const double (&p)[3], double square, std::uint32_t& hint,
                NearCandidates& found) {
    double lows[NearCandidates::most];
    HWY_ALIGN double low[8], high[8], key[8];
    found.count = 0;
    double best = std::min(square, std::numeric_limits<double>::max());
    const auto drop_farther = [&] {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < found.count; ++i) {
            if (lows[i] > best) continue;  // a NaN proves nothing
            lows[kept] = lows[i];
            found.number[kept++] = found.number[i];
        }
        found.count = kept;
    };
    const auto look = [&](std::size_t group, bool keep) HWY_ATTR {
        bounds(groups.triangles[group], p, low, high);
        const std::size_t here = std::min<std::size_t>(8, groups.count - 8 * group);
        for (std::size_t l = 0; l < here; ++l) {
            if (!(high[l] < best)) continue;
            best = high[l];
            hint = static_cast<std::uint32_t>(8 * group + l);
        }
        if (!keep) return true;
        for (std::size_t l = 0; l < here; ++l) {
            if (low[l] > best) continue;
            if (found.count == NearCandidates::most) drop_farther();
            if (found.count == NearCandidates::most) return false;
            lows[found.count] = low[l];
            found.number[found.count++] = static_cast<std::uint32_t>(8 * group + l);
        }
        return true;
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
            if (!(group.key > best) && !look(group.group, true)) return false;
        }
    }
    drop_farther();
    return true;
}

}  // namespace barycert::locate::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(candidates);

bool find_candidates(const NearGroups& groups, const double (&point)[3], double square, std::uint32_t& hint,
                     NearCandidates& found) {
    return HWY_DYNAMIC_DISPATCH(candidates)(groups, point, square, hint, found);
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

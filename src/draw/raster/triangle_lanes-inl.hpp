// Internal: several triangles set up at once, one a SIMD lane, and the spans of one of them, several rows at once.
//
// Included once per SIMD target.
#if defined(BARYCERT_RASTER_TRIANGLE_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_RASTER_TRIANGLE_LANES_INL_HPP
#undef BARYCERT_RASTER_TRIANGLE_LANES_INL_HPP
#else
#define BARYCERT_RASTER_TRIANGLE_LANES_INL_HPP
#endif

#include "core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include "draw/raster/edge.hpp"
#include "draw/raster/textured.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::raster::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::ScalableTag<double>;
using DoubleLanes = hn::Vec<Doubles>;

/// value + x * along + y * up, x and y from corner 0 of the triangle.
struct Plane {
    double value, along, up;

    double at(double x, double y) const { return value + (x * along + y * up); }
};

/// Triangles in sorted order of their vertices, as SortedTriangle and Edge of edge.hpp have them, and the planes of
/// what is interpolated: u and v in texels, and with perspective both divided by w, and 1 / w.
struct Triangles {
    static constexpr std::size_t capacity = hn::MaxLanes(Doubles());

    struct Sides {
        HWY_ALIGN double x[capacity], y[capacity], slope[capacity], error[capacity];

        HWY_INLINE void set(DoubleLanes ax, DoubleLanes ay, DoubleLanes bx, DoubleLanes by) {
            const Doubles tag;
            const auto extent = hn::Max(hn::Max(hn::Abs(ax), hn::Abs(bx)), hn::Max(hn::Abs(ay), hn::Abs(by)));
            const auto bound = hn::Add(hn::Mul(hn::Set(tag, 0x1p-49), extent), hn::Set(tag, 0x1p-52));
            hn::Store(ax, tag, x);
            hn::Store(ay, tag, y);
            hn::Store(hn::Div(hn::Sub(bx, ax), hn::Sub(by, ay)), tag, slope);
            hn::Store(hn::IfThenElse(hn::Le(extent, hn::Set(tag, 0x1p100)), bound, hn::Set(tag, HUGE_VAL)), tag, error);
        }
    };
    struct Planes {
        HWY_ALIGN double value[capacity], along[capacity], up[capacity];

        Plane of(std::size_t l) const { return {value[l], along[l], up[l]}; }
    };

    Sides whole, lower, upper;
    HWY_ALIGN std::int32_t begin[capacity], middle[capacity], end[capacity];
    Planes u, v, q;
    HWY_ALIGN double largest[capacity];  ///< of |u| and |v| at the vertices
    HWY_ALIGN double least_w[capacity];

    /// At most one triangle a lane.
    void fill(const TexturedWork& work, std::span<const std::uint32_t> triangles) {
        const Doubles tag;
        // Gathers are slower than this on some processors.
        constexpr std::size_t members = 5;
        HWY_ALIGN double turned[3 * members][capacity];
        for (std::size_t l = 0; l < hn::Lanes(tag); ++l) {
            const TexturedVertex* const c = work.corners(triangles[std::min(l, triangles.size() - 1)]);
            for (std::size_t k = 0; k < 3; ++k) {
                const double of_corner[members] = {c[k].x, c[k].y, c[k].w, c[k].u, c[k].v};
                for (std::size_t m = 0; m < members; ++m) turned[members * k + m][l] = of_corner[m];
            }
        }
        const auto corner = [&](std::size_t k, std::size_t member)
                                HWY_ATTR { return hn::Load(tag, turned[members * k + member]); };
        const DoubleLanes x0 = corner(0, 0), y0 = corner(0, 1), x1 = corner(1, 0), y1 = corner(1, 1), x2 = corner(2, 0),
                          y2 = corner(2, 1);
        sort(x0, y0, x1, y1, x2, y2, work.first_row, work.end_row);

        const auto dx1 = hn::Sub(x1, x0), dy1 = hn::Sub(y1, y0), dx2 = hn::Sub(x2, x0), dy2 = hn::Sub(y2, y0);
        const auto inverse_area = hn::Div(hn::Set(tag, 1), hn::Sub(hn::Mul(dx1, dy2), hn::Mul(dx2, dy1)));
        const auto plane = [&](Planes& p, DoubleLanes f0, DoubleLanes f1, DoubleLanes f2) HWY_ATTR {
            const auto g1 = hn::Sub(f1, f0), g2 = hn::Sub(f2, f0);
            hn::Store(f0, tag, p.value);
            hn::Store(hn::Mul(hn::Sub(hn::Mul(g1, dy2), hn::Mul(g2, dy1)), inverse_area), tag, p.along);
            hn::Store(hn::Mul(hn::Sub(hn::Mul(g2, dx1), hn::Mul(g1, dx2)), inverse_area), tag, p.up);
        };
        const auto w = hn::Set(tag, static_cast<double>(work.texture.image.width));
        const auto h = hn::Set(tag, static_cast<double>(work.texture.image.height));
        DoubleLanes s[3], t[3];
        auto most = hn::Zero(tag);
        for (std::size_t k = 0; k < 3; ++k) {
            s[k] = hn::Mul(corner(k, 3), w), t[k] = hn::Mul(corner(k, 4), h);
            most = hn::Max(most, hn::Max(hn::Abs(s[k]), hn::Abs(t[k])));
        }
        hn::Store(most, tag, largest);
        if (work.perspective) {
            const auto one = hn::Set(tag, 1);
            const DoubleLanes w0 = corner(0, 2), w1 = corner(1, 2), w2 = corner(2, 2);
            const DoubleLanes inverse[3] = {hn::Div(one, w0), hn::Div(one, w1), hn::Div(one, w2)};
            hn::Store(hn::Min(w0, hn::Min(w1, w2)), tag, least_w);
            plane(q, inverse[0], inverse[1], inverse[2]);
            for (std::size_t k = 0; k < 3; ++k) s[k] = hn::Mul(s[k], inverse[k]), t[k] = hn::Mul(t[k], inverse[k]);
        }
        plane(u, s[0], s[1], s[2]);
        plane(v, t[0], t[1], t[2]);
    }

private:
    HWY_INLINE void sort(DoubleLanes ax, DoubleLanes ay, DoubleLanes bx, DoubleLanes by, DoubleLanes cx, DoubleLanes cy,
                         std::int32_t first_row, std::int32_t end_row) {
        const Doubles tag;
        const auto order = [&](DoubleLanes& px, DoubleLanes& py, DoubleLanes& qx, DoubleLanes& qy) HWY_ATTR {
            const auto swap = hn::Lt(qy, py);
            const auto x = hn::IfThenElse(swap, qx, px), y = hn::IfThenElse(swap, qy, py);
            qx = hn::IfThenElse(swap, px, qx), qy = hn::IfThenElse(swap, py, qy);
            px = x, py = y;
        };
        order(ax, ay, bx, by);
        order(bx, by, cx, cy);
        order(ax, ay, bx, by);
        whole.set(ax, ay, cx, cy);
        lower.set(ax, ay, bx, by);
        upper.set(bx, by, cx, cy);
        const hn::Rebind<std::int32_t, Doubles> itag;
        const auto low = hn::Set(tag, first_row), high = hn::Set(tag, end_row);
        const auto half = hn::Set(tag, 0.5), one = hn::Set(tag, 1);
        // The least row whose line is above y. From 0.25 on the difference is exact; below it the row is 0 or less.
        const auto row_above = [&](DoubleLanes y, std::int32_t* row) HWY_ATTR {
            const auto above = hn::Add(hn::Floor(hn::Sub(y, half)), one);
            hn::Store(hn::DemoteTo(itag, hn::Min(hn::Max(above, low), high)), itag, row);
        };
        row_above(ay, begin);
        row_above(by, middle);
        row_above(cy, end);
    }
};

/// Rows that are prepared together.
struct RowBlock {
    static constexpr std::int32_t capacity = 16;
    std::int32_t first[capacity], last[capacity];  ///< pixels first, ..., last - 1
};

/// draw(row, block, size): the rows row, ..., row + size - 1 of triangle `l`, whose corners are `c`, from the bottom. A
/// row that the filter of edge.hpp leaves undecided is asked exactly.
template <class Draw>
HWY_INLINE void for_row_blocks(const Triangles& t, std::size_t l, const TexturedVertex* c, std::int32_t width,
                               Draw draw) {
    const Doubles tag;
    const hn::Rebind<std::int32_t, Doubles> itag;
    const auto n = static_cast<std::int32_t>(hn::Lanes(tag));
    const auto half = hn::Set(tag, 0.5), zero = hn::Zero(tag), one = hn::Set(tag, 1);
    const auto limit = hn::Set(tag, static_cast<double>(width));
    const auto middle = hn::Set(tag, static_cast<double>(t.middle[l]));
    RowBlock block;
    for (std::int32_t j = t.begin[l]; j < t.end[l];) {
        const std::int32_t size = std::min(RowBlock::capacity, t.end[l] - j);
        for (std::int32_t r = 0; r < size; r += n) {
            const auto row = hn::Add(hn::Set(tag, static_cast<double>(j + r)), hn::Iota(tag, 0));
            const auto y = hn::Add(row, half);
            const auto is_lower = hn::Lt(row, middle);
            const auto pick = [&](const double* p, const double* q)
                                  HWY_ATTR { return hn::IfThenElse(is_lower, hn::Set(tag, p[l]), hn::Set(tag, q[l])); };
            const auto position = [&](DoubleLanes x0, DoubleLanes y0, DoubleLanes slope)
                                      HWY_ATTR { return hn::Sub(hn::Add(x0, hn::Mul(hn::Sub(y, y0), slope)), half); };
            const auto s =
                position(hn::Set(tag, t.whole.x[l]), hn::Set(tag, t.whole.y[l]), hn::Set(tag, t.whole.slope[l]));
            const auto q =
                position(pick(t.lower.x, t.upper.x), pick(t.lower.y, t.upper.y), pick(t.lower.slope, t.upper.slope));
            const auto s_up = hn::Ceil(s), q_up = hn::Ceil(q);
            const auto far = [&](DoubleLanes x, DoubleLanes up, DoubleLanes error) HWY_ATTR {
                return hn::And(hn::Gt(hn::Sub(up, x), error), hn::Gt(hn::Sub(x, hn::Sub(up, one)), error));
            };
            auto s_at = hn::Min(hn::Max(s_up, zero), limit), q_at = hn::Min(hn::Max(q_up, zero), limit);
            const auto decided =
                hn::And(far(s, s_up, hn::Set(tag, t.whole.error[l])), far(q, q_up, pick(t.lower.error, t.upper.error)));
            const std::int32_t used = std::min(n, size - r);
            if (!hn::AllTrue(tag, hn::Or(decided, hn::Not(hn::FirstN(tag, static_cast<std::size_t>(used)))))) {
                HWY_ALIGN double s_fixed[Triangles::capacity], q_fixed[Triangles::capacity];
                const double window[6] = {c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y};
                const SortedTriangle sorted(window, t.end[l]);
                const Edge whole(sorted.vertex[0], sorted.vertex[2]);
                for (std::int32_t k = 0; k < used; ++k) {
                    const std::int32_t at = j + r + k;
                    const int from = at < t.middle[l] ? 0 : 1;
                    s_fixed[k] = crossing(whole, at, width);
                    q_fixed[k] = crossing(Edge(sorted.vertex[from], sorted.vertex[from + 1]), at, width);
                }
                std::fill(s_fixed + used, s_fixed + n, 0.0);
                std::fill(q_fixed + used, q_fixed + n, 0.0);
                s_at = hn::Load(tag, s_fixed);
                q_at = hn::Load(tag, q_fixed);
            }
            hn::StoreU(hn::DemoteTo(itag, hn::Min(s_at, q_at)), itag, block.first + r);
            hn::StoreU(hn::DemoteTo(itag, hn::Max(s_at, q_at)), itag, block.last + r);
        }
        draw(j, block, size);
        j += size;
    }
}

}  // namespace barycert::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

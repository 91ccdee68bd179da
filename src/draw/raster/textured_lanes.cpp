// Textured triangles: spans by exact crossings (edge.hpp), texture coordinates along them on lanes.
//
// Texture coordinates, in units of texels, are affine in the window: U = U_0 + x U_x + y U_y; with perspective so are
// U / w, V / w and 1 / w. Double arithmetic gives them at the first pixel of each row. Then
//   affine, clamped   fixed point with 16 bits of fraction: the start of a row is cut by less than 2^-16, a step of a
//                     vector by less than 2^-16 and one within it by less than 2^-16 a lane: after k vectors of n lanes
//                     the coordinate is off by less than (1 + k + n) 2^-16 texels
//   all else          single precision: start, offset times step, sum, and with perspective a quotient and a product,
//                     each rounded once: off by less than 2^-21 of the largest of |U| along the row, divided, with
//                     perspective, by (least of 1 / w) / (largest of 1 / w)
// Nothing is fused, and the same is done on every target; only n differs.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include "barycert/raster.hpp"
#include "draw/raster/textured.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "draw/raster/textured_lanes.cpp"
#include "core/foreach_target.hpp"

#include "draw/raster/triangle_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::raster::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Ints = hn::Rebind<std::int32_t, Floats>;
using IntLanes = hn::Vec<Ints>;
using FloatLanes = hn::Vec<Floats>;

/// How to get at the texels.
struct Sheet {
    const std::int32_t* texels;
    std::int32_t width, height;
    int width_bits;  ///< the width is 2^width_bits, or -1 if it is no power of two

    explicit Sheet(const Image& t)
        : texels(reinterpret_cast<const std::int32_t*>(t.data.data())), width(t.width), height(t.height) {
        const auto w = static_cast<std::uint32_t>(width);
        width_bits = std::has_single_bit(w) ? std::countr_zero(w) : -1;
    }
};

/// The first `count` texels, fewer than there are lanes, one by one: faster than a gather whose last lanes are unused.
HWY_INLINE void fetch_some(const std::int32_t* texels, IntLanes index, std::int32_t count, std::int32_t* to) {
    HWY_ALIGN std::int32_t lanes[hn::MaxLanes(Ints())];
    hn::Store(index, Ints(), lanes);
    for (std::int32_t i = 0; i < count; ++i) to[i] = texels[lanes[i]];
}

/// Rows of an affine triangle with a clamped texture, in fixed point.
template <bool power_of_two>
class FixedRows {
public:
    FixedRows(const Sheet& sheet, const Triangles& set_up, std::size_t l)
        : sheet_(sheet), u_(set_up.u.of(l)), v_(set_up.v.of(l)) {
        const Ints tag;
        const double n = static_cast<double>(hn::Lanes(tag));
        u_next_ = fixed(n * u_.along), v_next_ = fixed(n * v_.along);
        u_end_ = sheet.width << fraction, v_end_ = sheet.height << fraction;
        hn::Store(hn::Mul(hn::Iota(tag, 0), hn::Set(tag, fixed(u_.along))), tag, u_lanes_);
        hn::Store(hn::Mul(hn::Iota(tag, 0), hn::Set(tag, fixed(v_.along))), tag, v_lanes_);
    }

    /// Whether the coordinates at the vertices, and so at all pixels, are within the range of fixed point.
    static bool fits(const Triangles& set_up, std::size_t l) { return set_up.largest[l] <= 1 << 13; }

    /// `count` pixels of a row from `to` on; x and y: the centre of the first.
    HWY_INLINE void draw(double x, double y, std::int32_t count, std::int32_t* to) const {
        const Ints tag;
        const auto n = static_cast<std::int32_t>(hn::Lanes(tag));
        const std::int32_t u_first = fixed(u_.at(x, y)), v_first = fixed(v_.at(x, y));
        auto u = hn::Add(hn::Set(tag, u_first), hn::Load(tag, u_lanes_));
        auto v = hn::Add(hn::Set(tag, v_first), hn::Load(tag, v_lanes_));
        if (count > n) {
            const auto u_step = hn::Set(tag, u_next_), v_step = hn::Set(tag, v_next_);
            const std::int32_t whole = count / n;
            std::int32_t* const end = to + whole * n;
            const bool inner = on_sheet(u_first, u_next_, whole, u_end_) && on_sheet(v_first, v_next_, whole, v_end_);
            for (; inner && to != end; to += n) {
                hn::StoreU(hn::GatherIndex(tag, sheet_.texels, index(u, v)), tag, to);
                u = hn::Add(u, u_step);
                v = hn::Add(v, v_step);
            }
            for (; to != end; to += n) {
                hn::StoreU(hn::GatherIndex(tag, sheet_.texels, clamped_index(u, v)), tag, to);
                u = hn::Add(u, u_step);
                v = hn::Add(v, v_step);
            }
            count -= whole * n;
            if (count == 0) return;
        }
        fetch_some(sheet_.texels, clamped_index(u, v), count, to);
    }

private:
    static constexpr int fraction = 16;

    /// Saturates: what is far off the sheet, or no number, is clamped to it later.
    static std::int32_t fixed(double x) {
        const double scaled = x * (1 << fraction);
        return scaled > -0x1p30 ? static_cast<std::int32_t>(std::min(scaled, 0x1p30)) : -(1 << 30);
    }

    /// Whether `whole` vectors from `first` on need no clamping: both ends of the row are on the sheet, and so is what
    /// is between, for a coordinate is monotonic along a row. A vector reaches less than one step beyond its first
    /// lane.
    static bool on_sheet(std::int32_t first, std::int32_t next, std::int32_t whole, std::int32_t end) {
        const std::int64_t last = first + static_cast<std::int64_t>(next) * whole;
        constexpr std::int64_t rounding = 64;  // of the lanes
        return std::min<std::int64_t>(first, last) >= rounding && std::max<std::int64_t>(first, last) < end - rounding;
    }

    HWY_INLINE IntLanes index(IntLanes u, IntLanes v) const {
        const auto column = hn::ShiftRight<fraction>(u), line = hn::ShiftRight<fraction>(v);
        const auto first =
            power_of_two ? hn::ShiftLeftSame(line, sheet_.width_bits) : hn::Mul(line, hn::Set(Ints(), sheet_.width));
        return hn::Add(first, column);
    }
    HWY_INLINE IntLanes clamped_index(IntLanes u, IntLanes v) const {
        const Ints tag;
        const auto zero = hn::Zero(tag), one = hn::Set(tag, 1);
        return index(hn::Min(hn::Max(u, zero), hn::Sub(hn::Set(tag, u_end_), one)),
                     hn::Min(hn::Max(v, zero), hn::Sub(hn::Set(tag, v_end_), one)));
    }

    const Sheet& sheet_;
    Plane u_, v_;
    std::int32_t u_next_, v_next_, u_end_, v_end_;
    HWY_ALIGN std::int32_t u_lanes_[HWY_MAX_BYTES / 4], v_lanes_[HWY_MAX_BYTES / 4];
};

/// The index, 0 to size - 1, of the texel at coordinate x in units of texels, whatever x is.
template <Wrap wrap>
HWY_INLINE IntLanes texel_index(FloatLanes x, FloatLanes size, FloatLanes inverse_size) {
    const Floats tag;
    if constexpr (wrap == Wrap::repeat) {
        x = hn::Sub(x, hn::Mul(size, hn::Floor(hn::Mul(x, inverse_size))));
    } else if constexpr (wrap == Wrap::mirror) {
        const auto half = hn::Mul(inverse_size, hn::Set(tag, 0.5F)), period = hn::Add(size, size);
        x = hn::Sub(x, hn::Mul(period, hn::Floor(hn::Mul(x, half))));
        x = hn::Min(x, hn::Sub(period, x));
    }
    // NaN and what is negative becomes 0.
    x = hn::Min(hn::IfThenElseZero(hn::Gt(x, hn::Zero(tag)), x), hn::Sub(size, hn::Set(tag, 1)));
    return hn::ConvertTo(Ints(), x);
}

/// Rows in single precision: any wrapping, and perspective.
template <Wrap wrap, bool perspective>
class FloatRows {
public:
    FloatRows(const Sheet& sheet, const Triangles& set_up, std::size_t l)
        : sheet_(sheet), u_(set_up.u.of(l)), v_(set_up.v.of(l)) {
        if constexpr (perspective) q_ = set_up.q.of(l), max_w_ = 256 * set_up.least_w[l];
    }

    static bool fits(const Triangles&, std::size_t) { return true; }

    HWY_INLINE void draw(double x, double y, std::int32_t count, std::int32_t* to) const {
        const Floats tag;
        const Ints itag;
        const auto n = static_cast<std::int32_t>(hn::Lanes(tag));
        const Line u(u_, x, y), v(v_, x, y), q(q_, x, y);
        const auto width = hn::Set(tag, static_cast<float>(sheet_.width));
        const auto height = hn::Set(tag, static_cast<float>(sheet_.height));
        const auto inverse_width = hn::Div(hn::Set(tag, 1), width), inverse_height = hn::Div(hn::Set(tag, 1), height);
        const auto lanes = hn::Set(tag, static_cast<float>(n));
        const auto stride = hn::Set(itag, sheet_.width);
        auto offset = hn::Iota(tag, 0);
        const auto index = [&](auto inner) HWY_ATTR {
            auto s = u.at(offset), t = v.at(offset);
            if constexpr (perspective) {
                const auto w = hn::Div(hn::Set(tag, 1), q.at(offset));
                s = hn::Mul(s, w);
                t = hn::Mul(t, w);
            }
            offset = hn::Add(offset, lanes);
            if constexpr (decltype(inner)::value)
                return hn::Add(hn::Mul(hn::ConvertTo(itag, t), stride), hn::ConvertTo(itag, s));
            else
                return hn::Add(hn::Mul(texel_index<wrap>(t, height, inverse_height), stride),
                               texel_index<wrap>(s, width, inverse_width));
        };
        if (wrap == Wrap::clamp && count > 2 * n && on_sheet(x, y, count)) {
            for (; count >= n; count -= n, to += n)
                hn::StoreU(hn::GatherIndex(itag, sheet_.texels, index(std::true_type())), itag, to);
        }
        for (; count >= n; count -= n, to += n)
            hn::StoreU(hn::GatherIndex(itag, sheet_.texels, index(std::false_type())), itag, to);
        if (count > 0) fetch_some(sheet_.texels, index(std::false_type()), count, to);
    }

private:
    /// Whether the row needs no clamping: both ends are on the sheet, and so is what is between, for a coordinate is
    /// monotonic along a row, with perspective too as w > 0. `near` is more than the lanes' errors.
    bool on_sheet(double x, double y, std::int32_t count) const {
        constexpr double near = 0x1p-5;
        for (const double at : {x, x + count}) {
            const double w = perspective ? 1 / q_.at(at, y) : 1;
            if (!(w > 0 && w < max_w_)) return false;
            const double s = u_.at(at, y) * w, t = v_.at(at, y) * w;
            if (!(s >= near && s <= sheet_.width - near && t >= near && t <= sheet_.height - near)) return false;
        }
        return true;
    }

    /// A coordinate along a row, by the number of pixels from the first.
    struct Line {
        FloatLanes first, step;

        Line(const Plane& p, double x, double y)
            : first(hn::Set(Floats(), static_cast<float>(p.at(x, y)))),
              step(hn::Set(Floats(), static_cast<float>(p.along))) {}
        HWY_INLINE FloatLanes at(FloatLanes offset) const { return hn::Add(first, hn::Mul(offset, step)); }
    };

    const Sheet& sheet_;
    Plane u_, v_, q_{};
    double max_w_ = 2;  ///< up to which depth the error of 1 / w is small beside it
};

template <class Rows>
std::size_t draw_all(const TexturedWork& work, const Sheet& sheet, std::span<const std::uint32_t> triangles) {
    std::size_t drawn = 0;
    const auto width = static_cast<std::size_t>(work.image.width);
    auto* const pixels = reinterpret_cast<std::int32_t*>(work.image.data.data());
    Triangles set_up;
    while (!triangles.empty()) {
        const auto used = std::min(hn::Lanes(Doubles()), triangles.size());
        set_up.fill(work, triangles.first(used));
        for (std::size_t l = used; l < std::min(2 * used, triangles.size()); ++l) {
            const auto* const next = work.corners(triangles[l]);
            __builtin_prefetch(next);
            __builtin_prefetch(next + 2);
        }
        for (std::size_t l = 0; l < used; ++l) {
            if (set_up.begin[l] == set_up.end[l]) continue;
            if (!Rows::fits(set_up, l)) {
                drawn += draw_all<FloatRows<Wrap::clamp, false>>(work, sheet, triangles.subspan(l, 1));
                continue;
            }
            const TexturedVertex* const c = work.corners(triangles[l]);
            const Rows rows(sheet, set_up, l);
            for_row_blocks(set_up, l, c, work.image.width,
                           [&](std::int32_t j, const RowBlock& block, std::int32_t size) HWY_ATTR {
                               for (std::int32_t r = 0; r < size; ++r) {
                                   const std::int32_t first = block.first[r], count = block.last[r] - first;
                                   if (count <= 0) continue;
                                   drawn += static_cast<std::size_t>(count);
                                   rows.draw(first + 0.5 - c[0].x, j + r + 0.5 - c[0].y, count,
                                             pixels + static_cast<std::size_t>(j + r) * width + first);
                               }
                           });
        }
        triangles = triangles.subspan(used);
    }
    return drawn;
}

template <bool perspective>
std::size_t draw_wrapped(const TexturedWork& work, const Sheet& sheet, std::span<const std::uint32_t> triangles) {
    const Wrap wrap = work.texture.wrap;
    if (wrap == Wrap::repeat) return draw_all<FloatRows<Wrap::repeat, perspective>>(work, sheet, triangles);
    if (wrap == Wrap::mirror) return draw_all<FloatRows<Wrap::mirror, perspective>>(work, sheet, triangles);
    if (perspective || std::max(sheet.width, sheet.height) > 1 << 13)
        return draw_all<FloatRows<Wrap::clamp, perspective>>(work, sheet, triangles);
    return sheet.width_bits >= 0 ? draw_all<FixedRows<true>>(work, sheet, triangles)
                                 : draw_all<FixedRows<false>>(work, sheet, triangles);
}

std::size_t draw(const TexturedWork& work, std::span<const std::uint32_t> triangles) {
    const Sheet sheet(work.texture.image);
    return work.perspective ? draw_wrapped<true>(work, sheet, triangles) : draw_wrapped<false>(work, sheet, triangles);
}

}  // namespace barycert::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::raster {
HWY_EXPORT(draw);

std::size_t draw_triangles(const TexturedWork& work, std::span<const std::uint32_t> triangles) {
    return HWY_DYNAMIC_DISPATCH(draw)(work, triangles);
}

}  // namespace barycert::raster
#endif

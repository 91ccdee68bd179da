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
#include "barycert/raster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>

#include "barycert/environment.hpp"
#include "barycert/raster/edge.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/raster/textured_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/core/lane_loop-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::ScalableTag<double>;
using Floats = hn::ScalableTag<float>;
using Ints = hn::Rebind<std::int32_t, Floats>;
using IntLanes = hn::Vec<Ints>;
using FloatLanes = hn::Vec<Floats>;
using core::HWY_NAMESPACE::store_some;

// Spans: the crossings of several rows at once, by the filter of edge.hpp; a row that it leaves undecided is asked
// exactly.

/// Rows that are prepared together.
struct RowBlock {
    static constexpr std::int32_t capacity = 16;
    std::int32_t first[capacity], last[capacity];  ///< pixels first, ..., last - 1
};

/// draw(row, block, size): the rows row, ..., row + size - 1 of the triangle, from the bottom. Precondition: it has
/// one.
template <class Draw>
HWY_INLINE void for_row_blocks(const SortedTriangle& t, std::int32_t width, Draw draw) {
    const Doubles tag;
    const hn::Rebind<std::int32_t, Doubles> itag;
    using V = hn::Vec<Doubles>;
    const auto n = static_cast<std::int32_t>(hn::Lanes(tag));
    const Edge whole(t.vertex[0], t.vertex[2]);
    // A short side that meets no row may be horizontal: the other one stands for it.
    const auto side = [&](int i) { return Edge(t.vertex[i], t.vertex[i + 1]); };
    const Edge lower = side(t.begin == t.middle ? 1 : 0), upper = side(t.middle == t.end ? 0 : 1);
    const auto half = hn::Set(tag, 0.5), zero = hn::Zero(tag), one = hn::Set(tag, 1);
    const auto limit = hn::Set(tag, static_cast<double>(width));
    RowBlock block;
    for (std::int32_t j = t.begin; j < t.end;) {
        const std::int32_t size = std::min(RowBlock::capacity, t.end - j);
        for (std::int32_t r = 0; r < size; r += n) {
            const auto row = hn::Add(hn::Set(tag, static_cast<double>(j + r)), hn::Iota(tag, 0));
            const auto y = hn::Add(row, half);
            const auto is_lower = hn::Lt(row, hn::Set(tag, static_cast<double>(t.middle)));
            const auto pick = [&](double p, double q)
                                  HWY_ATTR { return hn::IfThenElse(is_lower, hn::Set(tag, p), hn::Set(tag, q)); };
            const auto position = [&](V x0, V y0, V slope)
                                      HWY_ATTR { return hn::Sub(hn::Add(x0, hn::Mul(hn::Sub(y, y0), slope)), half); };
            const V s = position(hn::Set(tag, whole.lower[0]), hn::Set(tag, whole.lower[1]), hn::Set(tag, whole.slope));
            const V q = position(pick(lower.lower[0], upper.lower[0]), pick(lower.lower[1], upper.lower[1]),
                                 pick(lower.slope, upper.slope));
            const V s_up = hn::Ceil(s), q_up = hn::Ceil(q);
            const V s_error = hn::Set(tag, whole.error), q_error = pick(lower.error, upper.error);
            const auto far = [&](V x, V up, V error) HWY_ATTR {
                return hn::And(hn::Gt(hn::Sub(up, x), error), hn::Gt(hn::Sub(x, hn::Sub(up, one)), error));
            };
            V s_at = hn::Min(hn::Max(s_up, zero), limit), q_at = hn::Min(hn::Max(q_up, zero), limit);
            const auto decided = hn::And(far(s, s_up, s_error), far(q, q_up, q_error));
            const std::int32_t used = std::min(n, size - r);
            if (!hn::AllTrue(tag, hn::Or(decided, hn::Not(hn::FirstN(tag, static_cast<std::size_t>(used)))))) {
                HWY_ALIGN double s_fixed[hn::MaxLanes(Doubles())], q_fixed[hn::MaxLanes(Doubles())];
                hn::Store(s_at, tag, s_fixed);
                hn::Store(q_at, tag, q_fixed);
                for (std::int32_t l = 0; l < used; ++l) {
                    const std::int32_t at = j + r + l;
                    s_fixed[l] = crossing(whole, at, width);
                    q_fixed[l] = crossing(at < t.middle ? lower : upper, at, width);
                }
                s_at = hn::Load(tag, s_fixed);
                q_at = hn::Load(tag, q_fixed);
            }
            const V first = hn::Min(s_at, q_at);
            hn::StoreU(hn::DemoteTo(itag, first), itag, block.first + r);
            hn::StoreU(hn::DemoteTo(itag, hn::Max(s_at, q_at)), itag, block.last + r);
        }
        draw(j, block, size);
        j += size;
    }
}

// Texture coordinates.

/// value + x * along + y * up, x and y from corner 0 of the triangle.
struct Plane {
    double value, along, up;

    double at(double x, double y) const { return value + (x * along + y * up); }
};

/// The edges of a triangle from its corner 0.
struct Basis {
    double x1, y1, x2, y2, inverse_area = 1 / (x1 * y2 - x2 * y1);

    explicit Basis(const TexturedVertex* c)
        : x1(c[1].x - c[0].x), y1(c[1].y - c[0].y), x2(c[2].x - c[0].x), y2(c[2].y - c[0].y) {}
    Plane plane(double f0, double f1, double f2) const {
        const double g1 = f1 - f0, g2 = f2 - f0;
        return {f0, (g1 * y2 - g2 * y1) * inverse_area, (g2 * x1 - g1 * x2) * inverse_area};
    }
};

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

/// The index of a texel, and 0 from lane `count` on: what is not stored costs no cache line.
HWY_INLINE IntLanes first_lanes(IntLanes index, std::int32_t count) {
    const Ints tag;
    return hn::IfThenElseZero(hn::Lt(hn::Iota(tag, 0), hn::Set(tag, count)), index);
}

/// Rows of an affine triangle with a clamped texture, in fixed point.
template <bool power_of_two>
class FixedRows {
public:
    FixedRows(const Sheet& sheet, const Basis& basis, const TexturedVertex* c) : sheet_(sheet) {
        u_ = basis.plane(c[0].u * sheet.width, c[1].u * sheet.width, c[2].u * sheet.width);
        v_ = basis.plane(c[0].v * sheet.height, c[1].v * sheet.height, c[2].v * sheet.height);
        const Ints tag;
        const double n = static_cast<double>(hn::Lanes(tag));
        u_next_ = fixed(n * u_.along), v_next_ = fixed(n * v_.along);
        u_end_ = sheet.width << fraction, v_end_ = sheet.height << fraction;
        hn::Store(hn::Mul(hn::Iota(tag, 0), hn::Set(tag, fixed(u_.along))), tag, u_lanes_);
        hn::Store(hn::Mul(hn::Iota(tag, 0), hn::Set(tag, fixed(v_.along))), tag, v_lanes_);
    }

    /// Whether the coordinates at the vertices, and so at all pixels, are within the range of fixed point.
    static bool fits(const Sheet& sheet, const TexturedVertex* c) {
        constexpr double range = 1 << 13;
        return std::all_of(c, c + 3, [&](const TexturedVertex& t) {
            return std::fabs(t.u * sheet.width) <= range && std::fabs(t.v * sheet.height) <= range;
        });
    }

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
        store_some(tag, hn::GatherIndex(tag, sheet_.texels, first_lanes(clamped_index(u, v), count)), to, count);
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
    FloatRows(const Sheet& sheet, const Basis& basis, const TexturedVertex* c) : sheet_(sheet) {
        const double w = sheet.width, h = sheet.height;
        if constexpr (perspective) {
            const double q[3] = {1 / c[0].w, 1 / c[1].w, 1 / c[2].w};
            q_ = basis.plane(q[0], q[1], q[2]);
            max_w_ = 256 * std::min({c[0].w, c[1].w, c[2].w});
            u_ = basis.plane(c[0].u * w * q[0], c[1].u * w * q[1], c[2].u * w * q[2]);
            v_ = basis.plane(c[0].v * h * q[0], c[1].v * h * q[1], c[2].v * h * q[2]);
        } else {
            u_ = basis.plane(c[0].u * w, c[1].u * w, c[2].u * w);
            v_ = basis.plane(c[0].v * h, c[1].v * h, c[2].v * h);
        }
    }

    static bool fits(const Sheet&, const TexturedVertex*) { return true; }

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
        if (count > 0)
            store_some(itag, hn::GatherIndex(itag, sheet_.texels, first_lanes(index(std::false_type()), count)), to,
                       count);
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
std::size_t draw_all(Image& out, const Sheet& sheet, std::span<const TexturedVertex> vertices) {
    std::size_t drawn = 0;
    auto* const pixels = reinterpret_cast<std::int32_t*>(out.data.data());
    for (std::size_t k = 0; k + 3 <= vertices.size(); k += 3) {
        const TexturedVertex* const c = vertices.data() + k;
        const double window[6] = {c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y};
        const SortedTriangle sorted(window, out.height);
        if (sorted.begin == sorted.end) continue;
        if (!Rows::fits(sheet, c)) {
            drawn += draw_all<FloatRows<Wrap::clamp, false>>(out, sheet, vertices.subspan(k, 3));
            continue;
        }
        const Rows rows(sheet, Basis(c), c);
        for_row_blocks(sorted, out.width, [&](std::int32_t j, const RowBlock& block, std::int32_t size) HWY_ATTR {
            for (std::int32_t r = 0; r < size; ++r) {
                const std::int32_t first = block.first[r], count = block.last[r] - first;
                if (count <= 0) continue;
                drawn += static_cast<std::size_t>(count);
                const auto at = static_cast<std::size_t>(j + r) * static_cast<std::size_t>(out.width);
                rows.draw(first + 0.5 - c[0].x, j + r + 0.5 - c[0].y, count, pixels + at + first);
            }
        });
    }
    return drawn;
}

template <bool perspective>
std::size_t draw_wrapped(Image& out, const Texture& texture, std::span<const TexturedVertex> vertices) {
    const Sheet sheet(texture.image);
    if (texture.wrap == Wrap::repeat) return draw_all<FloatRows<Wrap::repeat, perspective>>(out, sheet, vertices);
    if (texture.wrap == Wrap::mirror) return draw_all<FloatRows<Wrap::mirror, perspective>>(out, sheet, vertices);
    if (perspective || std::max(sheet.width, sheet.height) > 1 << 13)
        return draw_all<FloatRows<Wrap::clamp, perspective>>(out, sheet, vertices);
    return sheet.width_bits >= 0 ? draw_all<FixedRows<true>>(out, sheet, vertices)
                                 : draw_all<FixedRows<false>>(out, sheet, vertices);
}

std::size_t draw(Image& out, const Texture& texture, std::span<const TexturedVertex> vertices, bool perspective) {
    return perspective ? draw_wrapped<true>(out, texture, vertices) : draw_wrapped<false>(out, texture, vertices);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert {
namespace raster {
HWY_EXPORT(draw);

namespace {

Status check_textured(const Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                      bool perspective) {
    if (Status s = check_image(image); !s) return s;
    if (Status s = check_image(texture.image); !s) return s;
    if (Status s = check_raster_size({image.width, image.height}); !s) return s;
    if (texture.filter != Filter::nearest)
        return Error{.what = "the filter of a texture that is drawn on lanes",
                     .expected = "Filter::nearest",
                     .remedy = "use render() of scene.hpp, which filters"};
    if (vertices.size() % 3 != 0)
        return Error{.what = "number of vertices",
                     .expected = "three for each triangle",
                     .found = std::to_string(vertices.size())};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const TexturedVertex& t = vertices[i];
        const bool finite = std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.u) && std::isfinite(t.v);
        if (!finite || !std::isfinite(t.w) || (perspective && !(t.w > 0)))
            return Error{.what = "vertex " + std::to_string(i % 3) + " of triangle " + std::to_string(i / 3),
                         .expected = perspective ? "finite numbers, w > 0" : "finite numbers",
                         .found = finite ? "w = " + std::to_string(t.w) : "one that is not finite"};
    }
    return Done{};
}

}  // namespace
}  // namespace raster

Result<std::size_t> draw_textured(Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                                  bool perspective) {
    using namespace raster;
    const ExactEnvironment environment;
    if (Status s = check_textured(image, texture, vertices, perspective); !s) return s.error();
    return HWY_DYNAMIC_DISPATCH(draw)(image, texture, vertices, perspective);
}

}  // namespace barycert
#endif

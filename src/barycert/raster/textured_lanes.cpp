// Texture coordinates, in units of texels, are affine in the window: U = U_0 + x U_x + y U_y; with perspective so are
// U/w, V/w and 1/w. Double arithmetic gives them at the first pixel of each vector; the lanes add multiples of the step
// along the row in single precision. That is an error of about 2^-23 of the coordinate, 2^-13 texels in a picture 1024
// wide, and the same on every target: nothing is fused.
#include "barycert/raster/textured_lanes.hpp"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/raster/textured_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Ints = hn::Rebind<std::int32_t, Floats>;

/// value + x * along + y * up.
struct Plane {
    double value, along, up;

    double at(double x, double y) const { return value + (x * along + y * up); }
};

struct Box {
    double x0, y0, x1, y1, x2, y2, inverse_area;
};

HWY_INLINE Plane plane_through(const Box& b, double f0, double f1, double f2) {
    const double g1 = f1 - f0, g2 = f2 - f0;
    return {f0, (g1 * b.y2 - g2 * b.y1) * b.inverse_area, (g2 * b.x1 - g1 * b.x2) * b.inverse_area};
}

/// One coordinate along a row.
struct Lanes {
    hn::Vec<Floats> steps;  ///< lane i: i * along

    explicit Lanes(const Plane& plane)
        : steps(hn::Mul(hn::Iota(Floats(), 0), hn::Set(Floats(), static_cast<float>(plane.along)))) {}

    HWY_INLINE hn::Vec<Floats> at(double first) const {
        return hn::Add(hn::Set(Floats(), static_cast<float>(first)), steps);
    }
};

/// The index, 0 to size - 1, of the texel at coordinate x in units of texels, whatever x is.
template <int wrap>
HWY_INLINE hn::Vec<Ints> texel_index(hn::Vec<Floats> x, hn::Vec<Floats> size, hn::Vec<Floats> inverse_size) {
    const Floats tag;
    const auto zero = hn::Zero(tag), last = hn::Sub(size, hn::Set(tag, 1));
    if constexpr (wrap == 1) {
        x = hn::Sub(x, hn::Mul(size, hn::Floor(hn::Mul(x, inverse_size))));
    } else if constexpr (wrap == 2) {
        const auto half = hn::Mul(inverse_size, hn::Set(tag, 0.5F)), period = hn::Add(size, size);
        x = hn::Sub(x, hn::Mul(period, hn::Floor(hn::Mul(x, half))));
        x = hn::Min(x, hn::Sub(period, x));
    }
    // NaN and what is negative becomes 0.
    return hn::ConvertTo(Ints(), hn::Min(hn::IfThenElseZero(hn::Ge(x, zero), x), last));
}

template <int wrap, bool perspective>
HWY_INLINE std::size_t draw_one(const PixelRows& out, const TexelRows& texture, const TexturedCorner* c) {
    const Floats tag;
    const Ints itag;
    const auto n = static_cast<std::int32_t>(hn::Lanes(tag));
    const double vertices[6] = {c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y};
    const SortedTriangle sorted(vertices, out.height);
    if (sorted.begin == sorted.end) return 0;

    Box b{c[0].x, c[0].y, c[1].x - c[0].x, c[1].y - c[0].y, c[2].x - c[0].x, c[2].y - c[0].y, 0};
    b.inverse_area = 1 / (b.x1 * b.y2 - b.x2 * b.y1);
    const double width = texture.width, height = texture.height;
    Plane u{}, v{}, q{};
    if constexpr (perspective) {
        const double q0 = 1 / c[0].w, q1 = 1 / c[1].w, q2 = 1 / c[2].w;
        q = plane_through(b, q0, q1, q2);
        u = plane_through(b, c[0].u * width * q0, c[1].u * width * q1, c[2].u * width * q2);
        v = plane_through(b, c[0].v * height * q0, c[1].v * height * q1, c[2].v * height * q2);
    } else {
        u = plane_through(b, c[0].u * width, c[1].u * width, c[2].u * width);
        v = plane_through(b, c[0].v * height, c[1].v * height, c[2].v * height);
    }
    const Lanes u_lanes(u), v_lanes(v), q_lanes(q);
    const auto widths = hn::Set(tag, static_cast<float>(width)), heights = hn::Set(tag, static_cast<float>(height));
    const auto inverse_widths = hn::Set(tag, static_cast<float>(1 / width));
    const auto inverse_heights = hn::Set(tag, static_cast<float>(1 / height));
    const auto stride = hn::Set(itag, texture.width);
    const auto* const texels = reinterpret_cast<const std::int32_t*>(texture.texels);

    std::size_t count = 0;
    for_spans(sorted, out.width, [&](std::int32_t j, std::int32_t first, std::int32_t last) HWY_ATTR {
        const double x = first + 0.5 - b.x0, y = j + 0.5 - b.y0;
        double uf = u.at(x, y), vf = v.at(x, y), qf = perspective ? q.at(x, y) : 0;
        auto* row = reinterpret_cast<std::int32_t*>(out.pixels) +
                    static_cast<std::size_t>(j) * static_cast<std::size_t>(out.width);
        count += static_cast<std::size_t>(last - first);
        for (std::int32_t i = first; i < last; i += n) {
            auto uu = u_lanes.at(uf), vv = v_lanes.at(vf);
            if constexpr (perspective) {
                const auto w = hn::Div(hn::Set(tag, 1), q_lanes.at(qf));
                uu = hn::Mul(uu, w);
                vv = hn::Mul(vv, w);
                qf += n * q.along;
            }
            uf += n * u.along;
            vf += n * v.along;
            const auto column = texel_index<wrap>(uu, widths, inverse_widths);
            const auto line = texel_index<wrap>(vv, heights, inverse_heights);
            const auto colour = hn::GatherIndex(itag, texels, hn::Add(hn::Mul(line, stride), column));
            if (last - i >= n) {
                hn::StoreU(colour, itag, row + i);
            } else {
#if HWY_TARGET <= HWY_AVX3
                hn::BlendedStore(colour, hn::FirstN(itag, static_cast<std::size_t>(last - i)), itag, row + i);
#else
                HWY_ALIGN std::int32_t rest[HWY_MAX_BYTES / 4];
                hn::Store(colour, itag, rest);
                std::memcpy(row + i, rest, 4 * static_cast<std::size_t>(last - i));
#endif
            }
        }
    });
    return count;
}

template <int wrap, bool perspective>
std::size_t draw_all(const PixelRows& out, const TexelRows& texture, std::span<const TexturedCorner> corners) {
    std::size_t count = 0;
    for (std::size_t k = 0; k + 3 <= corners.size(); k += 3)
        count += draw_one<wrap, perspective>(out, texture, corners.data() + k);
    return count;
}

std::size_t draw(const PixelRows& out, const TexelRows& texture, std::span<const TexturedCorner> corners,
                 bool perspective) {
    switch (texture.wrap) {
        case 1:
            return perspective ? draw_all<1, true>(out, texture, corners) : draw_all<1, false>(out, texture, corners);
        case 2:
            return perspective ? draw_all<2, true>(out, texture, corners) : draw_all<2, false>(out, texture, corners);
        default:
            return perspective ? draw_all<0, true>(out, texture, corners) : draw_all<0, false>(out, texture, corners);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::raster {
HWY_EXPORT(draw);

std::size_t draw_textured(const PixelRows& out, const TexelRows& texture, std::span<const TexturedCorner> corners,
                          bool perspective) {
    return HWY_DYNAMIC_DISPATCH(draw)(out, texture, corners, perspective);
}
}  // namespace barycert::raster
#endif

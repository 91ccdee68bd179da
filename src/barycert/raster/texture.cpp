#include "barycert/raster.hpp"

#include <algorithm>
#include <cmath>

#include "barycert/base/held.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/environment.hpp"
#include "barycert/raster/draw.hpp"

namespace barycert {
namespace {

/// The greatest integer that is not above u * size, the product taken without rounding. Preconditions: |u| < 2,
/// 1 <= size <= 2^26, so that all is far from overflow.
///
/// A product that is rounded to a number that is no integer lies between the same integers as the exact one. One that
/// is rounded to an integer t may have come from below; then u * size - t < 0, a difference that one fused operation
/// tells rightly: it is rounded once, and not to zero, as it is a multiple of the unit of u.
std::int64_t exact_floor(double u, double size) {
    const double t = u * size;
    const double whole = std::floor(t);
    if (whole == t && std::fma(u, size, -t) < 0) return static_cast<std::int64_t>(whole) - 1;
    return static_cast<std::int64_t>(whole);
}

/// The same place in one period: [0, 1] with clamp, (-1, 1) with repeat, (-2, 2) with mirror. fmod is exact.
double reduced(double u, Wrap wrap) {
    if (std::isnan(u)) return 0;
    if (wrap == Wrap::clamp) return std::clamp(u, 0.0, 1.0);
    if (std::isinf(u)) return 0;
    const double period = wrap == Wrap::repeat ? 1 : 2;
    return std::abs(u) < period ? u : std::fmod(u, period);
}

/// The texel that stands at place i. Precondition: -3 * size <= i <= 3 * size.
std::int64_t wrapped(std::int64_t i, std::int64_t size, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp<std::int64_t>(i, 0, size - 1);
    const std::int64_t period = wrap == Wrap::repeat ? size : 2 * size;
    i %= period;
    if (i < 0) i += period;
    return i < size ? i : period - 1 - i;  // the second only with mirror
}

/// Along one axis: the two texels, and the part of the second. With Filter::nearest both are one.
struct TexelPair {
    std::int32_t low, high;
    double part;
};

TexelPair texels_at(double u, std::int32_t size, Wrap wrap, Filter filter) {
    const double r = reduced(u, wrap);
    if (filter == Filter::nearest) {
        const auto i = static_cast<std::int32_t>(wrapped(exact_floor(r, size), size, wrap));
        return {i, i, 0};
    }
    const double x = r * size - 0.5;  // centres lie at integers
    const double whole = std::floor(x);
    const auto i = static_cast<std::int64_t>(whole);
    return {static_cast<std::int32_t>(wrapped(i, size, wrap)), static_cast<std::int32_t>(wrapped(i + 1, size, wrap)),
            x - whole};
}

}  // namespace

Rgba texel(const Texture& texture, double u, double v) {
    const ExactEnvironment environment;
    const Image& image = texture.image;
    const TexelPair x = texels_at(base::held(u), image.width, texture.wrap, texture.filter);
    const TexelPair y = texels_at(base::held(v), image.height, texture.wrap, texture.filter);
    if (texture.filter == Filter::nearest) return image.pixel(x.low, y.low);
    const Rgba a = image.pixel(x.low, y.low), b = image.pixel(x.high, y.low);
    const Rgba c = image.pixel(x.low, y.high), d = image.pixel(x.high, y.high);
    Rgba colour;
    for (std::size_t k = 0; k < 4; ++k) {
        const double below = a[k] + x.part * (b[k] - a[k]), above = c[k] + x.part * (d[k] - c[k]);
        // Between the four texels up to rounding: 0 <= part < 1, and by less than 2^-40 beyond. That is rounded away.
        colour[k] = raster::nearest_byte(std::max(0.0, below + y.part * (above - below)));
    }
    return colour;
}

}  // namespace barycert

// The rules of texel addressing: those of the literature as it has them, faults included, and exact ones.
#include <cmath>

#include "barycert/audit_pictures.hpp"
#include "barycert/base/strict_math.hpp"

namespace barycert {
namespace {

double clamped(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

std::int64_t clamp_to_w(double u, std::int64_t size) {
    const auto w = static_cast<double>(size);
    return static_cast<std::int64_t>(clamped(u * w, 0, w));
}

std::int64_t clamp_to_last(double u, std::int64_t size) {
    return static_cast<std::int64_t>(clamped(u * static_cast<double>(size), 0, static_cast<double>(size - 1)));
}

std::int64_t scale_by_last(double u, std::int64_t size) {
    const auto last = static_cast<double>(size - 1);
    return static_cast<std::int64_t>(std::floor(clamped(u * last, 0, last) + 0.5));
}

std::int64_t fraction_of_u(double u, std::int64_t size) {
    return static_cast<std::int64_t>((u - std::floor(u)) * static_cast<double>(size));
}

/// floor(f * size) for 0 <= f <= 1. The rounded product may have reached the next integer, which the fused remainder,
/// rounded once and so of the right sign, tells; it never falls short of one that the exact product has reached, since
/// rounding is monotonic and the integer is a double.
std::int64_t floor_of_product(double f, std::int64_t size) {
    const auto w = static_cast<double>(size);
    const auto k = static_cast<std::int64_t>(f * w);
    return std::fma(f, w, -static_cast<double>(k)) < 0 ? k - 1 : k;
}

std::int64_t exact_clamp(double u, std::int64_t size) {
    if (!(u > 0)) return 0;
    return u < 1 ? floor_of_product(u, size) : size - 1;
}

/// u - floor(u) is exact for u >= 0. Below, with f = -u - floor(-u), the fraction is 1 - f, which need not be a double:
/// floor((1 - f) size) = size - ceil(f size).
std::int64_t exact_repeat(double u, std::int64_t size) {
    const double f = std::fabs(u) - std::floor(std::fabs(u));
    if (f == 0) return 0;
    const std::int64_t k = floor_of_product(f, size);
    if (u > 0) return k;
    const bool whole = std::fma(f, static_cast<double>(size), -static_cast<double>(k)) == 0;
    return size - (whole ? k : k + 1);
}

}  // namespace

const std::vector<TexelRule>& texel_rules() {
    static const std::vector<TexelRule> rules{
        {"texture.clamp-to-w", TexelWrap::clamp, "x = u w, clamped to [0, w]; texel x, rounded down",
         "the interpolation notes, section on texture coordinates",
         "u = 1 gives texel w, one past the last: the next row's first texel, or, in the last row, what follows the "
         "picture in memory",
         clamp_to_w},
        {"texture.clamp-to-last", TexelWrap::clamp, "x = u w, clamped to [0, w - 1]; texel x, rounded down",
         "the usual repair", "never leaves the row; within an ulp below a border u w is rounded to the next texel",
         clamp_to_last},
        {"texture.scale-by-last", TexelWrap::clamp, "x = u (w - 1), clamped to [0, w - 1]; texel x, rounded to nearest",
         "another usual repair",
         "never leaves the row; the first and last texel are half as wide as the others, so that borders are off by up "
         "to half a texel",
         scale_by_last},
        {"texture.exact-clamp", TexelWrap::clamp, "floor(u w) exactly, at most w - 1, at least 0",
         "floor of the rounded product, corrected by the sign of the fused remainder", "on no finite u", exact_clamp},
        {"texture.fraction", TexelWrap::repeat, "x = (u - floor(u)) w; texel x, rounded down",
         "tutorials on repeated textures; fract() of shading languages",
         "u = -2^-60: 1 - 2^-60 is rounded to 1, which gives texel w, one past the last", fraction_of_u},
        {"texture.exact-repeat", TexelWrap::repeat, "floor((u - floor(u)) w) exactly",
         "for u < 0 as w - ceil(f w), f = -u - floor(-u), whose fraction is exact", "on no finite u", exact_repeat},
    };
    return rules;
}

}  // namespace barycert

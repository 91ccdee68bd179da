#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "audit/recipes.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/environment.hpp"
#include "barycert/oracle.hpp"
#include "core/base/random.hpp"
#include "core/base/strict_math.hpp"

namespace barycert {
namespace {

/// floor(f * size) for 0 <= f <= 1. The rounded product may have reached the next integer, which the fused remainder,
/// rounded once and so of the right sign, tells; it never falls short of one that the exact product has reached, since
/// rounding is monotonic and the integer is a double.
std::int64_t floor_of_product(double f, std::int64_t size) {
    const auto w = static_cast<double>(size);
    const auto k = static_cast<std::int64_t>(f * w);
    return std::fma(f, w, -static_cast<double>(k)) < 0 ? k - 1 : k;
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

/// The first cases: the rim of the 2x2 picture of the notes, and what is just below 0.
constexpr std::array<std::pair<double, std::int64_t>, 2> known_failures{{{1, 2}, {-0x1p-60, 2}}};

/// Draws a size: of pictures, a power of two or beside one, up to the largest.
std::int64_t texel_count(base::Random& random) {
    constexpr std::array<std::int64_t, 12> usual{1, 2, 3, 5, 7, 100, 255, 256, 257, 1000, 1920, 4096};
    const auto k = random.below(usual.size() + 4);
    if (k < usual.size()) return usual[k];
    return 1 + static_cast<std::int64_t>(random.below(std::uint64_t{1} << random.integer(0, 31)));
}

double coordinate(base::Random& random, std::int64_t size) {
    const auto kind = random.below(6);
    if (kind < 2) {  // a border of texels of the row or of one beside it, and its neighbours
        const auto k = static_cast<double>(random.below(static_cast<std::uint64_t>(size) + 1));
        const int row = random.integer(-1, 1);
        return audit::ulps_away(row + k / static_cast<double>(size), random);
    }
    if (kind == 2) return audit::ulps_away(random.integer(-2, 2), random);  // an end of a row
    if (kind == 3) return random.uniform(-2, 3);
    if (kind == 4) return random.unit();
    const double u = std::bit_cast<double>(random.bits());  // any finite number
    return std::isfinite(u) ? u : -0.0;
}

void add(TexelResult& result, double u, std::int64_t size, std::int64_t exact) {
    const std::int64_t texel = result.rule.texel(u, size);
    ++result.cases;
    if (texel == exact) return;
    const auto finding = static_cast<std::size_t>(texel >= size ? TexelFinding::past_end
                                                  : texel < 0   ? TexelFinding::before_start
                                                                : TexelFinding::wrong_texel);
    if (result.counts[finding]++ == 0) result.witnesses[finding] = {u, size, texel, exact};
}

}  // namespace

// Rules of the literature as it has them, faults included, and exact ones.
const std::vector<TexelRule>& texel_rules() {
    static const std::vector<TexelRule> rules{
        {"texture.clamp-to-w", TexelWrap::clamp, "x = u w, clamped to [0, w]; texel x, rounded down",
         "the interpolation notes, section on texture coordinates",
         "u = 1 gives texel w, one past the last: the next row's first texel, or, in the last row, what follows the "
         "picture in memory",
         [](double u, std::int64_t size) {
             const auto w = static_cast<double>(size);
             return static_cast<std::int64_t>(std::clamp(u * w, 0.0, w));
         }},
        {"texture.clamp-to-last", TexelWrap::clamp, "x = u w, clamped to [0, w - 1]; texel x, rounded down",
         "the usual repair", "never leaves the row; within an ulp below a border u w is rounded to the next texel",
         [](double u, std::int64_t size) {
             return static_cast<std::int64_t>(
                 std::clamp(u * static_cast<double>(size), 0.0, static_cast<double>(size - 1)));
         }},
        {"texture.scale-by-last", TexelWrap::clamp, "x = u (w - 1), clamped to [0, w - 1]; texel x, rounded to nearest",
         "another usual repair",
         "never leaves the row; the first and last texel are half as wide as the others, so that borders are off by up "
         "to half a texel",
         [](double u, std::int64_t size) {
             const auto last = static_cast<double>(size - 1);
             return static_cast<std::int64_t>(std::floor(std::clamp(u * last, 0.0, last) + 0.5));
         }},
        {"texture.exact-clamp", TexelWrap::clamp, "floor(u w) exactly, at most w - 1, at least 0",
         "floor of the rounded product, corrected by the sign of the fused remainder", "on no finite u",
         [](double u, std::int64_t size) {
             if (!(u > 0)) return std::int64_t{0};
             return u < 1 ? floor_of_product(u, size) : size - 1;
         }},
        {"texture.fraction", TexelWrap::repeat, "x = (u - floor(u)) w; texel x, rounded down",
         "tutorials on repeated textures; fract() of shading languages",
         "u = -2^-60: 1 - 2^-60 is rounded to 1, which gives texel w, one past the last",
         [](double u, std::int64_t size) {
             return static_cast<std::int64_t>((u - std::floor(u)) * static_cast<double>(size));
         }},
        {"texture.exact-repeat", TexelWrap::repeat, "floor((u - floor(u)) w) exactly",
         "for u < 0 as w - ceil(f w), f = -u - floor(-u), whose fraction is exact", "on no finite u", exact_repeat},
    };
    return rules;
}

std::vector<TexelResult> audit_texels(const std::vector<TexelRule>& rules, std::uint64_t count, std::uint64_t seed) {
    const ExactEnvironment environment;
    std::vector<TexelResult> results;
    results.reserve(rules.size());
    for (const TexelRule& rule : rules) results.push_back({rule, 0, {}, {}});
    for (std::uint64_t i = 0; i < count; ++i) {
        base::Random random = base::Random::stream(seed, base::hash64("texels"), i);
        std::int64_t size = texel_count(random);
        double u = coordinate(random, size);
        if (i < known_failures.size()) std::tie(u, size) = known_failures[i];
        for (TexelResult& result : results)
            add(result, u, size, oracle_texel(u, size, result.rule.wrap == TexelWrap::repeat));
    }
    return results;
}

}  // namespace barycert

/// The audit of rules that find the texel of a texture coordinate.
///
/// A row of `size` texels covers the coordinates u from 0 to 1: texel k those from k / size up to (k + 1) / size, the
/// last one u = 1 too. What lies beyond belongs to the first or last texel (clamp) or to the copies of the row side by
/// side (repeat). The same holds of v and columns. A rule is code that computes k; it is held against exact integers on
/// coordinates where such code is known to fail: at and within a few ulps of the borders of texels, at and beyond both
/// ends, subnormal, huge.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace barycert {

enum class TexelWrap : std::uint8_t { clamp, repeat };

constexpr std::string_view name(TexelWrap w) {
    return w == TexelWrap::clamp ? "clamp" : "repeat";
}

struct TexelRule {
    std::string name;  ///< `texture.rule`
    TexelWrap wrap = TexelWrap::clamp;
    std::string formula, source, fails;                            ///< one line each, as those of Kernel
    std::int64_t (*texel)(double u, std::int64_t size) = nullptr;  ///< u finite, 1 <= size <= 2^31
};

/// All rules, in a fixed order: faults that are in use, and the exact ones.
const std::vector<TexelRule>& texel_rules();

enum class TexelFinding : std::uint8_t {
    past_end,      ///< size or more: reads what is not of the row
    before_start,  ///< negative
    wrong_texel,   ///< of the row, but not the one of u
};

inline constexpr std::array<std::string_view, 3> texel_finding_names{"past_end", "before_start", "wrong_texel"};

struct TexelWitness {
    double u = 0;
    std::int64_t size = 0, texel = 0, exact = 0;
};

struct TexelResult {
    TexelRule rule;
    std::uint64_t cases = 0;
    std::array<std::uint64_t, 3> counts{};    ///< by TexelFinding
    std::array<TexelWitness, 3> witnesses{};  ///< the first of each, where there is one
};

/// Holds each rule against the oracle on the same coordinates for rows of 1 to 2^31 texels.
std::vector<TexelResult> audit_texels(const std::vector<TexelRule>& rules, std::uint64_t count = 100000,
                                      std::uint64_t seed = 1);

}  // namespace barycert

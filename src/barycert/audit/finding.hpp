/// What an audit can find wrong with a kernel's answer, worst first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace barycert::audit {

enum class Finding : std::uint8_t {
    false_certificate,  // per case from here on
    false_declaration,
    false_inside,
    false_outside,
    missed_degenerate,
    opposite_sign,  // per weight from here on
    false_zero,
    false_nonzero,
    not_finite,
};

inline constexpr std::size_t finding_count = 9;

struct FindingText {
    std::string_view name;
    std::string_view meaning;
};

inline constexpr std::array<FindingText, finding_count> finding_texts{{
    {"false_certificate", "the kernel certifies its answers, and this one has a finding or is not correctly rounded"},
    {"false_declaration", "the kernel declares a simplex degenerate that is not"},
    {"false_inside", "the point is outside; the kernel says interior or boundary"},
    {"false_outside", "the point is inside or on the boundary; the kernel says outside"},
    {"missed_degenerate", "the simplex is degenerate; the kernel gives finite weights"},
    {"opposite_sign", "a weight has the sign opposite to the exact one"},
    {"false_zero", "a weight is zero and the exact one is not"},
    {"false_nonzero", "a weight is not zero and the exact one is"},
    {"not_finite", "a weight is NaN or infinite and the simplex is not degenerate"},
}};

constexpr std::string_view name(Finding f) {
    return finding_texts[static_cast<std::size_t>(f)].name;
}

constexpr std::optional<Finding> finding_named(std::string_view text) {
    for (std::size_t i = 0; i < finding_count; ++i) {
        if (finding_texts[i].name == text) return static_cast<Finding>(i);
    }
    return std::nullopt;
}

}  // namespace barycert::audit

/// The pieces of a cut in a cell, by the states of its nodes: a table made when compiling.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace barycert::surface {

/// The state of a node, two bits: bit 0 is set if it is in the set.
enum State : std::uint8_t {
    outside = 0,
    inside = 1,   ///< g > 0
    unknown = 2,  ///< g is not finite
    on = 3,       ///< g = 0, in the set
};

/// A point of the cut: the corner inside and the one outside, or a corner on the cut, twice.
struct Crossing {
    std::uint8_t in = 0, out = 0;

    friend constexpr bool operator==(const Crossing&, const Crossing&) = default;
};

/// The part of a positive cell of n corners: triangles (n = 4) or a segment (n = 3) of the distinct crossings that they
/// use.
template <std::size_t n>
struct CellCase {
    bool left_out = false;  ///< a node is unknown
    std::uint8_t part_count = 0, crossing_count = 0;
    std::array<Crossing, n> crossings{};
    std::array<std::array<std::uint8_t, n - 1>, n - 2> parts{};  ///< numbers of crossings

    constexpr void add(const std::array<Crossing, n - 1>& part) {
        for (std::size_t i = 0; i < n - 1; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (part[i] == part[j]) return;  // it has collapsed
            }
        }
        for (std::size_t i = 0; i < n - 1; ++i) {
            std::uint8_t at = 0;
            while (at < crossing_count && crossings[at] != part[i]) ++at;
            if (at == crossing_count) crossings[crossing_count++] = part[i];
            parts[part_count][i] = at;
        }
        ++part_count;
    }
};

/// The corners i ... of an even permutation: those of the set first, in ascending order as far as that goes.
template <std::size_t n>
struct SplitCorners {
    std::array<std::uint8_t, n> order{};
    std::size_t inside_count = 0;

    constexpr explicit SplitCorners(const std::array<std::uint8_t, n>& states) {
        std::size_t count = 0;
        for (const int wanted : {1, 0}) {
            for (std::size_t i = 0; i < n; ++i) {
                if ((states[i] & 1) == wanted) order[count++] = static_cast<std::uint8_t>(i);
            }
            if (wanted == 1) inside_count = count;
        }
        bool even = true;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < i; ++j) even = even == (order[j] < order[i]);
        }
        if (even) return;
        // Two of the same kind change places: with three corners or more there are two.
        const std::size_t at = inside_count >= 2 ? 0 : n - 2;
        std::swap(order[at], order[at + 1]);
    }
};

/// For the unit cell (0, e_x, e_y, e_z) with the first corner inside, the crossings of the edges to the others in this
/// order have the normal (1, 1, 1), out of the set; with the first two inside, the crossings 0-2, 0-3, 1-3, 1-2 have
/// the normal (0, 1, 1). In the plane, with the first inside, the segment from 0-1 to 0-2 has it to the left. Even
/// permutations are rotations of this. One corner outside: the same with the other orientation.
template <std::size_t n>
constexpr CellCase<n> cell_case(const std::array<std::uint8_t, n>& states) {
    CellCase<n> result;
    for (const std::uint8_t s : states) result.left_out = result.left_out || s == unknown;
    const SplitCorners<n> split(states);
    const std::size_t count = split.inside_count;
    if (result.left_out || count == 0 || count == n) return result;
    const auto& c = split.order;
    const auto between = [&](std::size_t in, std::size_t out) {
        return states[c[in]] == on ? Crossing{c[in], c[in]} : Crossing{c[in], c[out]};
    };
    if constexpr (n == 3) {
        if (count == 1) result.add({between(0, 1), between(0, 2)});
        // (c0, c1, c2) even with c2 alone outside: so is (c2, c0, c1).
        if (count == 2) result.add({between(1, 2), between(0, 2)});
    } else {
        if (count == 1) result.add({between(0, 1), between(0, 2), between(0, 3)});
        if (count == 2) {
            const std::array<Crossing, 4> ring{between(0, 2), between(0, 3), between(1, 3), between(1, 2)};
            result.add({ring[0], ring[1], ring[2]});
            result.add({ring[0], ring[2], ring[3]});
        }
        // (c0, c1, c2, c3) even with c3 alone outside: (c3, c0, c1, c2) is odd, so its crossings face c3 as they are.
        if (count == 3) result.add({between(0, 3), between(1, 3), between(2, 3)});
    }
    return result;
}

/// By the states of the corners, corner i at bits 2 i and 2 i + 1.
template <std::size_t n>
inline constexpr auto cell_cases = [] {
    std::array<CellCase<n>, std::size_t{1} << (2 * n)> all{};
    for (std::size_t index = 0; index < all.size(); ++index) {
        std::array<std::uint8_t, n> states{};
        for (std::size_t i = 0; i < n; ++i) states[i] = static_cast<std::uint8_t>(index >> (2 * i) & 3);
        all[index] = cell_case<n>(states);
    }
    return all;
}();

}  // namespace barycert::surface

/// The exact signs of the barycentric weights of one point, in two bytes.
#pragma once

#include <bit>
#include <cstdint>

#include "barycert/core/simplex.hpp"

namespace barycert {

enum class Sign : std::int8_t { negative = -1, zero = 0, positive = 1 };

class WeightSigns {
public:
    /// Bit i: weight i is negative. Bit 4+i: weight i is zero. Bit 8: the simplex is oriented negatively. Bit 9: it is
    /// degenerate, and all other bits are clear.
    using Bits = std::uint16_t;

    constexpr WeightSigns() = default;
    constexpr explicit WeightSigns(Bits bits) : bits_(bits) {}
    static constexpr WeightSigns degenerate_simplex() { return WeightSigns(Bits{1} << 9); }

    constexpr Bits bits() const { return bits_; }
    constexpr bool degenerate() const { return (bits_ >> 9) != 0; }

    /// Of the simplex: its signed area or volume. Segment and triangle3d have none: positive unless degenerate.
    constexpr Sign orientation() const {
        return degenerate() ? Sign::zero : (bits_ >> 8 & 1) != 0 ? Sign::negative : Sign::positive;
    }

    /// Of weight i, 0 <= i < vertex_count(simplex); zero if degenerate.
    constexpr Sign sign(int i) const {
        if (degenerate() || (bits_ >> (4 + i) & 1) != 0) return Sign::zero;
        return (bits_ >> i & 1) != 0 ? Sign::negative : Sign::positive;
    }

    constexpr Region region() const {
        if (degenerate()) return Region::degenerate;
        if ((bits_ & 0xf) != 0) return Region::outside;
        return (bits_ & 0xf0) != 0 ? Region::boundary : Region::interior;
    }

    /// The open face that holds the point (or, for simplices that are projected on, its projection).
    constexpr Feature feature(Simplex s) const {
        const Region r = region();
        if (r == Region::degenerate) return Feature::degenerate;
        if (r == Region::outside) return Feature::outside;
        if (r == Region::interior) return Feature::interior;
        const int support = vertex_count(s) - std::popcount(static_cast<unsigned>(bits_ & 0xf0));
        return support == 1 ? Feature::vertex : support == 2 ? Feature::edge : Feature::face;
    }

    /// The point lies in the closed simplex.
    constexpr bool contains() const { return (bits_ & 0x20f) == 0; }

    friend constexpr bool operator==(WeightSigns, WeightSigns) = default;

private:
    Bits bits_ = 0;
};

}  // namespace barycert

/// Sorting by small whole numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "barycert/locate/buffer.hpp"

namespace barycert::locate {

struct KeyedPlace {
    std::uint32_t key;
    std::int32_t place;
};

/// Ascending keys of `bits` bits; equal ones keep their order. Passes of at most 12 bits each, from the lowest.
inline void sort_by_key(Buffer<KeyedPlace>& items, int bits) {
    Buffer<KeyedPlace> other(items.size());
    const int passes = (bits + 11) / 12;
    for (int pass = 0, shift = 0; pass < passes; ++pass) {
        const int width = (bits - shift) / (passes - pass);
        std::array<std::uint32_t, 1 << 12> next{};
        const std::uint32_t mask = (1U << width) - 1;
        for (const KeyedPlace& item : items) ++next[item.key >> shift & mask];
        std::uint32_t sum = 0;
        for (std::uint32_t& n : next) sum += std::exchange(n, sum);
        for (const KeyedPlace& item : items) other[next[item.key >> shift & mask]++] = item;
        std::swap(items, other);
        shift += width;
    }
}

}  // namespace barycert::locate

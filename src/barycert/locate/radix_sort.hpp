/// Internal: sorting by small whole numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "barycert/locate/buffer.hpp"

namespace barycert::detail {

struct KeyedPlace {
    std::uint32_t key;
    std::int32_t place;
};

/// Ascending keys of `bits` bits; equal ones keep their order. Two passes of at most 12 bits each, from the lowest.
/// Precondition: bits <= 24.
inline void sort_by_key(Buffer<KeyedPlace>& items, int bits) {
    Buffer<KeyedPlace> other(items.size());
    const int low_bits = bits / 2;
    const auto pass = [](const Buffer<KeyedPlace>& from, Buffer<KeyedPlace>& to, int shift, int width) {
        std::array<std::uint32_t, 1 << 12> next{};
        const std::uint32_t mask = (1U << width) - 1;
        for (const KeyedPlace& item : from) ++next[item.key >> shift & mask];
        std::uint32_t sum = 0;
        for (std::uint32_t& n : next) sum += std::exchange(n, sum);
        for (const KeyedPlace& item : from) to[next[item.key >> shift & mask]++] = item;
    };
    pass(items, other, 0, low_bits);
    pass(other, items, low_bits, bits - low_bits);
}

}  // namespace barycert::detail

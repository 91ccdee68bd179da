/// Sorting by small whole numbers.
#pragma once

#include <cstdint>

#include "barycert/index/buffer.hpp"

namespace barycert::index {

struct KeyedPlace {
    std::uint32_t key;
    std::int32_t place;
};

/// Ascending keys of `bits` <= 32 bits; equal ones keep their order. On the threads of the calling arena.
void sort_by_key(Buffer<KeyedPlace>& items, int bits);

}  // namespace barycert::index

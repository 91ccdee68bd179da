/// Steps of many walks at once, on SIMD lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "barycert/locate/cell_index.hpp"

namespace barycert::locate {

/// A point among others in the order of the bins. 2D: z = 0.
struct alignas(32) PointRecord {
    std::array<double, 3> at;
    std::uint32_t number;  ///< where its results go
    std::uint32_t bin;
};

/// Points that are found together: enough for full lanes in every round of the walks, few enough for the first cache.
inline constexpr std::size_t chunk_size = 1024;

/// Where a walk stands.
struct alignas(8) Walk {
    std::uint32_t point;
    Place cell;
};

/// With room for a vector more than the points of a chunk.
struct WalkList {
    std::array<Walk, chunk_size + 8> walks;
    std::size_t count = 0;
};

/// Memory that will be read soon. Asking for much at once would keep others waiting, so it is done bit by bit.
struct MemoryAhead {
    std::array<const void*, 16 * chunk_size> address;
    std::size_t count = 0, done = 0;

    void add(const void* what) {
        if (count < address.size()) address[count++] = what;
    }
    /// Every line of [begin, end).
    template <class T>
    void add(const T* begin, const T* end) {
        constexpr std::uintptr_t line = 64;
        const auto last = reinterpret_cast<std::uintptr_t>(end);
        for (auto at = reinterpret_cast<std::uintptr_t>(begin) & ~(line - 1); at < last; at += line)
            add(reinterpret_cast<const void*>(at));
    }
    void ask(std::size_t number) {
        for (const std::size_t end = std::min(count, done + number); done < end; ++done)
            __builtin_prefetch(address[done], 0, 2);
    }
};

/// One step of each of `count` walks. Where the point is certainly inside the cell, the walk ends and goes to `arrived`;
/// where it is certainly beyond a facet that has a neighbour, it goes on there; these walks are moved to the front of
/// `walks`, and their number is returned. All others, on facets or at the end of the domain or in doubt, go to `stuck`,
/// with the cell where they stand, or ~cell if the point is certainly outside of it. `walks` is of the size of a
/// WalkList. `nodes`: those of the index, or a copy. `fetch`: ask for the memory that a step will read some steps
/// before. In between `ahead` is asked for.
std::size_t step_walks(const CellIndex& index, const NodeRecord* nodes, const PointRecord* points, Walk* walks,
                       std::size_t count, bool fetch, MemoryAhead& ahead, WalkList& arrived, WalkList& stuck);

}  // namespace barycert::locate

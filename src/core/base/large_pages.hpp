/// Memory too large for the usual pages.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace barycert::base {

inline constexpr std::size_t large_page = std::size_t{1} << 21;

/// Asks the system for large pages in the part of the memory that can have them. A hint: failing changes nothing.
inline void ask_for_large_pages([[maybe_unused]] void* start, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    if (bytes >= large_page && std::align(large_page, large_page, start, bytes) != nullptr)
        ::madvise(start, bytes, MADV_HUGEPAGE);
#endif
}

/// resize(count) of an empty vector on large pages: half the time of a large read would else go into page faults.
template <class T>
void resize_large(std::vector<T>& values, std::size_t count) {
    values.reserve(count);
    ask_for_large_pages(values.data(), count * sizeof(T));
    values.resize(count);
}

}  // namespace barycert::base

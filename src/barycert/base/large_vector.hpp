/// Vectors too large for the usual pages.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace barycert::base {

/// values.resize(count) of an empty vector, asking for large pages first: half the time of a large read would else go
/// into page faults.
template <class T>
void resize_large(std::vector<T>& values, std::size_t count) {
    values.reserve(count);
#ifdef MADV_HUGEPAGE
    constexpr std::size_t large_page = std::size_t{1} << 21;
    void* start = values.data();
    std::size_t space = count * sizeof(T);
    if (space > large_page && std::align(large_page, large_page, start, space) != nullptr) {
        ::madvise(start, space, MADV_HUGEPAGE);  // a hint: failing changes nothing
    }
#endif
    values.resize(count);
}

}  // namespace barycert::base

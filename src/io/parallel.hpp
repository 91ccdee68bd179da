/// Work on the numbers of files, on all threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "barycert/environment.hpp"
#include "core/base/large_pages.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::io {

/// work(i) for i = 0 to count - 1, in any order.
template <class Work>
void in_parallel(std::size_t count, Work work) {
    if (count == 1) {
        work(std::size_t{0});
    } else if (count != 0) {
        // Isolated: while this thread waits, it must not begin other work of its caller's.
        base::isolated([&] {
            base::parallel_for(count, [&](std::size_t i) {
                const ExactEnvironment of_task;  // the arena is the caller's
                work(i);
            });
        });
    }
}

/// work(first, last) for parts of [0, count) of `part` at most.
template <class Work>
void in_parts(std::size_t count, std::size_t part, Work work) {
    in_parallel((count + part - 1) / part, [&](std::size_t i) { work(i * part, std::min(count, (i + 1) * part)); });
}

/// good(first, last) of such parts tells where the first fault in it may be, or `last`; that of the first part with
/// one, or `count`. Parts behind a fault may be left out.
template <class Good>
std::size_t first_bad(std::size_t count, std::size_t part, Good good) {
    std::atomic<std::size_t> least{count};
    in_parts(count, part, [&](std::size_t first, std::size_t last) {
        if (least.load(std::memory_order_relaxed) <= first) return;
        const std::size_t found = good(first, last);
        std::size_t known = least.load();
        while (found != last && found < known && !least.compare_exchange_weak(known, found)) {
        }
    });
    return least;
}

/// Room for bytes, which hold anything until they are written.
class ByteRoom {
public:
    /// `size` bytes; what stood there is lost.
    char* of(std::size_t size) {
        if (size_ < size) {
            bytes_.reset();
            bytes_ = std::make_unique_for_overwrite<char[]>(size);
            base::ask_for_large_pages(bytes_.get(), size);
            size_ = size;
        }
        return bytes_.get();
    }

private:
    std::unique_ptr<char[]> bytes_;
    std::size_t size_ = 0;
};

/// Room for `count` more values, and at least twice what there was where it has to move.
template <class T>
void make_room(std::vector<T>& values, std::size_t count) {
    const std::size_t wanted = values.size() + count;
    if (wanted <= values.capacity()) return;
    values.reserve(std::max(wanted, 2 * values.capacity()));
    base::ask_for_large_pages(values.data(), values.capacity() * sizeof(T));
}

/// `count` more values, for which make_room may have made room.
template <class T>
void grow(std::vector<T>& values, std::size_t count) {
    make_room(values, count);
    values.resize(values.size() + count);
}

}  // namespace barycert::io

/// Long work: without the interpreter's lock, with Ctrl-C and progress between blocks.
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string_view>
#include <utility>

namespace barycert::python {

/// Who is told of progress: None, or a callable of (stage, done, total); total 0: not counted.
class Progress {
public:
    explicit Progress(pybind11::object callable) : callable_(std::move(callable)) {}

    /// To be called without the lock. Throws what a signal handler or the callable raised.
    void tell(std::string_view stage, std::size_t done, std::size_t total) const {
        const pybind11::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
        if (!callable_.is_none()) callable_(pybind11::str(stage.data(), stage.size()), done, total);
    }

private:
    pybind11::object callable_;
};

/// Points that cost next to nothing begin with so many that sorting them pays; all else begins with few.
inline constexpr std::size_t smallest_first_block = 4096, largest_first_block = std::size_t{1} << 20;

/// body(first, count) for parts of [0, total), without the lock. Parts grow and shrink such that one takes some tenths
/// of a second, after which Ctrl-C is noticed.
template <class Body>
void in_blocks(const Progress& progress, std::string_view stage, std::size_t total, const Body& body,
               std::size_t size = smallest_first_block) {
    using Clock = std::chrono::steady_clock;
    using std::chrono_literals::operator""ms;
    constexpr std::size_t smallest = 64;
    const pybind11::gil_scoped_release unlocked;
    for (std::size_t first = 0; first < total;) {
        const std::size_t count = std::min(size, total - first);
        const Clock::time_point begin = Clock::now();
        body(first, count);
        const Clock::duration taken = Clock::now() - begin;
        first += count;
        progress.tell(stage, first, total);
        if (taken < 50ms) size *= 4;
        if (taken > 400ms) size = std::max(size / 4, smallest);
    }
}

}  // namespace barycert::python

/// What the parts of barycert._core share. What Python users see is made of them in barycert/*.py, which checks and
/// converts arguments; these take arrays as they are.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace barycert::python {

namespace py = pybind11;

void bind_mesh(py::module_& module);
void bind_locate(py::module_& module);
void bind_sampler(py::module_& module);
void bind_check(py::module_& module);
void bind_simplex(py::module_& module);
void bind_verify(py::module_& module);
void bind_audit(py::module_& module);

// Errors: what is thrown as Exception becomes barycert.Error.

/// The value, or the Error thrown.
template <class T>
T take(Result<T> result) {
    return std::move(result).value();
}

inline void check(const Status& status) {
    if (!status) throw Exception(status.error());
}

// Options by the words of Python's arguments; an Error of another word.

/// nan, raise, fill, nearest or extrapolate.
OutsidePolicy outside_policy(const std::string& outside, double fill, double limit);
/// error or nan.
NonfinitePoints nonfinite_points(const std::string& nonfinite);

// Arrays of NumPy as spans, and vectors as arrays of NumPy, without copies.

template <class T>
using Array = py::array_t<T, py::array::c_style>;

/// What the Python part hands over: contiguous and of this type; any other array is a TypeError, never a hidden copy.
template <class T>
struct Given : Array<T> {
    using Array<T>::Array;
};

template <class T>
std::span<const T> span_of(const Array<T>& array) {
    return {array.data(), static_cast<std::size_t>(array.size())};
}

using Shape = std::vector<py::ssize_t>;

inline py::ssize_t extent(std::size_t n) {
    return static_cast<py::ssize_t>(n);
}

/// What lives as long as an array that looks at it.
template <class T>
py::capsule keeper(T&& thing) {
    auto keep = std::make_unique<T>(std::move(thing));
    py::capsule owner(keep.get(), [](void* p) { delete static_cast<T*>(p); });
    (void)keep.release();
    return owner;
}

/// An array that owns the vector.
template <class T>
py::array owned(std::vector<T>&& numbers, Shape shape = {}) {
    if (shape.empty()) shape = {extent(numbers.size())};
    const T* const data = numbers.data();
    return Array<T>(std::move(shape), data, keeper(std::move(numbers)));
}

/// An array that looks at memory which `owner` keeps; it cannot be written to.
template <class T>
py::array view(const std::vector<T>& numbers, std::shared_ptr<const void> owner, std::size_t columns = 0) {
    Shape shape{extent(numbers.size() / std::max<std::size_t>(columns, 1))};
    if (columns > 0) shape.push_back(extent(columns));
    Array<T> array(std::move(shape), numbers.data(), keeper(std::move(owner)));
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

// Long work: without the interpreter's lock, with Ctrl-C and progress between blocks.

/// Who is told of progress: None, or a callable of (stage, done, total); total 0: not counted.
class Progress {
public:
    explicit Progress(py::object callable) : callable_(std::move(callable)) {}

    /// To be called without the lock. Throws what a signal handler or the callable raised.
    void tell(std::string_view stage, std::size_t done, std::size_t total) const {
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!callable_.is_none()) callable_(py::str(stage.data(), stage.size()), done, total);
    }

private:
    py::object callable_;
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
    const py::gil_scoped_release unlocked;
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

template <class T>
struct pybind11::detail::pyobject_caster<barycert::python::Given<T>> {
    PYBIND11_TYPE_CASTER(barycert::python::Given<T>, const_name("numpy.ndarray"));
    bool load(handle from, bool) {
        if (!barycert::python::Array<T>::check_(from)) return false;
        value = reinterpret_borrow<barycert::python::Given<T>>(from);
        return true;
    }
};

/// Arrays of NumPy as spans, and vectors as arrays of NumPy, without copies.
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace barycert::python {

/// What the Python part hands over: contiguous and of this type; any other array is a TypeError, never a hidden copy.
template <class T>
using Array = pybind11::array_t<T, pybind11::array::c_style>;

template <class T>
std::span<const T> span_of(const Array<T>& array) {
    return {array.data(), static_cast<std::size_t>(array.size())};
}

using Shape = std::vector<pybind11::ssize_t>;

inline pybind11::ssize_t extent(std::size_t n) {
    return static_cast<pybind11::ssize_t>(n);
}

/// An array that owns the vector.
template <class T>
pybind11::array owned(std::vector<T>&& numbers, Shape shape = {}) {
    if (shape.empty()) shape = {extent(numbers.size())};
    auto keep = std::make_unique<std::vector<T>>(std::move(numbers));
    const T* const data = keep->data();
    const pybind11::capsule owner(keep.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
    (void)keep.release();
    return Array<T>(std::move(shape), data, owner);
}

/// An array that looks at memory which `owner` keeps; it cannot be written to.
template <class T>
pybind11::array view(const T* data, Shape shape, const std::shared_ptr<const void>& owner) {
    auto keep = std::make_unique<std::shared_ptr<const void>>(owner);
    const pybind11::capsule base(keep.get(), [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
    (void)keep.release();
    Array<T> array(std::move(shape), data, base);
    array.attr("setflags")(pybind11::arg("write") = false);
    return array;
}

}  // namespace barycert::python

/// barycert::Error as an exception of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

#include "barycert/result.hpp"

namespace barycert::python {

/// barycert.Error, a ValueError with the message and its parts as attributes, and what is thrown as Exception becomes
/// it.
void bind_errors(pybind11::module_& module);

/// The value, or the Error thrown.
template <class T>
T take(Result<T> result) {
    return std::move(result).value();
}

inline void check(const Status& status) {
    if (!status) throw Exception(status.error());
}

}  // namespace barycert::python

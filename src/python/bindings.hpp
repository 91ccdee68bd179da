/// The parts of barycert._core. What Python users see is made of them in barycert/*.py, which checks and converts
/// arguments; these take arrays as they are.
#pragma once

#include <pybind11/pybind11.h>

namespace barycert::python {

void bind_mesh(pybind11::module_& module);
void bind_locate(pybind11::module_& module);
void bind_sampler(pybind11::module_& module);
void bind_check(pybind11::module_& module);
void bind_predicates(pybind11::module_& module);
void bind_weights(pybind11::module_& module);
void bind_verify(pybind11::module_& module);
void bind_audit(pybind11::module_& module);

}  // namespace barycert::python

// barycert._core: the library as Python sees it. See barycert/__init__.py.
#include "bindings.hpp"
#include "errors.hpp"

PYBIND11_MODULE(_core, module) {
    using namespace barycert::python;
    module.doc() = "The compiled part of barycert; use the names of the package.";
    module.attr("version") = BARYCERT_VERSION;
    bind_errors(module);
    bind_mesh(module);
    bind_locate(module);
    bind_sampler(module);
    bind_check(module);
    bind_predicates(module);
    bind_weights(module);
    bind_verify(module);
    bind_audit(module);
}

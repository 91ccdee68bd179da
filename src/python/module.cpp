// barycert._core: the library as Python sees it. See barycert/__init__.py.
#include <exception>

#include "bindings.hpp"

namespace barycert::python {
namespace {

/// Lives as long as the process, as types of exceptions do.
PyObject* error_type = nullptr;

void set_error(const Error& error) {
    // The parts may hold bytes of any file.
    const auto text = [](const std::string& s) {
        return py::reinterpret_steal<py::object>(
            PyUnicode_DecodeUTF8(s.data(), static_cast<Py_ssize_t>(s.size()), "backslashreplace"));
    };
    const py::object exception = py::handle(error_type)(text(error.message()));
    exception.attr("code") = text(std::string(error.code.name()));
    exception.attr("what") = text(error.what);
    exception.attr("file") = text(error.file);
    exception.attr("expected") = text(error.expected);
    exception.attr("found") = text(error.found);
    exception.attr("remedy") = text(error.remedy);
    exception.attr("line") = error.line;
    exception.attr("subject") = text(error.subject);
    PyErr_SetObject(error_type, exception.ptr());
}

void bind_errors(py::module_& module) {
    error_type =
        PyErr_NewExceptionWithDoc("barycert.Error",
                                  "What went wrong with an input. `code` is a stable name of its kind "
                                  "(doc/errors.md). str() is the whole message; its parts, empty where they do not "
                                  "apply, are `what`, `file`, `line` (from 1; 0: none), `expected`, `found` and "
                                  "`remedy`. `subject`: the member of a job that it is about.",
                                  PyExc_ValueError, nullptr);
    if (error_type == nullptr) throw py::error_already_set();
    module.attr("Error") = py::handle(error_type);
    // NOLINTNEXTLINE(performance-unnecessary-value-param): the type of pybind11's translators
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Exception& e) {
            set_error(e.error());
        }
    });
    module.def(
        "fail",
        [](const std::string& code, const std::string& what, const std::string& expected, const std::string& found,
           const std::string& remedy) {
            throw Exception(file_error(ErrorCode::named(code).value(), {}, what, expected, found, remedy));
        },
        py::arg("code"), py::arg("what"), py::arg("expected") = "", py::arg("found") = "", py::arg("remedy") = "",
        "Raises Error with these parts.");
}

}  // namespace
}  // namespace barycert::python

PYBIND11_MODULE(_core, module) {
    using namespace barycert::python;
    module.doc() = "The compiled part of barycert; use the names of the package.";
    module.attr("version") = BARYCERT_VERSION;
    bind_errors(module);
    bind_mesh(module);
    bind_points(module);
    bind_check(module);
    bind_simplex(module);
    bind_surface(module);
    bind_figure(module);
    module.attr("has_audit") = false;
#ifdef BARYCERT_WITH_AUDIT
    bind_audit(module);
#endif
}

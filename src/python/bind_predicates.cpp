#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "barycert/predicates.hpp"
#include "bindings.hpp"
#include "blocks.hpp"
#include "errors.hpp"

namespace barycert::python {
namespace {

namespace py = pybind11;

/// A point of an array of points, any strides.
struct Rows {
    const char* data;
    py::ssize_t stride, coordinate_stride;

    template <std::size_t d>
    std::array<double, d> at(std::size_t i) const {
        std::array<double, d> point;
        for (std::size_t k = 0; k < d; ++k)
            point[k] = *reinterpret_cast<const double*>(data + static_cast<py::ssize_t>(i) * stride +
                                                        static_cast<py::ssize_t>(k) * coordinate_stride);
        return point;
    }
};

/// Signs (n) of predicate(point of each argument), whose arguments are arrays (n, d).
template <std::size_t d, std::size_t... i, class Predicate>
py::array signs(const Predicate& predicate, const std::array<py::array_t<double>, sizeof...(i)>& points,
                std::index_sequence<i...>, const py::object& callable) {
    const auto count = static_cast<std::size_t>(points[0].shape(0));
    const std::array<Rows, sizeof...(i)> rows{
        Rows{static_cast<const char*>(points[i].request().ptr), points[i].strides(0), points[i].strides(1)}...};
    std::vector<std::int8_t> out(count);
    in_blocks(Progress(callable), "cases", count, [&](std::size_t first, std::size_t n) {
        for (std::size_t row = first; row < first + n; ++row) {
            const std::tuple points_of_row{rows[i].template at<d>(row)...};
            const Result<Sign> sign = predicate(std::get<i>(points_of_row).data()...);
            if (!sign) {
                Error error = sign.error();
                error.what = "case " + std::to_string(row) + ": " + error.what;
                throw Exception(std::move(error));
            }
            out[row] = static_cast<std::int8_t>(*sign);
        }
    });
    return owned(std::move(out));
}

template <std::size_t d, std::size_t arguments, class Predicate>
void bind(py::module_& module, const char* name, Predicate predicate) {
    module.def(
        name,
        [predicate](const std::array<py::array_t<double>, arguments>& points, const py::object& progress) {
            return signs<d>(predicate, points, std::make_index_sequence<arguments>(), progress);
        },
        py::arg("points"), py::arg("progress") = py::none());
}

}  // namespace

void bind_predicates(py::module_& module) {
    bind<2, 3>(module, "orient2d", checked_orient2d);
    bind<3, 4>(module, "orient3d", checked_orient3d);
    bind<3, 6>(module, "det3d", checked_det3d);
    bind<2, 4>(module, "incircle", checked_incircle);
    bind<3, 5>(module, "insphere", checked_insphere);
}

}  // namespace barycert::python

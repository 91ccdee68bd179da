#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"
#include "bindings.hpp"

namespace barycert::python {
namespace {

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
                std::index_sequence<i...>) {
    const auto count = static_cast<std::size_t>(points[0].shape(0));
    const std::array<Rows, sizeof...(i)> rows{
        Rows{static_cast<const char*>(points[i].request().ptr), points[i].strides(0), points[i].strides(1)}...};
    std::vector<std::int8_t> out(count);
    in_blocks(Progress(py::none()), "cases", count, [&](std::size_t first, std::size_t n) {
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
    module.def(name, [predicate](const std::array<py::array_t<double>, arguments>& points) {
        return signs<d>(predicate, points, std::make_index_sequence<arguments>());
    });
}

/// The simplex with that many vertices of that many coordinates.
Simplex simplex_of(std::size_t vertices, std::size_t coordinates) {
    for (const Simplex s : all_simplices) {
        if (static_cast<std::size_t>(vertex_count(s)) == vertices &&
            static_cast<std::size_t>(space_dimension(s)) == coordinates)
            return s;
    }
    throw Exception({.what = "shape of the vertices",
                     .expected = "(..., 2, 3) segments, (..., 3, 2) or (..., 3, 3) triangles, (..., 4, 3) tetrahedra",
                     .found = "(..., " + std::to_string(vertices) + ", " + std::to_string(coordinates) + ")"});
}

/// Cases as the library takes them: a simplex a case, whose vertices are nodes of its own.
struct Cases {
    Cases(const Given<double>& vertices, const Given<double>& points)
        : simplex(simplex_of(static_cast<std::size_t>(vertices.shape(1)), static_cast<std::size_t>(vertices.shape(2)))),
          n(static_cast<std::size_t>(vertex_count(simplex))),
          d(static_cast<std::size_t>(space_dimension(simplex))),
          count(static_cast<std::size_t>(vertices.shape(0))),
          nodes(span_of(vertices)),
          at(span_of(points)) {
        corners.resize(n * largest);
        cells.resize(largest);
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::int32_t>(i);
        for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<std::int32_t>(i);
    }

    /// visit(queries, number of the first case) for parts of cases [first, first + size).
    template <class Visit>
    void visit(std::size_t first, std::size_t size, const Visit& visit) const {
        for (std::size_t done = 0; done < size; done += largest) {
            const std::size_t some = std::min(largest, size - done), begin = first + done;
            visit(MeshQueries{simplex, nodes.subspan(n * d * begin, n * d * some), std::span(corners).first(n * some),
                              std::span(cells).first(some), at.subspan(d * begin, d * some)},
                  begin);
        }
    }

    static constexpr std::size_t largest = 4096;
    Simplex simplex;
    std::size_t n, d, count;
    std::span<const double> nodes, at;
    std::vector<std::int32_t> corners, cells;
};

/// vertices (m, n, d), points (m, d): weights (m, n).
py::array weights(const Given<double>& vertices, const Given<double>& points) {
    const Cases cases(vertices, points);
    std::vector<double> out(cases.count * cases.n);
    in_blocks(Progress(py::none()), "cases", cases.count, [&](std::size_t first, std::size_t size) {
        cases.visit(first, size, [&](const MeshQueries& queries, std::size_t begin) {
            check(barycentric_weights(queries, std::span(out).subspan(cases.n * begin, cases.n * queries.count())));
        });
    });
    return owned(std::move(out), {extent(cases.count), extent(cases.n)});
}

/// The same: signs (m, n), all zero if the simplex is degenerate.
py::array signs_of_weights(const Given<double>& vertices, const Given<double>& points) {
    const Cases cases(vertices, points);
    std::vector<std::int8_t> out(cases.count * cases.n);
    std::vector<WeightSigns> part(Cases::largest);
    in_blocks(Progress(py::none()), "cases", cases.count, [&](std::size_t first, std::size_t size) {
        cases.visit(first, size, [&](const MeshQueries& queries, std::size_t begin) {
            check(weight_signs(queries, std::span(part).first(queries.count())));
            for (std::size_t j = 0; j < queries.count(); ++j) {
                for (std::size_t i = 0; i < cases.n; ++i)
                    out[cases.n * (begin + j) + i] = static_cast<std::int8_t>(part[j].sign(static_cast<int>(i)));
            }
        });
    });
    return owned(std::move(out), {extent(cases.count), extent(cases.n)});
}

}  // namespace

void bind_simplex(py::module_& module) {
    bind<2, 3>(module, "orient2d", checked_orient2d);
    bind<3, 4>(module, "orient3d", checked_orient3d);
    bind<3, 6>(module, "det3d", checked_det3d);
    bind<2, 4>(module, "incircle", checked_incircle);
    bind<3, 5>(module, "insphere", checked_insphere);
    module.def("barycentric_weights", &weights);
    module.def("weight_signs", &signs_of_weights);
}

}  // namespace barycert::python

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"
#include "bindings.hpp"
#include "blocks.hpp"
#include "errors.hpp"

namespace barycert::python {
namespace {

namespace py = pybind11;

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
    Cases(const Array<double>& vertices, const Array<double>& points)
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
py::array weights(const Array<double>& vertices, const Array<double>& points, const py::object& callable) {
    const Cases cases(vertices, points);
    std::vector<double> out(cases.count * cases.n);
    in_blocks(Progress(callable), "cases", cases.count, [&](std::size_t first, std::size_t size) {
        cases.visit(first, size, [&](const MeshQueries& queries, std::size_t begin) {
            check(barycentric_weights(queries, std::span(out).subspan(cases.n * begin, cases.n * queries.count())));
        });
    });
    return owned(std::move(out), {extent(cases.count), extent(cases.n)});
}

/// The same: signs (m, n), all zero if the simplex is degenerate.
py::array signs(const Array<double>& vertices, const Array<double>& points, const py::object& callable) {
    const Cases cases(vertices, points);
    std::vector<std::int8_t> out(cases.count * cases.n);
    std::vector<WeightSigns> part(Cases::largest);
    in_blocks(Progress(callable), "cases", cases.count, [&](std::size_t first, std::size_t size) {
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

void bind_weights(py::module_& module) {
    module.def("barycentric_weights", &weights, py::arg("vertices").noconvert(), py::arg("points").noconvert(),
               py::arg("progress") = py::none());
    module.def("weight_signs", &signs, py::arg("vertices").noconvert(), py::arg("points").noconvert(),
               py::arg("progress") = py::none());
}

}  // namespace barycert::python

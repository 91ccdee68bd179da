#include "bindings.hpp"

namespace barycert::python {
namespace {

/// Signs (n) of predicate(point of each argument), whose arguments are arrays (n, d) with the coordinates of a point
/// side by side.
template <std::size_t arguments, class Predicate>
void bind(py::module_& module, const char* name, Predicate predicate) {
    module.def(name, [predicate](const std::array<py::array_t<double>, arguments>& points) {
        std::array<const char*, arguments> from{};
        std::array<py::ssize_t, arguments> stride{};
        for (std::size_t i = 0; i < arguments; ++i) {
            from[i] = reinterpret_cast<const char*>(points[i].data());
            stride[i] = points[i].strides(0);
        }
        std::vector<std::int8_t> out(static_cast<std::size_t>(points[0].shape(0)));
        in_blocks(Progress(), "cases", out.size(), [&](std::size_t first, std::size_t n) {
            for (std::size_t row = first; row < first + n; ++row) {
                std::array<const double*, arguments> at{};
                for (std::size_t i = 0; i < arguments; ++i)
                    at[i] = reinterpret_cast<const double*>(from[i] + static_cast<py::ssize_t>(row) * stride[i]);
                const Result<Sign> sign = std::apply(predicate, at);
                if (!sign) {
                    Error error = sign.error();
                    error.what = "case " + std::to_string(row) + ": " + error.what;
                    throw Exception(std::move(error));
                }
                out[row] = static_cast<std::int8_t>(*sign);
            }
        });
        return owned(std::move(out));
    });
}

/// The simplex of vertices (m, n, d).
Simplex simplex_of(const Given<double>& vertices) {
    for (const Simplex s : all_simplices) {
        if (vertex_count(s) == vertices.shape(1) && space_dimension(s) == vertices.shape(2)) return s;
    }
    throw Exception(
        {.code = "argument.size",
         .what = "shape of the vertices",
         .expected = "(..., 2, 3) segments, (..., 3, 2) or (..., 3, 3) triangles, (..., 4, 3) tetrahedra",
         .found = "(..., " + std::to_string(vertices.shape(1)) + ", " + std::to_string(vertices.shape(2)) + ")"});
}

/// visit(queries, number of the first case) for parts of the cases vertices (m, n, d), points (m, d), as the library
/// takes them: a simplex a case, whose vertices are nodes of its own.
template <class Visit>
void for_cases(Simplex simplex, const Given<double>& vertices, const Given<double>& points, const Visit& visit) {
    const auto n = static_cast<std::size_t>(vertex_count(simplex)), d = points.columns();
    std::vector<std::int32_t> numbers;
    in_blocks(Progress(), "cases", points.rows(), [&](std::size_t first, std::size_t size) {
        for (std::size_t i = numbers.size(); i < n * size; ++i) numbers.push_back(static_cast<std::int32_t>(i));
        const std::span<const std::int32_t> all = numbers;
        return visit(MeshQueries{simplex, vertices.all().subspan(n * d * first, n * d * size), all.first(n * size),
                                 all.first(size), points.part(first, size)},
                     first);
    });
}

/// Weights (m, n).
py::array weights(const Given<double>& vertices, const Given<double>& points) {
    const std::size_t n = vertices.columns();
    std::vector<double> out(points.rows() * n);
    for_cases(simplex_of(vertices), vertices, points, [&](const MeshQueries& queries, std::size_t first) {
        return barycentric_weights(queries, std::span(out).subspan(n * first, n * queries.count()));
    });
    return owned(std::move(out), n);
}

/// Signs (m, n), all zero if the simplex is degenerate.
py::array signs_of_weights(const Given<double>& vertices, const Given<double>& points) {
    const std::size_t n = vertices.columns();
    std::vector<std::int8_t> out(points.rows() * n);
    std::vector<WeightSigns> part;
    for_cases(simplex_of(vertices), vertices, points, [&](const MeshQueries& queries, std::size_t first) {
        part.resize(queries.count());
        const Status done = weight_signs(queries, part);
        for (std::size_t j = 0; done && j < part.size(); ++j) {
            for (std::size_t i = 0; i < n; ++i)
                out[n * (first + j) + i] = static_cast<std::int8_t>(part[j].sign(static_cast<int>(i)));
        }
        return done;
    });
    return owned(std::move(out), n);
}

}  // namespace

void bind_simplex(py::module_& module) {
    bind<3>(module, "orient2d", checked_orient2d);
    bind<4>(module, "orient3d", checked_orient3d);
    bind<6>(module, "det3d", checked_det3d);
    bind<4>(module, "incircle", checked_incircle);
    bind<5>(module, "insphere", checked_insphere);
    module.def("barycentric_weights", &weights);
    module.def("weight_signs", &signs_of_weights);
}

}  // namespace barycert::python

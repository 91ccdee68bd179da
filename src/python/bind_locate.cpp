#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "barycert/sampler.hpp"
#include "barycert/weights.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "mesh_object.hpp"
#include "options.hpp"

namespace barycert::python {
namespace {

namespace py = pybind11;

std::size_t dimension_of(const MeshObject& object) {
    return static_cast<std::size_t>(object.mesh().dimension);
}

const Locator& locator_of(const MeshObject& object, const Progress& progress) {
    const py::gil_scoped_release unlocked;
    return object.geometry()->locator(progress);
}

/// points (n, dimension): cells (n), features (n).
py::tuple locate(const MeshObject& object, const Array<double>& points, int threads, const py::object& callable,
                 const std::string& nonfinite) {
    const Progress progress(callable);
    const NonfinitePoints policy = nonfinite_points(nonfinite);
    const Locator& locator = locator_of(object, progress);
    const std::size_t d = dimension_of(object), count = static_cast<std::size_t>(points.size()) / d;
    std::vector<Mesh::Index> cells(count);
    std::vector<Feature> features(count);
    const std::span<const double> all = span_of(points);
    in_blocks(
        progress, "points", count,
        [&](std::size_t first, std::size_t n) {
            check(locator.locate(all.subspan(d * first, d * n), std::span(cells).subspan(first, n),
                                 std::span(features).subspan(first, n), nullptr, threads, policy));
        },
        locator.certified() ? largest_first_block : smallest_first_block);
    Array<std::uint8_t> feature(extent(count));
    std::uint8_t* const to = feature.mutable_data();
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::uint8_t>(features[i]);
    return py::make_tuple(owned(std::move(cells)), std::move(feature));
}

/// begin (n + 1), cells and features (rows): every cell that holds each point.
py::tuple locate_all(const MeshObject& object, const Array<double>& points, int threads, const py::object& callable,
                     const std::string& nonfinite) {
    const Progress progress(callable);
    const NonfinitePoints policy = nonfinite_points(nonfinite);
    const Locator& locator = locator_of(object, progress);
    const std::size_t d = dimension_of(object), count = static_cast<std::size_t>(points.size()) / d;
    const std::span<const double> all = span_of(points);
    std::vector<std::int64_t> begin{0};
    std::vector<Mesh::Index> cells;
    begin.reserve(count + 1);
    in_blocks(progress, "points", count, [&](std::size_t first, std::size_t n) {
        const Table rows = take(locator.locate_all(all.subspan(d * first, d * n), threads, policy));
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t row = rows.point_begin[i]; row < rows.point_begin[i + 1]; ++row) {
                if (rows.cells[row] >= 0) cells.push_back(rows.cells[row]);
            }
            begin.push_back(static_cast<std::int64_t>(cells.size()));
        }
    });
    return py::make_tuple(owned(std::move(begin)), owned(std::move(cells)));
}

/// points (n, dimension), cells (n): weights (n, dimension + 1), NaN outside.
py::array weights_of(const MeshObject& object, const Array<double>& points, const Array<Mesh::Index>& cells,
                     const py::object& callable) {
    const Mesh& mesh = object.mesh();
    const std::size_t d = dimension_of(object), corners = mesh.corners(),
                      count = static_cast<std::size_t>(cells.size());
    const Simplex simplex = d == 2 ? Simplex::triangle : Simplex::tetrahedron;
    Array<double> out(Shape{extent(count), extent(corners)});
    double* const to = out.mutable_data();
    const double* const from = points.data();
    const Mesh::Index* const cell = cells.data();
    std::vector<double> inside_points, weights;
    std::vector<Mesh::Index> inside;
    in_blocks(Progress(callable), "weights", count, [&](std::size_t first, std::size_t n) {
        inside_points.clear();
        inside.clear();
        for (std::size_t i = first; i < first + n; ++i) {
            if (cell[i] < 0) continue;
            inside.push_back(cell[i]);
            inside_points.insert(inside_points.end(), from + d * i, from + d * (i + 1));
        }
        weights.resize(corners * inside.size());
        check(barycentric_weights(MeshQueries{simplex, mesh.points, mesh.cells, inside, inside_points}, weights));
        auto next = weights.cbegin();
        for (std::size_t i = first; i < first + n; ++i) {
            double* const row = to + corners * i;
            if (cell[i] < 0) {
                std::fill_n(row, corners, std::numeric_limits<double>::quiet_NaN());
            } else {
                std::copy_n(next, corners, row);
                next += static_cast<std::ptrdiff_t>(corners);
            }
        }
    });
    return out;
}

/// The rows of a sparse matrix (n, nodes): begin (n + 1), nodes, weights.
py::tuple matrix(const MeshObject& object, const Array<double>& points, const Array<Mesh::Index>& cells,
                 const std::string& outside, double limit, const py::object& callable) {
    const Progress progress(callable);
    const Locator& locator = locator_of(object, progress);
    const OutsidePolicy policy = outside_policy(outside, std::numeric_limits<double>::quiet_NaN(), limit);
    const std::size_t d = dimension_of(object), count = static_cast<std::size_t>(cells.size());
    const std::span<const double> all = span_of(points);
    const std::span<const Mesh::Index> owners = span_of(cells);
    std::vector<std::int64_t> begin{0};
    begin.reserve(count + 1);
    std::vector<Mesh::Index> nodes;
    std::vector<double> weights;
    in_blocks(progress, "weights", count, [&](std::size_t first, std::size_t n) {
        const NodeWeights part = take(node_weights(locator,
                                                   {.dimension = object.mesh().dimension,
                                                    .first_row = first,
                                                    .points = all.subspan(d * first, d * n),
                                                    .cells = owners.subspan(first, n)},
                                                   policy));
        for (std::size_t i = 1; i < part.begin.size(); ++i)
            begin.push_back(static_cast<std::int64_t>(nodes.size() + part.begin[i]));
        nodes.insert(nodes.end(), part.nodes.begin(), part.nodes.end());
        weights.insert(weights.end(), part.weights.begin(), part.weights.end());
    });
    return py::make_tuple(owned(std::move(begin)), owned(std::move(nodes)), owned(std::move(weights)));
}

/// points (n, dimension): cells (n), distances (n).
py::tuple nearest(const MeshObject& object, const Array<double>& points, double limit, const py::object& callable,
                  const std::string& nonfinite) {
    const Progress progress(callable);
    const bool any_point = nonfinite_points(nonfinite) == NonfinitePoints::nan;
    const Locator& locator = locator_of(object, progress);
    const std::size_t d = dimension_of(object), count = static_cast<std::size_t>(points.size()) / d;
    std::vector<Mesh::Index> cells(count);
    std::vector<double> distances(count);
    const double* const from = points.data();
    in_blocks(
        progress, "points", count,
        [&](std::size_t first, std::size_t n) {
            for (std::size_t i = first; i < first + n; ++i) {
                const bool finite =
                    std::all_of(from + d * i, from + d * (i + 1), [](double x) { return std::isfinite(x); });
                const Nearest found = any_point && !finite ? Nearest{} : take(locator.nearest(from + d * i, limit));
                cells[i] = found.cell;
                distances[i] = found.cell < 0 ? std::numeric_limits<double>::quiet_NaN() : found.distance;
            }
        },
        smallest_first_block);
    return py::make_tuple(owned(std::move(cells)), owned(std::move(distances)));
}

}  // namespace

void bind_locate(py::module_& module) {
    module.def("locate", &locate, py::arg("mesh"), py::arg("points").noconvert(), py::arg("threads"),
               py::arg("progress"), py::arg("nonfinite") = "error");
    module.def("locate_all", &locate_all, py::arg("mesh"), py::arg("points").noconvert(), py::arg("threads"),
               py::arg("progress"), py::arg("nonfinite"));
    module.def("weights_of", &weights_of, py::arg("mesh"), py::arg("points").noconvert(), py::arg("cells").noconvert(),
               py::arg("progress"));
    module.def("matrix", &matrix, py::arg("mesh"), py::arg("points").noconvert(), py::arg("cells").noconvert(),
               py::arg("outside"), py::arg("limit"), py::arg("progress"));
    module.def("nearest", &nearest, py::arg("mesh"), py::arg("points").noconvert(), py::arg("limit"),
               py::arg("progress"), py::arg("nonfinite"));
    module.def(
        "certified",
        [](const MeshObject& mesh, py::object progress) {
            return locator_of(mesh, Progress(std::move(progress))).certified();
        },
        py::arg("mesh"), py::arg("progress"));
}

}  // namespace barycert::python

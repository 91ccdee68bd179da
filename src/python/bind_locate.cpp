#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "barycert/sampler.hpp"
#include "barycert/weights.hpp"
#include "mesh_object.hpp"

namespace barycert::python {
namespace {

/// Points (n, dimension): cells (n), features (n).
py::tuple locate(const MeshObject& object, const Given<double>& points, int threads, const Progress& progress,
                 NonfinitePoints nonfinite) {
    const Locator& locator = object.locator(progress);
    std::vector<Mesh::Index> cells(points.rows());
    std::vector<Feature> features(points.rows());
    in_blocks(
        progress, "points", points.rows(),
        [&](std::size_t first, std::size_t n) {
            check(locator.locate(points.part(first, n), std::span(cells).subspan(first, n),
                                 std::span(features).subspan(first, n), nullptr, threads, nonfinite));
        },
        first_block(locator.certified()));
    return py::make_tuple(owned(std::move(cells)), owned(std::move(features)));
}

/// begin (n + 1), cells (rows): every cell that holds each point.
py::tuple locate_all(const MeshObject& object, const Given<double>& points, int threads, const Progress& progress,
                     NonfinitePoints nonfinite) {
    const Locator& locator = object.locator(progress);
    std::vector<std::int64_t> begin{0};
    std::vector<Mesh::Index> cells;
    begin.reserve(points.rows() + 1);
    in_blocks(progress, "points", points.rows(), [&](std::size_t first, std::size_t n) {
        const Table rows = take(locator.locate_all(points.part(first, n), threads, nonfinite));
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t row = rows.point_begin[i]; row < rows.point_begin[i + 1]; ++row) {
                if (rows.cells[row] >= 0) cells.push_back(rows.cells[row]);
            }
            begin.push_back(static_cast<std::int64_t>(cells.size()));
        }
    });
    return py::make_tuple(owned(std::move(begin)), owned(std::move(cells)));
}

/// points (n, dimension) in cells (n): weights (n, dimension + 1).
py::array weights_of(const MeshObject& object, const Given<double>& points, const Given<Mesh::Index>& cells) {
    const Mesh& mesh = object.mesh();
    const std::size_t corners = mesh.corners();
    std::vector<double> weights(corners * cells.rows());
    in_blocks(Progress(), "weights", cells.rows(), [&](std::size_t first, std::size_t n) {
        check(barycentric_weights(
            MeshQueries{object.simplex(), mesh.points, mesh.cells, cells.part(first, n), points.part(first, n)},
            std::span(weights).subspan(corners * first, corners * n)));
    });
    return owned(std::move(weights), corners);
}

/// The rows of a sparse matrix (n, nodes): begin (n + 1), nodes, weights.
py::tuple matrix(const MeshObject& object, const Given<double>& points, const Given<Mesh::Index>& cells,
                 Outside outside, double limit, const Progress& progress) {
    const Locator& locator = object.locator(progress);
    std::vector<std::int64_t> begin{0};
    begin.reserve(cells.rows() + 1);
    std::vector<Mesh::Index> nodes;
    std::vector<double> weights;
    in_blocks(progress, "weights", cells.rows(), [&](std::size_t first, std::size_t n) {
        const NodeWeights part = take(node_weights(locator,
                                                   {.dimension = object.mesh().dimension,
                                                    .first_row = first,
                                                    .points = points.part(first, n),
                                                    .cells = cells.part(first, n)},
                                                   {.kind = outside, .limit = limit}));
        for (std::size_t i = 1; i < part.begin.size(); ++i)
            begin.push_back(static_cast<std::int64_t>(nodes.size() + part.begin[i]));
        nodes.insert(nodes.end(), part.nodes.begin(), part.nodes.end());
        weights.insert(weights.end(), part.weights.begin(), part.weights.end());
    });
    return py::make_tuple(owned(std::move(begin)), owned(std::move(nodes)), owned(std::move(weights)));
}

/// Cells (n), distances (n).
py::tuple nearest(const MeshObject& object, const Given<double>& points, double limit, const Progress& progress,
                  NonfinitePoints nonfinite) {
    const Locator& locator = object.locator(progress);
    std::vector<Mesh::Index> cells(points.rows());
    std::vector<double> distances(points.rows());
    in_blocks(progress, "points", points.rows(), [&](std::size_t first, std::size_t n) {
        for (std::size_t i = first; i < first + n; ++i) {
            const std::span<const double> point = points.part(i, 1);
            const bool skipped = nonfinite == NonfinitePoints::nan &&
                                 !std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); });
            const Nearest found = skipped ? Nearest{} : take(locator.nearest(point.data(), limit));
            cells[i] = found.cell;
            distances[i] = found.cell < 0 ? std::numeric_limits<double>::quiet_NaN() : found.distance;
        }
    });
    return py::make_tuple(owned(std::move(cells)), owned(std::move(distances)));
}

}  // namespace

void bind_locate(py::module_& module) {
    module.def("locate", &locate);
    module.def("locate_all", &locate_all);
    module.def("weights_of", &weights_of);
    module.def("matrix", &matrix);
    module.def("nearest", &nearest);
    module.def("certified", [](const MeshObject& m) { return m.locator(Progress()).certified(); });
}

}  // namespace barycert::python

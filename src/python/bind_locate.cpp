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

/// Points (n, dimension) that are asked of a mesh.
struct Query {
    Query(const MeshObject& object, const Given<double>& points, const py::object& callable,
          const std::string& nonfinite = "error")
        : progress(callable),
          policy(nonfinite_points(nonfinite)),
          locator(locator_of(object)),
          d(object.dimension()),
          count(static_cast<std::size_t>(points.size()) / d),
          all(span_of(points)) {}

    const Locator& locator_of(const MeshObject& object) const {
        const py::gil_scoped_release unlocked;
        return object.geometry()->locator(progress);
    }
    std::span<const double> part(std::size_t first, std::size_t n) const { return all.subspan(d * first, d * n); }

    Progress progress;
    NonfinitePoints policy;
    const Locator& locator;
    std::size_t d, count;
    std::span<const double> all;
};

/// Cells (n), features (n).
py::tuple locate(const MeshObject& object, const Given<double>& points, int threads, const py::object& callable,
                 const std::string& nonfinite) {
    const Query query(object, points, callable, nonfinite);
    std::vector<Mesh::Index> cells(query.count);
    std::vector<Feature> features(query.count);
    in_blocks(
        query.progress, "points", query.count,
        [&](std::size_t first, std::size_t n) {
            check(query.locator.locate(query.part(first, n), std::span(cells).subspan(first, n),
                                       std::span(features).subspan(first, n), nullptr, threads, query.policy));
        },
        query.locator.certified() ? largest_first_block : smallest_first_block);
    std::vector<std::uint8_t> numbers(query.count);
    std::transform(features.begin(), features.end(), numbers.begin(), [](Feature f) { return std::uint8_t(f); });
    return py::make_tuple(owned(std::move(cells)), owned(std::move(numbers)));
}

/// begin (n + 1), cells and features (rows): every cell that holds each point.
py::tuple locate_all(const MeshObject& object, const Given<double>& points, int threads, const py::object& callable,
                     const std::string& nonfinite) {
    const Query query(object, points, callable, nonfinite);
    std::vector<std::int64_t> begin{0};
    std::vector<Mesh::Index> cells;
    begin.reserve(query.count + 1);
    in_blocks(query.progress, "points", query.count, [&](std::size_t first, std::size_t n) {
        const Table rows = take(query.locator.locate_all(query.part(first, n), threads, query.policy));
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
py::array weights_of(const MeshObject& object, const Given<double>& points, const Given<Mesh::Index>& cells,
                     const py::object& callable) {
    const Mesh& mesh = object.mesh();
    const std::size_t d = object.dimension(), corners = mesh.corners(), count = static_cast<std::size_t>(cells.size());
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
py::tuple matrix(const MeshObject& object, const Given<double>& points, const Given<Mesh::Index>& cells,
                 const std::string& outside, double limit, const py::object& callable) {
    const Query query(object, points, callable);
    const OutsidePolicy policy = outside_policy(outside, std::numeric_limits<double>::quiet_NaN(), limit);
    const std::span<const Mesh::Index> owners = span_of(cells);
    std::vector<std::int64_t> begin{0};
    begin.reserve(owners.size() + 1);
    std::vector<Mesh::Index> nodes;
    std::vector<double> weights;
    in_blocks(query.progress, "weights", owners.size(), [&](std::size_t first, std::size_t n) {
        const NodeWeights part = take(node_weights(query.locator,
                                                   {.dimension = object.mesh().dimension,
                                                    .first_row = first,
                                                    .points = query.part(first, n),
                                                    .cells = owners.subspan(first, n)},
                                                   policy));
        for (std::size_t i = 1; i < part.begin.size(); ++i)
            begin.push_back(static_cast<std::int64_t>(nodes.size() + part.begin[i]));
        nodes.insert(nodes.end(), part.nodes.begin(), part.nodes.end());
        weights.insert(weights.end(), part.weights.begin(), part.weights.end());
    });
    return py::make_tuple(owned(std::move(begin)), owned(std::move(nodes)), owned(std::move(weights)));
}

/// Cells (n), distances (n).
py::tuple nearest(const MeshObject& object, const Given<double>& points, double limit, const py::object& callable,
                  const std::string& nonfinite) {
    const Query query(object, points, callable, nonfinite);
    std::vector<Mesh::Index> cells(query.count);
    std::vector<double> distances(query.count);
    in_blocks(query.progress, "points", query.count, [&](std::size_t first, std::size_t n) {
        for (std::size_t i = first; i < first + n; ++i) {
            const std::span<const double> point = query.part(i, 1);
            const bool skipped = query.policy == NonfinitePoints::nan &&
                                 !std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); });
            const Nearest found = skipped ? Nearest{} : take(query.locator.nearest(point.data(), limit));
            cells[i] = found.cell;
            distances[i] = found.cell < 0 ? std::numeric_limits<double>::quiet_NaN() : found.distance;
        }
    });
    return py::make_tuple(owned(std::move(cells)), owned(std::move(distances)));
}

bool certified(const MeshObject& object, const py::object& callable) {
    const Progress progress(callable);
    const py::gil_scoped_release unlocked;
    return object.geometry()->locator(progress).certified();
}

}  // namespace

void bind_locate(py::module_& module) {
    module.def("locate", &locate);
    module.def("locate_all", &locate_all);
    module.def("weights_of", &weights_of);
    module.def("matrix", &matrix);
    module.def("nearest", &nearest);
    module.def("certified", &certified);
}

}  // namespace barycert::python

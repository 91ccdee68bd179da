#include <cmath>
#include <exception>

#include "barycert/grid.hpp"
#include "bindings.hpp"

namespace barycert::python {
namespace {

/// Points (n, dimension): cells (n), features (n).
py::tuple locate(const MeshObject& object, const Given<double>& points, int threads, const Progress& progress,
                 NonfinitePoints nonfinite) {
    const Locator& locator = object.locator(progress);
    std::vector<Mesh::Index> cells(points.rows());
    std::vector<Feature> features(points.rows());
    const auto block = [&](std::size_t first, std::size_t n) {
        return locator.locate(points.part(first, n), std::span(cells).subspan(first, n),
                              std::span(features).subspan(first, n), nullptr, threads, nonfinite);
    };
    in_blocks(progress, "points", points.rows(), block, first_block(locator, points.rows()));
    return py::make_tuple(owned(std::move(cells)), owned(std::move(features)));
}

/// begin (n + 1), cells (rows): every cell that holds each point.
py::tuple locate_all(const MeshObject& object, const Given<double>& points, int threads, const Progress& progress,
                     NonfinitePoints nonfinite) {
    const Locator& locator = object.locator(progress);
    std::vector<std::int64_t> begin{0};
    std::vector<Mesh::Index> cells;
    begin.reserve(points.rows() + 1);
    in_blocks(progress, "points", points.rows(), [&](std::size_t first, std::size_t n) -> Status {
        const Result<Table> rows = locator.locate_all(points.part(first, n), threads, nonfinite);
        if (!rows) return rows.error();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t row = rows->point_begin[i]; row < rows->point_begin[i + 1]; ++row) {
                if (rows->cells[row] >= 0) cells.push_back(rows->cells[row]);
            }
            begin.push_back(static_cast<std::int64_t>(cells.size()));
        }
        return Done{};
    });
    return py::make_tuple(owned(std::move(begin)), owned(std::move(cells)));
}

/// points (n, dimension) in cells (n): weights (n, dimension + 1).
py::array weights_of(const MeshObject& object, const Given<double>& points, const Given<Mesh::Index>& cells) {
    const Mesh& mesh = object.mesh();
    const std::size_t corners = mesh.corners();
    std::vector<double> weights(corners * cells.rows());
    in_blocks(Progress(), "weights", cells.rows(), [&](std::size_t first, std::size_t n) {
        return barycentric_weights(
            MeshQueries{object.simplex(), mesh.points, mesh.cells, cells.part(first, n), points.part(first, n)},
            std::span(weights).subspan(corners * first, corners * n));
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
        const NodeWeights part = node_weights(locator,
                                              {.dimension = object.mesh().dimension,
                                               .first_row = first,
                                               .points = points.part(first, n),
                                               .cells = cells.part(first, n)},
                                              {.kind = outside, .limit = limit})
                                     .value();
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
                                 !std::ranges::all_of(point, [](double x) { return std::isfinite(x); });
            const Nearest found = skipped ? Nearest{} : locator.nearest(point.data(), limit).value();
            cells[i] = found.cell;
            distances[i] = found.cell < 0 ? std::numeric_limits<double>::quiet_NaN() : found.distance;
        }
    });
    return py::make_tuple(owned(std::move(cells)), owned(std::move(distances)));
}

/// No word for what points outside get: the number to fill in, which is NaN unless it is given.
SampleOptions sample_options(std::optional<Outside> outside, double fill, double limit, Rounding rounding, int threads,
                             NonfinitePoints nonfinite) {
    const Outside kind = outside.value_or(std::isnan(fill) ? Outside::nan : Outside::fill);
    return {.rounding = rounding,
            .outside = {.kind = kind, .fill = fill, .limit = limit},
            .threads = threads,
            .nonfinite_points = nonfinite};
}

/// Values (n, columns) at points (n, dimension), whose owners may be known.
py::array sample(const BoundSampler& bound, const Given<double>& points, const SampleOptions& options,
                 const Progress& progress, const std::optional<Given<Mesh::Index>>& cells,
                 const std::optional<Given<std::uint8_t>>& features) {
    const std::size_t count = points.rows(), columns = bound.sampler.columns().size();
    const bool near = options.outside.kind == Outside::nearest || options.outside.kind == Outside::extrapolate;
    const std::size_t first_size = near ? few : first_block(bound.sampler.locator(), count);
    const bool one_block = count <= first_size;  // whose values are not copied
    Table rows;
    Array<double> out(Shape{one_block ? 0 : count, columns});
    double* const values = out.mutable_data();
    const auto block = [&](std::size_t first, std::size_t n) {
        if (cells) {
            const std::span<const Mesh::Index> owners = cells->part(first, n);
            rows.cells.assign(owners.begin(), owners.end());
            rows.features.clear();
            for (const std::uint8_t f : features->part(first, n)) rows.features.push_back(static_cast<Feature>(f));
            bound.sampler.evaluate(points.part(first, n), options, rows, first).value();
        } else {
            bound.sampler.sample(points.part(first, n), options, rows, first).value();
        }
        if (!one_block) std::copy_n(rows.values.data(), n * columns, values + first * columns);
    };
    in_blocks(progress, "points", count, block, first_size);
    if (one_block) return owned(std::move(rows.values), columns);
    return out;
}

/// Makes a grid with that many axes; entries of others do not matter.
Grid grid_of(int axes, const std::array<std::int64_t, 3>& counts, const std::array<double, 3>& low,
             const std::array<double, 3>& high) {
    return grid_over(axes, counts, low, high).value();
}

py::array coordinates(const Grid& grid, std::size_t k) {
    std::vector<double> axis(static_cast<std::size_t>(grid.counts.at(k)));
    for (std::size_t i = 0; i < axis.size(); ++i) axis[i] = grid.coordinate(k, static_cast<std::int64_t>(i));
    return owned(std::move(axis));
}

/// Values (points of the grid, columns), x fastest.
py::array on_grid(const BoundSampler& bound, const Grid& grid, const SampleOptions& options, const Progress& progress) {
    const std::size_t columns = bound.sampler.columns().size(), total = grid.point_count();
    Array<double> out(Shape{total, columns});
    double* const values = out.mutable_data();
    std::exception_ptr raised;
    const auto sink = [&](const TableView& rows) -> Status {
        const auto first = static_cast<std::size_t>(rows.first_row);
        std::copy_n(rows.values.data(), rows.values.size(), values + first * columns);
        try {
            tell(progress, "points", first + rows.row_count(), total);
        } catch (...) {
            raised = std::current_exception();
            return Error{.code = "run.interrupted", .what = "interrupted"};
        }
        return Done{};
    };
    const Result<SampleCounts> done = unlocked([&] { return resample(bound.sampler, grid, options, sink); });
    if (raised) std::rethrow_exception(raised);
    if (!done) throw Exception(done.error());
    return out;
}

/// (name, components) of each field, in the order of the columns.
py::list fields_of(const BoundSampler& bound) {
    return list_of(bound.sampler.fields(), [](const TableField& f) { return std::pair(f.name, f.components); });
}

}  // namespace

void bind_points(py::module_& module) {
    module.def("locate", &locate);
    module.def("locate_all", &locate_all);
    module.def("weights_of", &weights_of);
    module.def("matrix", &matrix);
    module.def("nearest", &nearest);
    module.def("certified", [](const MeshObject& m) { return m.locator(Progress()).certified(); });
    py::class_<SampleOptions>(module, "SampleOptions").def(py::init(&sample_options));
    py::class_<Grid>(module, "Grid").def(py::init(&grid_of)).def("coordinates", &coordinates);
    py::class_<BoundSampler, std::shared_ptr<BoundSampler>>(module, "Sampler")
        .def_property_readonly("fields", &fields_of)
        .def("sample", &sample, py::arg("points"), py::arg("options"), py::arg("progress"),
             py::arg("cells") = py::none(), py::arg("features") = py::none())
        .def("on_grid", &on_grid);
    module.def("bounds", [](const MeshObject& mesh) {
        const Bounds3 box = bounds_of_cells(mesh.mesh());
        return std::pair(box.low, box.high);
    });
}

}  // namespace barycert::python

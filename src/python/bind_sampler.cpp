#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "barycert/grid.hpp"
#include "barycert/sampler.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "mesh_object.hpp"
#include "options.hpp"

namespace barycert::python {
namespace {

namespace py = pybind11;

/// How many points to begin with: where each costs next to nothing, so many that sorting them pays.
std::size_t first_block(const BoundSampler& bound, const SampleOptions& options) {
    const bool near = options.outside.kind == Outside::nearest || options.outside.kind == Outside::extrapolate;
    return near || !bound.sampler.locator().certified() ? smallest_first_block : largest_first_block;
}

std::size_t rows_of(const BoundSampler& bound, const Array<double>& points) {
    return static_cast<std::size_t>(points.size()) / static_cast<std::size_t>(bound.geometry->mesh.dimension);
}

/// points (n, dimension): values (n, columns).
py::array sample(const BoundSampler& bound, const Array<double>& points, const SampleOptions& options,
                 const py::object& callable) {
    const std::size_t d = static_cast<std::size_t>(bound.geometry->mesh.dimension), count = rows_of(bound, points),
                      columns = bound.sampler.columns().size();
    const std::span<const double> all = span_of(points);
    const std::size_t first_size = first_block(bound, options);
    Table rows;
    if (count <= first_size) {
        in_blocks(
            Progress(callable), "points", count,
            [&](std::size_t, std::size_t) { check(bound.sampler.sample(all, options, rows)); }, first_size);
        return owned(std::move(rows.values), {extent(count), extent(columns)});
    }
    Array<double> out(Shape{extent(count), extent(columns)});
    double* const values = out.mutable_data();
    in_blocks(
        Progress(callable), "points", count,
        [&](std::size_t first, std::size_t n) {
            check(bound.sampler.sample(all.subspan(d * first, d * n), options, rows, first));
            std::copy_n(rows.values.data(), n * columns, values + first * columns);
        },
        first_size);
    return out;
}

/// The same for points whose owners are known.
py::array evaluate(const BoundSampler& bound, const Array<double>& points, const Array<Mesh::Index>& cells,
                   const Array<std::uint8_t>& features, const SampleOptions& options, const py::object& callable) {
    const std::size_t d = static_cast<std::size_t>(bound.geometry->mesh.dimension), count = rows_of(bound, points),
                      columns = bound.sampler.columns().size();
    const std::span<const double> all = span_of(points);
    const Mesh::Index* const cell = cells.data();
    const std::uint8_t* const feature = features.data();
    Array<double> out(Shape{extent(count), extent(columns)});
    double* const values = out.mutable_data();
    Table rows;
    in_blocks(
        Progress(callable), "points", count,
        [&](std::size_t first, std::size_t n) {
            rows.cells.assign(cell + first, cell + first + n);
            rows.features.resize(n);
            std::transform(feature + first, feature + first + n, rows.features.begin(),
                           [](std::uint8_t f) { return static_cast<Feature>(f); });
            check(bound.sampler.evaluate(all.subspan(d * first, d * n), options, rows, first));
            std::copy_n(rows.values.data(), n * columns, values + first * columns);
        },
        first_block(bound, options));
    return out;
}

Grid grid_of(const std::vector<std::int64_t>& counts, const std::vector<double>& low, const std::vector<double>& high) {
    const std::size_t d = counts.size();
    if (d > 3 || low.size() != d || high.size() != d)
        throw Exception(
            {.what = "shape and bounds of the grid", .expected = "as many numbers of each as there are axes"});
    std::array<std::int64_t, 3> all_counts{1, 1, 1};
    std::array<double, 3> all_low{}, all_high{};
    std::copy_n(counts.begin(), d, all_counts.begin());
    std::copy_n(low.begin(), d, all_low.begin());
    std::copy_n(high.begin(), d, all_high.begin());
    return take(grid_over(static_cast<int>(d), all_counts, all_low, all_high));
}

/// The coordinates along each axis.
py::list grid_axes(const std::vector<std::int64_t>& counts, const std::vector<double>& low,
                   const std::vector<double>& high) {
    const Grid grid = grid_of(counts, low, high);
    py::list axes;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        std::vector<double> axis(static_cast<std::size_t>(grid.counts[k]));
        for (std::size_t i = 0; i < axis.size(); ++i) axis[i] = grid.coordinate(k, static_cast<std::int64_t>(i));
        axes.append(owned(std::move(axis)));
    }
    return axes;
}

/// Values (z, y, x, columns), in the plane (y, x, columns).
py::array on_grid(const BoundSampler& bound, const std::vector<std::int64_t>& counts, const std::vector<double>& low,
                  const std::vector<double>& high, const SampleOptions& options, const py::object& callable) {
    const Grid grid = grid_of(counts, low, high);
    const std::size_t columns = bound.sampler.columns().size();
    Shape shape(counts.rbegin(), counts.rend());
    shape.push_back(extent(columns));
    Array<double> out(shape);
    double* const values = out.mutable_data();
    const Progress progress(callable);
    const std::size_t total = grid.point_count();
    std::exception_ptr raised;
    const auto sink = [&](const TableView& rows) -> Status {
        const auto first = static_cast<std::size_t>(rows.first_row);
        std::copy_n(rows.values.data(), rows.values.size(), values + first * columns);
        try {
            progress.tell("points", first + rows.row_count(), total);
        } catch (...) {
            raised = std::current_exception();
            return Error{.what = "interrupted"};
        }
        return Done{};
    };
    {
        const py::gil_scoped_release unlocked;
        const Result<SampleCounts> done = resample(bound.sampler, grid, options, sink);
        if (raised) std::rethrow_exception(raised);
        if (!done) throw Exception(done.error());
    }
    return out;
}

/// (name, components) of each field, in the order of the columns.
std::vector<std::pair<std::string, int>> fields_of(const BoundSampler& bound) {
    std::vector<std::pair<std::string, int>> fields;
    for (const TableField& field : bound.sampler.fields()) fields.emplace_back(field.name, field.components);
    return fields;
}

}  // namespace

void bind_sampler(py::module_& module) {
    py::class_<SampleOptions>(module, "SampleOptions")
        .def(py::init(&sample_options), py::arg("outside"), py::arg("fill"), py::arg("limit"), py::arg("rounding"),
             py::arg("threads"), py::arg("nonfinite") = "error");
    py::class_<BoundSampler, std::shared_ptr<BoundSampler>>(module, "Sampler")
        .def_property_readonly("fields", &fields_of)
        .def("sample", &sample, py::arg("points").noconvert(), py::arg("options"), py::arg("progress"))
        .def("evaluate", &evaluate, py::arg("points").noconvert(), py::arg("cells").noconvert(),
             py::arg("features").noconvert(), py::arg("options"), py::arg("progress"))
        .def("on_grid", &on_grid, py::arg("counts"), py::arg("low"), py::arg("high"), py::arg("options"),
             py::arg("progress"));
    module.def("grid_axes", &grid_axes, py::arg("counts"), py::arg("low"), py::arg("high"));
    module.def(
        "bounds",
        [](const MeshObject& mesh) {
            const Bounds3 box = bounds_of_cells(mesh.mesh());
            const auto d = static_cast<std::ptrdiff_t>(mesh.mesh().dimension);
            return std::pair(std::vector<double>(box.low.begin(), box.low.begin() + d),
                             std::vector<double>(box.high.begin(), box.high.begin() + d));
        },
        py::arg("mesh"));
}

}  // namespace barycert::python

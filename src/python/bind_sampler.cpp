#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "barycert/grid.hpp"
#include "barycert/sampler.hpp"
#include "mesh_object.hpp"

namespace barycert::python {
namespace {

/// `rounding`: correct or plain.
SampleOptions sample_options(const std::string& outside, double fill, double limit, const std::string& rounding,
                             int threads, const std::string& nonfinite) {
    if (rounding != "correct" && rounding != "plain")
        throw Exception({.what = "rounding of values (rounding=)", .expected = "correct or plain", .found = rounding});
    return {.rounding = rounding == "plain" ? Rounding::plain : Rounding::correct,
            .outside = outside_policy(outside, fill, limit),
            .threads = threads,
            .nonfinite_points = nonfinite_points(nonfinite)};
}

/// Values (n, columns) at points (n, dimension): ask(points, number of the first, rows) sets those of some points.
template <class Ask>
py::array values_at(const BoundSampler& bound, const Given<double>& points, const SampleOptions& options,
                    const py::object& callable, const Ask& ask) {
    const std::size_t d = static_cast<std::size_t>(bound.geometry->mesh.dimension),
                      count = static_cast<std::size_t>(points.size()) / d, columns = bound.sampler.columns().size();
    const std::span<const double> all = span_of(points);
    // Where points cost next to nothing, so many to begin with that sorting them pays.
    const bool near = options.outside.kind == Outside::nearest || options.outside.kind == Outside::extrapolate;
    const std::size_t first_size =
        near || !bound.sampler.locator().certified() ? smallest_first_block : largest_first_block;
    const bool one_block = count <= first_size;  // whose values are not copied
    Table rows;
    Array<double> out(Shape{one_block ? 0 : extent(count), extent(columns)});
    double* const values = out.mutable_data();
    in_blocks(
        Progress(callable), "points", count,
        [&](std::size_t first, std::size_t n) {
            check(ask(all.subspan(d * first, d * n), first, rows));
            if (!one_block) std::copy_n(rows.values.data(), n * columns, values + first * columns);
        },
        first_size);
    if (one_block) return owned(std::move(rows.values), {extent(count), extent(columns)});
    return out;
}

py::array sample(const BoundSampler& bound, const Given<double>& points, const SampleOptions& options,
                 const py::object& callable) {
    return values_at(bound, points, options, callable,
                     [&](std::span<const double> some, std::size_t first, Table& rows) {
                         return bound.sampler.sample(some, options, rows, first);
                     });
}

/// The same for points whose owners are known.
py::array evaluate(const BoundSampler& bound, const Given<double>& points, const Given<Mesh::Index>& cells,
                   const Given<std::uint8_t>& features, const SampleOptions& options, const py::object& callable) {
    const auto d = static_cast<std::size_t>(bound.geometry->mesh.dimension);
    return values_at(bound, points, options, callable,
                     [&](std::span<const double> some, std::size_t first, Table& rows) {
                         const std::span<const Mesh::Index> owners = span_of(cells).subspan(first, some.size() / d);
                         rows.cells.assign(owners.begin(), owners.end());
                         rows.features.clear();
                         for (std::size_t i = 0; i < owners.size(); ++i)
                             rows.features.push_back(static_cast<Feature>(features.data()[first + i]));
                         return bound.sampler.evaluate(some, options, rows, first);
                     });
}

/// Of that many axes; entries of others do not matter.
Grid grid_of(int axes, const std::array<std::int64_t, 3>& counts, const std::array<double, 3>& low,
             const std::array<double, 3>& high) {
    return take(grid_over(axes, counts, low, high));
}

/// The coordinates along an axis.
py::array coordinates(const Grid& grid, std::size_t k) {
    std::vector<double> axis(static_cast<std::size_t>(grid.counts.at(k)));
    for (std::size_t i = 0; i < axis.size(); ++i) axis[i] = grid.coordinate(k, static_cast<std::int64_t>(i));
    return owned(std::move(axis));
}

/// Values (points of the grid, columns), x fastest.
py::array on_grid(const BoundSampler& bound, const Grid& grid, const SampleOptions& options,
                  const py::object& callable) {
    const std::size_t columns = bound.sampler.columns().size(), total = grid.point_count();
    Array<double> out(Shape{extent(total), extent(columns)});
    double* const values = out.mutable_data();
    const Progress progress(callable);
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
    py::class_<SampleOptions>(module, "SampleOptions").def(py::init(&sample_options));
    py::class_<Grid>(module, "Grid").def(py::init(&grid_of)).def("coordinates", &coordinates);
    py::class_<BoundSampler, std::shared_ptr<BoundSampler>>(module, "Sampler")
        .def_property_readonly("fields", &fields_of)
        .def("sample", &sample)
        .def("evaluate", &evaluate)
        .def("on_grid", &on_grid);
    module.def("bounds", [](const MeshObject& mesh) {
        const Bounds3 box = bounds_of_cells(mesh.mesh());
        return std::pair(box.low, box.high);
    });
}

}  // namespace barycert::python

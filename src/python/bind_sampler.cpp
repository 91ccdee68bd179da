#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "barycert/grid.hpp"
#include "barycert/sampler.hpp"
#include "mesh_object.hpp"

namespace barycert::python {
namespace {

SampleOptions sample_options(Outside outside, double fill, double limit, Rounding rounding, int threads,
                             NonfinitePoints nonfinite) {
    return {.rounding = rounding,
            .outside = {.kind = outside, .fill = fill, .limit = limit},
            .threads = threads,
            .nonfinite_points = nonfinite};
}

/// Values (n, columns) at points (n, dimension), whose owners may be known.
py::array sample(const BoundSampler& bound, const Given<double>& points, const SampleOptions& options,
                 const Progress& progress, const std::optional<Given<Mesh::Index>>& cells,
                 const std::optional<Given<std::uint8_t>>& features) {
    const std::size_t count = points.rows(), columns = bound.sampler.columns().size();
    const bool near = options.outside.kind == Outside::nearest || options.outside.kind == Outside::extrapolate;
    const std::size_t first_size = first_block(!near && bound.sampler.locator().certified());
    const bool one_block = count <= first_size;  // whose values are not copied
    Table rows;
    Array<double> out(Shape{one_block ? 0 : extent(count), extent(columns)});
    double* const values = out.mutable_data();
    const auto block = [&](std::size_t first, std::size_t n) {
        if (cells) {
            const std::span<const Mesh::Index> owners = cells->part(first, n);
            rows.cells.assign(owners.begin(), owners.end());
            rows.features.clear();
            for (const std::uint8_t f : features->part(first, n)) rows.features.push_back(static_cast<Feature>(f));
            check(bound.sampler.evaluate(points.part(first, n), options, rows, first));
        } else {
            check(bound.sampler.sample(points.part(first, n), options, rows, first));
        }
        if (!one_block) std::copy_n(rows.values.data(), n * columns, values + first * columns);
    };
    in_blocks(progress, "points", count, block, first_size);
    if (one_block) return owned(std::move(rows.values), columns);
    return out;
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
py::array on_grid(const BoundSampler& bound, const Grid& grid, const SampleOptions& options, const Progress& progress) {
    const std::size_t columns = bound.sampler.columns().size(), total = grid.point_count();
    Array<double> out(Shape{extent(total), extent(columns)});
    double* const values = out.mutable_data();
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
        .def("sample", &sample, py::arg("points"), py::arg("options"), py::arg("progress"),
             py::arg("cells") = py::none(), py::arg("features") = py::none())
        .def("on_grid", &on_grid);
    module.def("bounds", [](const MeshObject& mesh) {
        const Bounds3 box = bounds_of_cells(mesh.mesh());
        return std::pair(box.low, box.high);
    });
}

}  // namespace barycert::python

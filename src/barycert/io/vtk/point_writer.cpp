#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSignedCharArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>

#include "barycert/environment.hpp"
#include "barycert/io/vtk/mesh_to_grid.hpp"
#include "barycert/io/vtk/point_rows.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/vtu_output.hpp"

namespace barycert::io {
namespace {

constexpr const char *cell_name = "cell", *feature_name = "feature", *mask_name = "vtkValidPointMask",
                     *distance_name = "distance";

std::string fault_of(const PointRows& rows) {
    if (rows.dimension != 2 && rows.dimension != 3) return "the dimension is neither 2 nor 3";
    const auto dimension = static_cast<std::size_t>(rows.dimension);
    if (rows.points.size() % dimension != 0) return "the coordinates do not make whole points";
    const std::size_t count = rows.points.size() / dimension;
    if (count > io::max_entities) return "there are more than 2147483647 points";
    for (const double x : rows.points) {
        if (!std::isfinite(x)) return "a coordinate is not finite";
    }
    std::vector<std::string> names;
    bool fits = true;
    const auto check = [&](const char* name, std::size_t size) {
        if (size != 0) names.emplace_back(name);
        fits = fits && (size == 0 || size == count);
    };
    check(cell_name, rows.cells.size());
    check(feature_name, rows.features.size());
    check(mask_name, rows.inside.size());
    check(distance_name, rows.distances.size());
    for (const Field& field : rows.fields) {
        if (field.components < 1) return "a field has no components";
        fits = fits && field.data.size() == count * static_cast<std::size_t>(field.components);
    }
    if (!fits) return "an array does not have one row per point";
    return io::fault_of_names(rows.fields, std::move(names), io::Names::xml);
}

/// Adds a copy of the values, if there are any.
template <class Array, class Values>
void add(vtkUnstructuredGrid* grid, const char* name, const Values& values) {
    if (values.empty()) return;
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
    using Number = typename Array::ValueType;
    std::transform(values.begin(), values.end(), array->GetPointer(0), [](auto x) { return static_cast<Number>(x); });
    grid->GetPointData()->AddArray(array);
}

Status write(const std::string& path, const PointRows& rows) {
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(io::points_of(rows.points, rows.dimension));
    const std::size_t count = rows.points.size() / static_cast<std::size_t>(rows.dimension);
    vtkNew<vtkTypeInt32Array> nodes;
    nodes->SetNumberOfValues(static_cast<vtkIdType>(count));
    std::iota(nodes->GetPointer(0), nodes->GetPointer(0) + count, 0);
    vtkNew<vtkCellArray> cells;
    cells->SetData(1, nodes);
    grid->SetCells(VTK_VERTEX, cells);
    add<vtkTypeInt64Array>(grid, cell_name, rows.cells);
    add<vtkUnsignedCharArray>(grid, feature_name, rows.features);
    add<vtkSignedCharArray>(grid, mask_name, rows.inside);
    if (!rows.distances.empty()) {
        const auto distances = io::view_of(rows.distances, 1);
        distances->SetName(distance_name);
        grid->GetPointData()->AddArray(distances);
    }
    io::add_fields(grid->GetPointData(), rows.fields, io::Names::xml);
    // Coordinates, three arrays of cells, and one array of each kind.
    std::size_t size = 4096 + count * (24 + 9 + 8 + 1 + 1 + 8);
    for (const Field& field : rows.fields) size += field.data.size() * sizeof(double) + field.name.size() * 6 + 512;
    return io::write_vtu_grid(grid, path, size);
}

}  // namespace

Status write_vtk_points(const std::string& path, const PointRows& rows) {
    const ExactEnvironment environment;
    if (const std::string fault = fault_of(rows); !fault.empty()) return io::cannot_write("the points", fault, path);
    try {
        return write(path, rows);
    } catch (const std::bad_alloc&) {
        return io::vtk_failure(path, "too little memory");
    }
}

}  // namespace barycert::io

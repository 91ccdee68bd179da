#include "barycert/io/vtk/mesh_to_grid.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "barycert/io/vti/xml_name.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/mesh/consistency.hpp"
#include "barycert/mesh/mid_edges.hpp"

namespace barycert::io {
namespace {

int cell_type(const Mesh& mesh) {
    if (mesh.dimension == 2) return mesh.mid_nodes.empty() ? VTK_TRIANGLE : VTK_QUADRATIC_TRIANGLE;
    return mesh.mid_nodes.empty() ? VTK_TETRA : VTK_QUADRATIC_TETRA;
}

/// Corners, then mid-edge nodes, whose order in the mesh is VTK's.
template <class Array>
void set_cells(vtkUnstructuredGrid* grid, const Mesh& mesh) {
    const std::size_t corners = mesh.corners();
    const std::size_t mids = mesh.mid_nodes.empty() ? 0 : mesh::edges_of(mesh.dimension).size();
    vtkNew<Array> nodes;
    nodes->SetNumberOfValues(static_cast<vtkIdType>(mesh.cells.size() + mesh.mid_nodes.size()));
    auto* to = nodes->GetPointer(0);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        to = std::copy_n(mesh.cells.begin() + static_cast<std::ptrdiff_t>(cell * corners), corners, to);
        to = std::copy_n(mesh.mid_nodes.begin() + static_cast<std::ptrdiff_t>(cell * mids), mids, to);
    }
    vtkNew<vtkCellArray> cells;
    cells->SetData(static_cast<vtkIdType>(corners + mids), nodes);
    grid->SetCells(cell_type(mesh), cells);
}

}  // namespace

vtkSmartPointer<vtkDoubleArray> view_of(std::span<const double> values, int components) {
    constexpr int keep = 1;
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetNumberOfComponents(components);
    array->SetArray(const_cast<double*>(values.data()), static_cast<vtkIdType>(values.size()), keep);
    return array;
}

vtkSmartPointer<vtkPoints> points_of(std::span<const double> coordinates, int dimension) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    if (dimension == 3) {
        points->SetData(view_of(coordinates, 3));
        return points;
    }
    vtkNew<vtkDoubleArray> data;
    data->SetNumberOfComponents(3);
    data->SetNumberOfTuples(static_cast<vtkIdType>(coordinates.size() / 2));
    for (std::size_t i = 0; i < coordinates.size() / 2; ++i) {
        const double point[3] = {coordinates[2 * i], coordinates[2 * i + 1], 0};
        data->SetTypedTuple(static_cast<vtkIdType>(i), point);
    }
    points->SetData(data);
    return points;
}

std::string fault_of_names(const std::vector<Field>& fields, std::vector<std::string> others, Names names) {
    for (const Field& field : fields) {
        if (field.name.empty()) return "a field has no name";
        if (names == Names::xml && !xml_attribute(field.name)) {
            return "the name of field " + in_quotes(field.name) + " has bytes that XML cannot hold";
        }
        others.push_back(field.name);
    }
    std::sort(others.begin(), others.end());
    const auto twice = std::adjacent_find(others.begin(), others.end());
    return twice == others.end() ? "" : "two fields are named " + in_quotes(*twice);
}

std::string fault_of_mesh(const Mesh& mesh, Names names) {
    if (const char* const found = mesh::inconsistency(mesh, mesh::FieldValues::any); found != nullptr) return found;
    std::vector<std::string> markers;
    if (!mesh.point_markers.empty()) markers.emplace_back(marker_name);
    const std::string fault = fault_of_names(mesh.point_fields, std::move(markers), names);
    return !fault.empty() ? fault : fault_of_names(mesh.cell_fields, {}, names);
}

void add_fields(vtkFieldData* data, const std::vector<Field>& fields, Names names) {
    for (const Field& field : fields) {
        const vtkSmartPointer<vtkDoubleArray> array = view_of(field.data, field.components);
        array->SetName(names == Names::xml ? xml_attribute(field.name)->c_str() : field.name.c_str());
        data->AddArray(array);
    }
}

bool needs_wide_indices(const Mesh& mesh) {
    return mesh.cells.size() + mesh.mid_nodes.size() > std::numeric_limits<std::int32_t>::max();
}

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Mesh& mesh, Names names) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points_of(mesh.points, mesh.dimension));
    needs_wide_indices(mesh) ? set_cells<vtkTypeInt64Array>(grid, mesh) : set_cells<vtkTypeInt32Array>(grid, mesh);
    add_fields(grid->GetPointData(), mesh.point_fields, names);
    add_fields(grid->GetCellData(), mesh.cell_fields, names);
    if (mesh.point_markers.empty()) return grid;
    vtkNew<vtkTypeInt64Array> markers;
    markers->SetNumberOfValues(static_cast<vtkIdType>(mesh.point_markers.size()));
    std::copy(mesh.point_markers.begin(), mesh.point_markers.end(), markers->GetPointer(0));
    markers->SetName(marker_name);
    grid->GetPointData()->AddArray(markers);
    return grid;
}

Error cannot_write(const std::string& what, const std::string& fault, const std::string& path) {
    return {.what = "cannot write " + what + ": " + fault, .file = path, .remedy = "correct it in memory"};
}

}  // namespace barycert::io

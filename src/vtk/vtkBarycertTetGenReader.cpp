#include "vtkBarycertTetGenReader.h"

#include <algorithm>
#include <type_traits>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

using namespace barycert;

namespace {

template <class T>
void add(vtkDataSetAttributes& attributes, const std::string& name, int components, const std::vector<T>& values) {
    using Array =
        std::conditional_t<std::is_same_v<T, double>, vtkDoubleArray,
                           std::conditional_t<std::is_same_v<T, std::int64_t>, vtkTypeInt64Array, vtkStringArray>>;
    vtkNew<Array> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), values[i]);
    attributes.AddArray(array);
}

// Makes `grid` the mesh: as write_vtu writes it, so ParaView shows the same either way. Triangles get z = 0; cells are
// quadratic where there are nodes at mid-edges; fields are arrays of doubles; point_markers an array "marker" of 64-bit
// integers.
void fill_grid(const Mesh& mesh, vtkUnstructuredGrid& grid) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.point_count()));
    double* const to = vtkDoubleArray::FastDownCast(points->GetData())->GetPointer(0);
    std::fill_n(to, 3 * mesh.point_count(), 0.0);
    for (std::size_t i = 0; i < mesh.point_count(); ++i) std::copy_n(mesh.points.data() + d * i, d, to + 3 * i);
    grid.SetPoints(points);

    const bool quadratic = !mesh.mid_nodes.empty();
    const std::size_t corners = mesh.corners(), mids = quadratic ? corners * d / 2 : 0;
    vtkNew<vtkCellArray> cells;
    cells->AllocateExact(static_cast<vtkIdType>(mesh.cell_count()),
                         static_cast<vtkIdType>(mesh.cell_count() * (corners + mids)));
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        cells->InsertNextCell(static_cast<int>(corners + mids));
        for (std::size_t k = 0; k < corners; ++k) cells->InsertCellPoint(mesh.cells[corners * i + k]);
        for (std::size_t k = 0; k < mids; ++k) cells->InsertCellPoint(mesh.mid_nodes[mids * i + k]);
    }
    const int flat = quadratic ? VTK_QUADRATIC_TRIANGLE : VTK_TRIANGLE;
    const int solid = quadratic ? VTK_QUADRATIC_TETRA : VTK_TETRA;
    grid.SetCells(mesh.dimension == 2 ? flat : solid, cells);

    vtkPointData& at_points = *grid.GetPointData();
    vtkCellData& at_cells = *grid.GetCellData();
    for (const Field& field : mesh.point_fields) add(at_points, field.name, field.components, field.data);
    if (!mesh.point_markers.empty()) add(at_points, "marker", 1, mesh.point_markers);
    for (const Field& field : mesh.cell_fields) add(at_cells, field.name, field.components, field.data);
    for (const auto& [name, values] : mesh.cell_labels)
        std::visit([&, &name = name](const auto& all) { add(at_cells, name, 1, all); }, values);
}

}  // namespace

vtkStandardNewMacro(vtkBarycertTetGenReader);

void vtkBarycertTetGenReader::PrintSelf(ostream& os, vtkIndent indent) {
    Superclass::PrintSelf(os, indent);
    os << indent << "FileName: " << (FileName != nullptr ? FileName : "(none)") << "\n";
}

int vtkBarycertTetGenReader::CanReadFile(const char* name) {
    const std::string_view path = name != nullptr ? name : "";
    return path.ends_with(".node") || path.ends_with(".ele") ? 1 : 0;
}

int vtkBarycertTetGenReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
    if (FileName == nullptr || *FileName == '\0') {
        vtkErrorMacro("FileName is not set");
        return 0;
    }
    const Result<Mesh> mesh = read_tetgen(FileName, {.faces = false, .neighbours = false});
    if (!mesh) {
        vtkErrorMacro("" << mesh.error().message());
        return 0;
    }
    for (const Note& note : mesh->notes)
        if (note.important) vtkWarningMacro("" << message(note));
    fill_grid(*mesh, *vtkUnstructuredGrid::GetData(outputs));
    return 1;
}

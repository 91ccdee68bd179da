#include "vtk/straight_sides.hpp"

#include <algorithm>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataSetAttributes.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

namespace barycert::in_vtk {

namespace {

// The type of the linear cell of its vertices; of other cells their own.
int straight_type(int type) {
    return type == VTK_QUADRATIC_TETRA ? VTK_TETRA : type == VTK_QUADRATIC_TRIANGLE ? VTK_TRIANGLE : type;
}

vtkIdType vertex_count(int straight) {
    return straight == VTK_TETRA ? 4 : 3;
}

bool has_quadratic(vtkUnstructuredGrid* grid) {
    for (vtkIdType i = 0; grid != nullptr && i < grid->GetNumberOfCells(); ++i)
        if (grid->GetCellType(i) != straight_type(grid->GetCellType(i))) return true;
    return false;
}

}  // namespace

vtkSmartPointer<vtkDataSet> straight_sides(vtkDataSet& data) {
    auto* const grid = vtkUnstructuredGrid::SafeDownCast(&data);
    if (!has_quadratic(grid)) return &data;
    const vtkIdType count = grid->GetNumberOfCells();
    vtkNew<vtkUnsignedCharArray> types;
    types->SetNumberOfValues(count);
    vtkNew<vtkCellArray> cells;
    for (vtkIdType i = 0; i < count; ++i) {
        const int type = grid->GetCellType(i), straight = straight_type(type);
        vtkIdType size = 0;
        const vtkIdType* nodes = nullptr;
        grid->GetCellPoints(i, size, nodes);
        types->SetValue(i, static_cast<unsigned char>(straight));
        cells->InsertNextCell(type == straight ? size : std::min(size, vertex_count(straight)), nodes);
    }
    const auto linear = vtkSmartPointer<vtkUnstructuredGrid>::New();
    linear->SetPoints(grid->GetPoints());
    linear->SetCells(types, cells);
    linear->GetCellData()->AddArray(grid->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
    return linear;
}

std::string add_mid_nodes(vtkDataSet& data, const std::vector<vtkIdType>& ids, Mesh& mesh) {
    auto* const grid = vtkUnstructuredGrid::SafeDownCast(&data);
    if (!has_quadratic(grid)) return {};
    const auto corners = static_cast<vtkIdType>(mesh.corners());
    std::size_t linear = 0;
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        const vtkIdType id = ids.empty() ? static_cast<vtkIdType>(i) : ids[i];
        vtkIdType size = 0;
        const vtkIdType* nodes = nullptr;
        grid->GetCellPoints(id, size, nodes);
        const int type = grid->GetCellType(id);
        if (type == straight_type(type)) {
            ++linear;
            continue;
        }
        if (size != corners * (corners + 1) / 2)
            return "cell " + std::to_string(id) + " has " + std::to_string(size) + " nodes";
        for (vtkIdType k = corners; k < size; ++k) mesh.mid_nodes.push_back(static_cast<Mesh::Index>(nodes[k]));
    }
    if (mesh.mid_nodes.empty()) return {};
    if (linear != 0) return "it has linear cells beside quadratic ones";
    mesh.mid_edge_order = MidEdgeOrder::vtk;
    return {};
}

}  // namespace barycert::in_vtk

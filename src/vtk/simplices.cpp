#include "vtk/simplices.hpp"

#include <algorithm>
#include <limits>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

namespace barycert::in_vtk {

namespace {

constexpr unsigned char ghost_mask =
    vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL | vtkDataSetAttributes::HIDDENCELL;

// Dimension of cells that may stand beside simplices and are left out there: 0 to 2; 3 tetrahedra; -1 all others.
int plain_dimension(int type) {
    switch (type) {
        case VTK_EMPTY_CELL:
        case VTK_VERTEX:
        case VTK_POLY_VERTEX:
            return 0;
        case VTK_LINE:
        case VTK_POLY_LINE:
            return 1;
        case VTK_TRIANGLE:
            return 2;
        case VTK_TETRA:
            return 3;
        default:
            return -1;
    }
}

std::string type_name(int type) {
    const char* const name = vtkCellTypes::GetClassNameFromTypeId(type);
    return name != nullptr ? name : "a cell of type " + std::to_string(type);
}

std::vector<double> coordinates(vtkPoints& points) {
    const auto count = static_cast<std::size_t>(points.GetNumberOfPoints());
    std::vector<double> all(3 * count);
    vtkDataArray* const data = points.GetData();
    if (auto* doubles = vtkDoubleArray::FastDownCast(data)) {
        std::copy_n(doubles->GetPointer(0), all.size(), all.begin());
    } else if (auto* floats = vtkFloatArray::FastDownCast(data)) {
        std::copy_n(floats->GetPointer(0), all.size(), all.begin());
    } else {
        for (std::size_t i = 0; i < count; ++i) data->GetTuple(static_cast<vtkIdType>(i), all.data() + 3 * i);
    }
    return all;
}

// Leaves the two coordinates of the plane that all triangles lie in.
std::string flatten(ExactIndex& index) {
    const std::vector<double>& points = index.mesh.points;
    for (int axis = 2; axis >= 0; --axis) {
        const auto at = [&](Mesh::Index node) {
            return points[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)];
        };
        const double plane = at(index.mesh.cells.front());
        if (!std::all_of(index.mesh.cells.begin(), index.mesh.cells.end(),
                         [&](Mesh::Index n) { return at(n) == plane; }))
            continue;
        index.normal = axis;
        index.plane = plane;
        index.axes = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2, axis};
        std::vector<double> flat;
        flat.reserve(points.size() / 3 * 2);
        for (std::size_t i = 0; i < points.size(); i += 3)
            for (std::size_t a = 0; a < 2; ++a) flat.push_back(points[i + static_cast<std::size_t>(index.axes[a])]);
        index.mesh.dimension = 2;
        index.mesh.points = std::move(flat);
        return {};
    }
    return "its triangles do not lie in one plane across an axis";
}

}  // namespace

std::string read_simplices(vtkDataSet& data, ExactIndex& index) {
    auto* const grid = vtkUnstructuredGrid::SafeDownCast(&data);
    auto* const surface = vtkPolyData::SafeDownCast(&data);
    if (grid == nullptr && surface == nullptr) return std::string("a ") + data.GetClassName() + " has no simplices";
    if (surface != nullptr && surface->NeedToBuildCells()) surface->BuildCells();
    vtkPoints* const points = grid != nullptr ? grid->GetPoints() : surface->GetPoints();
    const vtkIdType count = data.GetNumberOfCells();
    constexpr vtkIdType most = std::numeric_limits<Mesh::Index>::max();
    if (count > most || data.GetNumberOfPoints() > most) return "it has more than 2147483647 points or cells";
    if (points == nullptr || count == 0) return {};

    const auto type_of = [&](vtkIdType cell) {
        return grid != nullptr ? grid->GetCellType(cell) : surface->GetCellType(cell);
    };
    int dimension = 0;
    for (vtkIdType i = 0; i < count; ++i) {
        const int type = type_of(i), its = plain_dimension(type);
        if (its < 0) return "cell " + std::to_string(i) + " is a " + type_name(type);
        dimension = std::max(dimension, its);
    }
    if (dimension < 2) return "it has neither tetrahedra nor triangles";

    vtkUnsignedCharArray* const ghosts = data.GetCellGhostArray();
    Mesh& mesh = index.mesh;
    mesh.dimension = dimension;
    const vtkIdType corners = dimension + 1;
    mesh.cells.reserve(static_cast<std::size_t>(corners * count));
    std::vector<vtkIdType> ids;
    ids.reserve(static_cast<std::size_t>(count));
    for (vtkIdType i = 0; i < count; ++i) {
        if (plain_dimension(type_of(i)) != dimension) continue;
        if (ghosts != nullptr && (ghosts->GetValue(i) & ghost_mask) != 0) continue;
        vtkIdType size = 0;
        const vtkIdType* nodes = nullptr;
        if (grid != nullptr) {
            grid->GetCellPoints(i, size, nodes);
        } else {
            surface->GetCellPoints(i, size, nodes);
        }
        if (size != corners) return "cell " + std::to_string(i) + " has " + std::to_string(size) + " vertices";
        for (vtkIdType k = 0; k < corners; ++k) mesh.cells.push_back(static_cast<Mesh::Index>(nodes[k]));
        ids.push_back(i);
    }
    if (ids.empty()) return {};
    if (static_cast<vtkIdType>(ids.size()) != count) index.ids = std::move(ids);
    mesh.points = coordinates(*points);
    return dimension == 2 ? flatten(index) : std::string();
}

}  // namespace barycert::in_vtk

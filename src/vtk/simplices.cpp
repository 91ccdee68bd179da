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

// Leaves the two coordinates of the plane that all triangles lie in: across that axis, or any if it is -1.
std::string flatten(ExactIndex& index, int normal) {
    const std::vector<double>& points = index.mesh.points;
    for (int axis = 2; axis >= 0; --axis) {
        if (normal >= 0 && axis != normal) continue;
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

// A data set of cells, whichever of the two it is.
struct Cells {
    explicit Cells(vtkDataSet& data)
        : grid(vtkUnstructuredGrid::SafeDownCast(&data)),
          surface(vtkPolyData::SafeDownCast(&data)),
          ghosts(data.GetCellGhostArray()),
          count(data.GetNumberOfCells()) {
        if (surface != nullptr && surface->NeedToBuildCells()) surface->BuildCells();
    }
    vtkPoints* points() const { return grid != nullptr ? grid->GetPoints() : surface->GetPoints(); }
    int type(vtkIdType cell) const { return grid != nullptr ? grid->GetCellType(cell) : surface->GetCellType(cell); }
    /// Calls `take(cell, size, nodes)` for each cell of that dimension that is no ghost.
    template <class Take>
    void each(int dimension, Take&& take) const {
        for (vtkIdType i = 0; i < count; ++i) {
            if (plain_dimension(type(i)) != dimension) continue;
            if (ghosts != nullptr && (ghosts->GetValue(i) & ghost_mask) != 0) continue;
            vtkIdType size = 0;
            const vtkIdType* nodes = nullptr;
            if (grid != nullptr) {
                grid->GetCellPoints(i, size, nodes);
            } else {
                surface->GetCellPoints(i, size, nodes);
            }
            take(i, size, nodes);
        }
    }

    vtkUnstructuredGrid* grid;
    vtkPolyData* surface;
    vtkUnsignedCharArray* ghosts;
    vtkIdType count;
};

}  // namespace

std::string cell_dimension(vtkDataSet& data, int& dimension) {
    dimension = -1;
    const Cells cells(data);
    if (cells.grid == nullptr && cells.surface == nullptr)
        return std::string("a ") + data.GetClassName() + " has no simplices";
    constexpr vtkIdType most = std::numeric_limits<Mesh::Index>::max();
    if (cells.count > most || data.GetNumberOfPoints() > most) return "it has more than 2147483647 points or cells";
    if (cells.points() == nullptr) return {};
    for (vtkIdType i = 0; i < cells.count; ++i) {
        const int type = cells.type(i), its = plain_dimension(type);
        if (its < 0) return "cell " + std::to_string(i) + " is a " + type_name(type);
        dimension = std::max(dimension, its);
    }
    return {};
}

std::string read_simplices(vtkDataSet& data, ExactIndex& index, const SimplexShape& shape) {
    int dimension = -1;
    if (std::string reason = cell_dimension(data, dimension); !reason.empty()) return reason;
    if (dimension < 0) return {};
    if (shape.dimension > 0) dimension = shape.dimension;
    if (dimension < 2) return "it has neither tetrahedra nor triangles";

    const Cells cells(data);
    Mesh& mesh = index.mesh;
    mesh.dimension = dimension;
    const vtkIdType corners = dimension + 1;
    mesh.cells.reserve(static_cast<std::size_t>(corners * cells.count));
    std::vector<vtkIdType> ids;
    ids.reserve(static_cast<std::size_t>(cells.count));
    std::string reason;
    cells.each(dimension, [&](vtkIdType cell, vtkIdType size, const vtkIdType* nodes) {
        if (size != corners && reason.empty())
            reason = "cell " + std::to_string(cell) + " has " + std::to_string(size) + " vertices";
        if (!reason.empty()) return;
        for (vtkIdType k = 0; k < corners; ++k) mesh.cells.push_back(static_cast<Mesh::Index>(nodes[k]));
        ids.push_back(cell);
    });
    if (!reason.empty() || ids.empty()) return reason;
    if (static_cast<vtkIdType>(ids.size()) != cells.count) index.ids = std::move(ids);
    mesh.points = coordinates(*cells.points());
    return dimension == 2 ? flatten(index, shape.normal) : std::string();
}

Bounds3 simplex_bounds(vtkDataSet& data, int dimension) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Bounds3 all{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    const Cells cells(data);
    vtkPoints* const points = cells.points();
    if (points == nullptr) return all;
    cells.each(dimension, [&](vtkIdType, vtkIdType size, const vtkIdType* nodes) {
        for (vtkIdType k = 0; k < size; ++k) {
            // A node that is not there makes no bounds: who reads the cells tells of it.
            if (nodes[k] < 0 || nodes[k] >= points->GetNumberOfPoints()) continue;
            std::array<double, 3> x{};
            points->GetPoint(nodes[k], x.data());
            for (std::size_t a = 0; a < 3; ++a) {
                all.low[a] = std::min(all.low[a], x[a]);
                all.high[a] = std::max(all.high[a], x[a]);
            }
        }
    });
    return all;
}

}  // namespace barycert::in_vtk

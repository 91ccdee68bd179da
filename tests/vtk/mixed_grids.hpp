/// Data sets of cells of many types.
#pragma once

#include <array>
#include <vector>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "core/base/random.hpp"

namespace barycert::testing {

/// A double "f" at points, and the number of each cell in "id".
inline void add_arrays(vtkDataSet* data) {
    base::Random random(17);
    vtkNew<vtkDoubleArray> f;
    f->SetName("f");
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) f->InsertNextValue(random.uniform(-1, 1));
    data->GetPointData()->AddArray(f);
    vtkNew<vtkIdTypeArray> id;
    id->SetName("id");
    for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) id->InsertNextValue(i);
    data->GetCellData()->AddArray(id);
}

/// Moves each point by up to `by` along each axis; points of doubles from then on.
inline void move_points(vtkPointSet* data, double by, int axes = 3) {
    base::Random random(23);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        double x[3];
        data->GetPoint(i, x);
        for (int a = 0; a < axes; ++a) x[a] += random.uniform(-by, by);
        points->InsertNextPoint(x);
    }
    data->SetPoints(points);
}

/// A block of n by n by 2 cubes of size 1 whose columns are hexahedra, wedges, six pyramids around a node in the
/// middle, and (`polyhedra`) polyhedra, in turn: each face of one is that of another. Nodes are moved, so that few
/// faces are flat.
inline vtkSmartPointer<vtkUnstructuredGrid> mixed_block(int n, double by, bool polyhedra) {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int k = 0; k <= 2; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) points->InsertNextPoint(i, j, k);
    grid->SetPoints(points);
    grid->Allocate();
    const auto add = [&](int type, const std::vector<vtkIdType>& nodes) {
        grid->InsertNextCell(type, static_cast<vtkIdType>(nodes.size()), nodes.data());
    };
    constexpr std::array<std::array<int, 4>, 6> sides{
        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
    for (int k = 0; k < 2; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const auto at = [&](int x, int y, int z) {
                    return vtkIdType{(k + z) * (n + 1) * (n + 1) + (j + y) * (n + 1) + i + x};
                };
                const std::vector<vtkIdType> c{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0),
                                               at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
                const int column = (i + 2 * j) % (polyhedra ? 4 : 3);
                if (column == 0) add(VTK_HEXAHEDRON, c);
                if (column == 1) {
                    add(VTK_WEDGE, {c[0], c[2], c[1], c[4], c[6], c[5]});
                    add(VTK_WEDGE, {c[0], c[3], c[2], c[4], c[7], c[6]});
                }
                if (column == 2) {
                    const vtkIdType middle = points->InsertNextPoint(i + 0.5, j + 0.5, k + 0.5);
                    for (const auto& s : sides) {
                        std::vector<vtkIdType> nodes;
                        for (std::size_t m = 4; m-- > 0;) nodes.push_back(c[static_cast<std::size_t>(s[m])]);
                        nodes.push_back(middle);
                        add(VTK_PYRAMID, nodes);
                    }
                }
                if (column == 3) {
                    vtkNew<vtkIdList> faces;
                    faces->InsertNextId(6);
                    for (const auto& s : sides) {
                        faces->InsertNextId(4);
                        for (const int place : s) faces->InsertNextId(c[static_cast<std::size_t>(place)]);
                    }
                    grid->InsertNextCell(VTK_POLYHEDRON, faces);
                }
            }
        }
    }
    move_points(grid, by);
    return grid;
}

}  // namespace barycert::testing

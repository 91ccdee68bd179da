// The situations of VTK's own tests of locators and of vtkCell::EvaluatePosition, put to vtkBarycertLocator.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellCenters.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStaticCellLocator.h>
#include <vtkTetra.h>

#include "tests/mesh/check/meshes.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertLocator.h"

namespace barycert::testing {
namespace {

// TestCellLocatorsEdgeCases: a short segment, with a tolerance of 1e-15, through a surface of triangles whose bucket it
// barely enters. The nearest hit, all hits and the cells along the line must have a triangle that the segment meets.
// VTK's surface is a file; here it is a triangle across the middle of that segment, in the corner of a larger surface.
TEST(VtkCases, ShortSegmentsMeetTheirTriangle) {
    const double x1[3] = {0.437783024586950, 0.0263950841209563, 0.373722994626027};
    const double x2[3] = {0.442140196830658, 0.0256207765183134, 0.374080391702881};
    vtkNew<vtkPolyData> surface;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const double middle = (x1[0] + x2[0]) / 2;
    for (const auto& x :
         {std::array{middle, 0.0, 0.3}, {middle, 0.1, 0.3}, {middle, 0.0, 0.45}, {0.6, 0.5, 0.9}, {0.9, 0.9, 0.1}})
        points->InsertNextPoint(x.data());
    surface->SetPoints(points);
    vtkNew<vtkCellArray> cells;
    for (const auto& nodes : {std::array<vtkIdType, 3>{1, 3, 2}, {1, 4, 3}, {0, 1, 2}})
        cells->InsertNextCell(3, nodes.data());
    surface->SetPolys(cells);
    Messages messages;
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(surface);
    locator->CacheCellBoundsOn();
    locator->AutomaticOn();
    locator->BuildLocator();
    EXPECT_TRUE(locator->GetExact());
    vtkNew<vtkGenericCell> cell;
    double t = 0, x[3], pcoords[3];
    int sub_id = 0;
    vtkIdType id = -1;
    EXPECT_EQ(locator->IntersectWithLine(x1, x2, 1e-15, t, x, pcoords, sub_id, id, cell), 1);
    EXPECT_EQ(id, 2);
    vtkNew<vtkIdList> list;
    locator->SetTolerance(1e-15);
    EXPECT_NE(locator->IntersectWithLine(x1, x2, nullptr, list), 0);
    EXPECT_GE(list->IsId(2), 0);
    locator->FindCellsAlongLine(x1, x2, 1e-15, list);
    EXPECT_GE(list->IsId(2), 0);
}

// VTK's tests of EvaluatePosition take the parametric centre, the middles of edges and faces and the vertices of a
// cell, and points beyond its sides: the first are inside with weights that give the point back, the others are not.
// With exact owners the first hold for points that are exactly there, as these are.
TEST(VtkCases, CentresAndVerticesOfATetrahedronAreInside) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    mesh.cells = {0, 1, 2, 3};
    const auto grid = grid_of(mesh);
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(grid);
    vtkNew<vtkGenericCell> cell;
    grid->GetCell(0, cell);
    vtkNew<vtkTetra> tetra;
    tetra->ShallowCopy(cell->GetRepresentativeCell());
    std::vector<std::array<double, 3>> inside = {{0.25, 0.25, 0.25}};
    for (int i = 0; i < 4; ++i) {
        for (int j = i; j < 4; ++j) {
            std::array<double, 3> x{};
            for (std::size_t a = 0; a < 3; ++a)
                x[a] = (mesh.points[3 * static_cast<std::size_t>(i) + a] +
                        mesh.points[3 * static_cast<std::size_t>(j) + a]) /
                       2;
            inside.push_back(x);
        }
    }
    for (std::array<double, 3> x : inside) {
        double theirs[3], their_weights[4], closest[3], dist2 = 0, pcoords[3], weights[4], back[3];
        int sub_id = 0;
        EXPECT_EQ(locator->FindCell(x.data(), 0, cell, pcoords, weights), 0);
        EXPECT_EQ(tetra->EvaluatePosition(x.data(), closest, sub_id, theirs, dist2, their_weights), 1);
        for (int k = 0; k < 4; ++k) EXPECT_EQ(weights[k], their_weights[k]);
        for (int k = 0; k < 3; ++k) EXPECT_EQ(pcoords[k], theirs[k]);
        double again[4];
        cell->EvaluateLocation(sub_id, pcoords, back, again);
        for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(back[a], x[a]);
    }
    // Beyond each side: by VTK's slack of a thousandth still inside, exactly not.
    for (std::array<double, 3> x :
         {std::array{-0.0005, 0.25, 0.25}, {0.25, -0.0005, 0.25}, {0.25, 0.25, -0.0005}, {0.3335, 0.3335, 0.3335}}) {
        double theirs[3], weights[4], closest[3], dist2 = 0;
        int sub_id = 0;
        EXPECT_EQ(tetra->EvaluatePosition(x.data(), closest, sub_id, theirs, dist2, weights), 1);
        EXPECT_EQ(locator->FindCell(x.data()), -1);
    }
}

// TestCellLocator and its like: the centre of every cell is found in it, and all locators agree there.
TEST(VtkCases, CentresOfCellsAreFoundInTheirCells) {
    const Mesh mesh = own_mesh("flange");
    const auto grid = grid_of(mesh);
    vtkNew<vtkCellCenters> centers;
    centers->SetInputData(grid);
    centers->Update();
    vtkNew<vtkBarycertLocator> ours;
    ours->SetDataSet(grid);
    ours->BuildLocator();
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
        double x[3];
        centers->GetOutput()->GetPoint(i, x);
        ASSERT_EQ(ours->FindCell(x), i);
        ASSERT_TRUE(ours->InsideCellBounds(x, i));
    }
}

}  // namespace
}  // namespace barycert::testing

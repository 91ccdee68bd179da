// Which data sets share an index, and for how long.

#include <gtest/gtest.h>

#include <memory>

#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkResampleWithDataSet.h>

#include "tests/vtk/grids.hpp"
#include "vtk/exact_index.hpp"
#include "vtkBarycertLocator.h"

namespace barycert::testing {
namespace {

vtkIdType cell_at(vtkDataSet* data, double x, double y, double z) {
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(data);
    double at[3] = {x, y, z};
    return locator->FindCell(at);
}

/// Corners of a cube of size 4.
vtkSmartPointer<vtkPoints> cube_corners() {
    const auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataTypeToDouble();
    for (int i = 0; i < 8; ++i) points->InsertNextPoint(4 * (i & 1), 4 * (i >> 1 & 1), 4 * (i >> 2));
    return points;
}

vtkSmartPointer<vtkUnstructuredGrid> one_tetrahedron(vtkPoints* points, vtkIdType a, vtkIdType b, vtkIdType c,
                                                     vtkIdType d) {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points);
    const vtkIdType nodes[4] = {a, b, c, d};
    grid->InsertNextCell(VTK_TETRA, 4, nodes);
    return grid;
}

// Both have the time of modification of their common points.
TEST(IndexCache, TellsDataSetsWithTheSamePointsApart) {
    const auto points = cube_corners();
    const auto low = one_tetrahedron(points, 0, 1, 2, 4), high = one_tetrahedron(points, 7, 6, 5, 3);
    points->Modified();
    ASSERT_EQ(low->GetMTime(), high->GetMTime());
    EXPECT_EQ(cell_at(low, 0.5, 0.5, 0.5), 0);
    EXPECT_EQ(cell_at(high, 0.5, 0.5, 0.5), -1);
    EXPECT_EQ(cell_at(high, 3.5, 3.5, 3.5), 0);
    EXPECT_EQ(cell_at(low, 3.5, 3.5, 3.5), -1);
}

TEST(IndexCache, TellsDataSetsWithOtherIdsApart) {
    const auto points = cube_corners();
    const auto alone = one_tetrahedron(points, 0, 1, 2, 4);
    vtkNew<vtkUnstructuredGrid> second;
    second->SetPoints(points);
    const vtkIdType vertex[1] = {0}, nodes[4] = {0, 1, 2, 4};
    second->InsertNextCell(VTK_VERTEX, 1, vertex);
    second->InsertNextCell(VTK_TETRA, 4, nodes);
    EXPECT_EQ(cell_at(alone, 0.5, 0.5, 0.5), 0);
    EXPECT_EQ(cell_at(second, 0.5, 0.5, 0.5), 1);
}

TEST(IndexCache, TellsParallelPlanesApart) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 4, 0, 0, 4};
    mesh.cells = {0, 1, 2};
    const auto low = surface_of(mesh, 2, 0), high = surface_of(mesh, 2, 1), upright = surface_of(mesh, 0, 1);
    EXPECT_EQ(cell_at(low, 1, 2, 0), 0);
    EXPECT_EQ(cell_at(high, 1, 2, 1), 0);
    EXPECT_EQ(cell_at(high, 1, 2, 0), -1);
    EXPECT_EQ(cell_at(upright, 1, 1, 2), 0);
    EXPECT_EQ(cell_at(upright, 1, 2, 1), 0);
    EXPECT_EQ(cell_at(upright, 2, 1, 1), -1);
}

TEST(IndexCache, IsSharedByEqualCellsAndEndsWithTheLastOfThem) {
    std::weak_ptr<const in_vtk::ExactIndex> watched;
    {
        const auto grid = one_tetrahedron(cube_corners(), 0, 1, 2, 4);
        const std::shared_ptr<const in_vtk::ExactIndex> index = in_vtk::exact_index(*grid);
        watched = index;
        EXPECT_EQ(in_vtk::exact_index(*grid), index);
        vtkNew<vtkDoubleArray> values;
        values->SetName("values");
        values->SetNumberOfTuples(8);
        grid->GetPointData()->AddArray(values);
        EXPECT_EQ(in_vtk::exact_index(*grid), index);
        vtkNew<vtkUnstructuredGrid> copy;
        copy->DeepCopy(grid);
        EXPECT_EQ(in_vtk::exact_index(*copy), index);
    }
    EXPECT_TRUE(watched.expired());
}

// VTK's garbage collector deletes the source, without an event.
TEST(IndexCache, EndsWithTheSourceOfVtkResampleWithDataSet) {
    std::weak_ptr<const in_vtk::ExactIndex> watched;
    {
        const auto grid = one_tetrahedron(cube_corners(), 1, 3, 5, 7);
        watched = in_vtk::exact_index(*grid);
        vtkNew<vtkBarycertLocator> locator;
        vtkNew<vtkResampleWithDataSet> resample;
        resample->SetSourceData(grid);
        resample->SetInputData(points_of({1, 1, 1}));
        resample->SetCellLocatorPrototype(locator);
        resample->SetMarkBlankPointsAndCells(false);
        resample->Update();
    }
    EXPECT_TRUE(watched.expired());
}

// Answers of vtkStaticCellLocator follow cells that are not in the index, too.
TEST(IndexCache, OfTheSameTetrahedraStillSeesNewLines) {
    const auto grid = one_tetrahedron(cube_corners(), 0, 1, 2, 4);
    const vtkIdType near[2] = {0, 1}, far[2] = {6, 7};
    grid->InsertNextCell(VTK_LINE, 2, near);
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(grid);
    locator->BuildLocator();
    double box[6] = {1, 2, 3.5, 4.5, 3.5, 4.5};
    vtkNew<vtkIdList> found;
    locator->FindCellsWithinBounds(box, found);
    EXPECT_EQ(found->IsId(2), -1);
    grid->InsertNextCell(VTK_LINE, 2, far);
    grid->Modified();
    locator->BuildLocator();
    locator->FindCellsWithinBounds(box, found);
    EXPECT_NE(found->IsId(2), -1);
}

TEST(IndexCache, CopiesHaveTheSettings) {
    const auto grid = one_tetrahedron(cube_corners(), 0, 1, 2, 4);
    vtkNew<vtkBarycertLocator> locator, copy;
    locator->SetDataSet(grid);
    locator->TolerantOn();
    locator->SetTolerance(0.25);
    locator->BuildLocator();
    copy->ShallowCopy(locator);
    EXPECT_TRUE(copy->GetTolerant());
    EXPECT_EQ(copy->GetTolerance(), 0.25);
    const auto made = vtkSmartPointer<vtkBarycertLocator>::Take(locator->NewInstance());
    EXPECT_TRUE(made->GetTolerant());
}

}  // namespace
}  // namespace barycert::testing

// The other methods of vtkBarycertLocator, its cache, and data sets that it does not take.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkWeakPointer.h>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertLocator.h"

namespace barycert::testing {
namespace {

vtkSmartPointer<vtkBarycertLocator> locator_of(vtkDataSet* data) {
    const auto locator = vtkSmartPointer<vtkBarycertLocator>::New();
    locator->SetDataSet(data);
    locator->BuildLocator();
    return locator;
}

vtkSmartPointer<vtkUnstructuredGrid> two_cells() {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    mesh.cells = {0, 1, 2, 3, 4, 1, 2, 3};
    return grid_of(mesh);
}

std::set<vtkIdType> set_of(vtkIdList* list) {
    std::set<vtkIdType> all;
    for (vtkIdType i = 0; i < list->GetNumberOfIds(); ++i) all.insert(list->GetId(i));
    EXPECT_EQ(static_cast<vtkIdType>(all.size()), list->GetNumberOfIds());
    return all;
}

// vtkTetra projects on faces, edges and vertices: the least of all cells' distances, in double.
double least_distance2(vtkDataSet* data, const double* x) {
    vtkNew<vtkGenericCell> cell;
    double least = std::numeric_limits<double>::infinity();
    for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
        double closest[3], pcoords[3], weights[4], dist2 = 0;
        int sub_id = 0;
        data->GetCell(i, cell);
        if (cell->EvaluatePosition(x, closest, sub_id, pcoords, dist2, weights) >= 0) least = std::min(least, dist2);
    }
    return least;
}

TEST(Closest, IsAsNearAsVtkFindsAmongAllCells) {
    const Mesh mesh = own_mesh("cube-hole");
    const auto grid = grid_of(mesh);
    const auto locator = locator_of(grid);
    double bounds[6];
    grid->GetBounds(bounds);
    base::Random random(6);
    vtkNew<vtkGenericCell> cell;
    int outside = 0;
    for (int i = 0; i < 200; ++i) {
        double x[3], closest[3], dist2 = -1;
        for (int a = 0; a < 3; ++a) x[a] = random.uniform(bounds[2 * a] - 0.5, bounds[2 * a + 1] + 0.5);
        vtkIdType id = -1;
        int sub_id = -1, inside = -1;
        locator->FindClosestPoint(x, closest, cell, id, sub_id, dist2);
        ASSERT_GE(id, 0);
        const double expected = least_distance2(grid, x);
        EXPECT_NEAR(dist2, expected, 1e-12 * expected);
        double between = 0;
        for (int a = 0; a < 3; ++a) between += (x[a] - closest[a]) * (x[a] - closest[a]);
        EXPECT_NEAR(between, dist2, 1e-12 * (1 + dist2));
        EXPECT_EQ(cell->GetCellType(), VTK_TETRA);
        EXPECT_EQ(sub_id, 0);

        const double radius = std::sqrt(dist2);
        EXPECT_EQ(locator->FindClosestPointWithinRadius(x, radius * 1.0001 + 1e-300, closest, cell, id, sub_id, dist2,
                                                        inside),
                  1);
        EXPECT_EQ(inside, locator->FindCell(x) >= 0 ? 1 : 0);
        if (inside == 1) continue;
        ++outside;
        EXPECT_EQ(locator->FindClosestPointWithinRadius(x, radius * 0.9999, closest, id, sub_id, dist2), 0);
        EXPECT_EQ(id, -1);
    }
    EXPECT_GT(outside, 50);
}

TEST(Closest, IsTheLowestCellAndTheExactPoint) {
    const auto grid = two_cells();
    const auto locator = locator_of(grid);
    double closest[3], dist2 = 0;
    vtkIdType id = -1;
    int sub_id = -1;
    const double on_edge[3] = {0.5, 0.5, -2}, at_vertex[3] = {-3, 0, -4}, in_face[3] = {0.25, -1, 0.25};
    locator->FindClosestPoint(on_edge, closest, id, sub_id, dist2);  // the edge 1 2 is of both cells
    EXPECT_EQ(id, 0);
    EXPECT_EQ(dist2, 4);
    EXPECT_EQ(std::vector<double>(closest, closest + 3), (std::vector<double>{0.5, 0.5, 0}));
    locator->FindClosestPoint(at_vertex, closest, id, sub_id, dist2);
    EXPECT_EQ(dist2, 25);
    EXPECT_EQ(std::vector<double>(closest, closest + 3), (std::vector<double>{0, 0, 0}));
    locator->FindClosestPoint(in_face, closest, id, sub_id, dist2);
    EXPECT_EQ(dist2, 1);
    EXPECT_EQ(std::vector<double>(closest, closest + 3), (std::vector<double>{0.25, 0, 0.25}));
}

// Also on faces, edges and vertices, where the lowest cell is the owner.
TEST(Closest, OfAPointInTheMeshIsThePointInItsOwner) {
    const auto grid = two_cells();
    const auto locator = locator_of(grid);
    vtkNew<vtkGenericCell> cell;
    for (std::array<double, 3> x : {std::array{0.25, 0.25, 0.5}, {0.5, 0.5, 0.0}, {1.0, 1.0, 1.0}, {0.25, 0.25, 0.0}}) {
        double closest[3], dist2 = -1;
        vtkIdType id = -1;
        int sub_id = -1, inside = -1;
        EXPECT_EQ(locator->FindClosestPointWithinRadius(x.data(), 1, closest, cell, id, sub_id, dist2, inside), 1);
        EXPECT_EQ(inside, 1);
        EXPECT_EQ(dist2, 0);
        EXPECT_EQ(id, locator->FindCell(x.data()));
        EXPECT_EQ(std::vector<double>(closest, closest + 3), std::vector<double>(x.begin(), x.end()));
    }
}

TEST(Closest, IsThatInThePlaneOfTriangles) {
    const auto surface = surface_of(box(2, {2, 2, 0}), 0, 5);
    const auto locator = locator_of(surface);
    double closest[3], dist2 = 0;
    vtkIdType id = -1;
    int sub_id = -1;
    vtkNew<vtkGenericCell> cell;
    int inside = 1;
    double above[3] = {-4, 0.5, 0.75};
    EXPECT_EQ(locator->FindClosestPointWithinRadius(above, 9, closest, cell, id, sub_id, dist2, inside), 1);
    EXPECT_EQ(inside, 0);
    EXPECT_EQ(dist2, 81);
    EXPECT_EQ(std::vector<double>(closest, closest + 3), (std::vector<double>{5, 0.5, 0.75}));
    double x[3] = {8, -4, 1};
    locator->FindClosestPoint(x, closest, id, sub_id, dist2);
    EXPECT_EQ(dist2, 25);
    EXPECT_EQ(std::vector<double>(closest, closest + 3), (std::vector<double>{5, 0, 1}));
    EXPECT_EQ(locator->FindClosestPointWithinRadius(x, 4.9, closest, id, sub_id, dist2), 0);
    EXPECT_EQ(locator->FindClosestPointWithinRadius(x, 5, closest, id, sub_id, dist2), 1);
}

TEST(Tolerant, GivesPointsBesideACellToIt) {
    const auto grid = two_cells();
    const auto locator = locator_of(grid);
    double x[3] = {0.25, 0.25, -0.01}, pcoords[3], weights[4];
    vtkNew<vtkGenericCell> cell;
    EXPECT_EQ(locator->FindCell(x, 1, cell, pcoords, weights), -1);
    locator->TolerantOn();
    // A prototype hands its settings on.
    vtkSmartPointer<vtkBarycertLocator> made;
    made.TakeReference(locator->NewInstance());
    EXPECT_TRUE(made->GetTolerant());
    made->SetDataSet(grid);
    EXPECT_EQ(made->FindCell(x, 0.02 * 0.02, cell, pcoords, weights), 0);
    EXPECT_EQ(std::vector<double>(weights, weights + 4), (std::vector<double>{0.5, 0.25, 0.25, 0}));
    EXPECT_EQ(made->FindCell(x, 0.005 * 0.005, cell, pcoords, weights), -1);
}

TEST(Lines, AreThoseOfAllCells) {
    const Mesh mesh = own_mesh("cube-hole");
    const auto grid = grid_of(mesh);
    const auto locator = locator_of(grid);
    locator->SetTolerance(0);
    double bounds[6];
    grid->GetBounds(bounds);
    base::Random random(8);
    vtkNew<vtkIdList> list;
    vtkNew<vtkGenericCell> cell;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    int hits = 0;
    for (int i = 0; i < 40; ++i) {
        double p1[3], p2[3];
        for (int a = 0; a < 3; ++a) {
            p1[a] = random.uniform(bounds[2 * a], bounds[2 * a + 1]);
            p2[a] = random.uniform(bounds[2 * a], bounds[2 * a + 1]);
        }
        std::set<vtkIdType> expected;
        double first = 2;
        for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
            double t = 0, x[3], pcoords[3];
            int sub_id = 0;
            grid->GetCell(c, cell);
            if (cell->IntersectWithLine(p1, p2, 0, t, x, pcoords, sub_id) == 0) continue;
            expected.insert(c);
            first = std::min(first, t);
        }
        locator->FindCellsAlongLine(p1, p2, 0, list);
        const std::set<vtkIdType> along = set_of(list);
        EXPECT_TRUE(std::includes(along.begin(), along.end(), expected.begin(), expected.end()));
        double t = 2, x[3], pcoords[3];
        int sub_id = 0;
        vtkIdType id = -1;
        EXPECT_EQ(locator->IntersectWithLine(p1, p2, 0, t, x, pcoords, sub_id), expected.empty() ? 0 : 1);
        EXPECT_EQ(locator->IntersectWithLine(p1, p2, 0, t, x, pcoords, sub_id, id), expected.empty() ? 0 : 1);
        EXPECT_EQ(expected.count(id), expected.empty() ? 0u : 1u);
        EXPECT_EQ(locator->IntersectWithLine(p1, p2, 0, t, x, pcoords, sub_id, id, cell), expected.empty() ? 0 : 1);
        const int all = locator->IntersectWithLine(p1, p2, points, list);
        EXPECT_EQ(all, expected.empty() ? 0 : locator->FindCell(p1) >= 0 ? -1 : 1);
        EXPECT_EQ(set_of(list), expected);
        const auto along_line = [&](vtkIdType k) {
            double at[3], way = 0;
            points->GetPoint(k, at);
            for (int a = 0; a < 3; ++a) way += (at[a] - p1[a]) * (p2[a] - p1[a]);
            return way;
        };
        for (vtkIdType k = 1; k < points->GetNumberOfPoints(); ++k) EXPECT_LE(along_line(k - 1), along_line(k) + 1e-12);
        EXPECT_EQ(points->GetNumberOfPoints(), list->GetNumberOfIds());
        EXPECT_EQ(locator->IntersectWithLine(p1, p2, 0, points, list), expected.empty() ? 0 : 1);
        EXPECT_EQ(set_of(list), expected);
        EXPECT_EQ(locator->IntersectWithLine(p1, p2, 0, points, list, cell), expected.empty() ? 0 : 1);
        EXPECT_EQ(set_of(list), expected);
        for (vtkIdType k = 1; k < points->GetNumberOfPoints(); ++k) {
            double before[3], after[3];
            points->GetPoint(k - 1, before);
            points->GetPoint(k, after);
            EXPECT_LE(vtkMath::Distance2BetweenPoints(p1, before), vtkMath::Distance2BetweenPoints(p1, after) + 1e-12);
        }
        // Without a cell to work with: those whose boxes the line meets.
        locator->IntersectWithLine(p1, p2, 0, points, list, nullptr);
        const std::set<vtkIdType> boxes = set_of(list);
        EXPECT_TRUE(std::includes(boxes.begin(), boxes.end(), expected.begin(), expected.end()));
        for (vtkIdType k = 0; k < list->GetNumberOfIds(); ++k) {
            double its[6], at[3];
            grid->GetCellBounds(list->GetId(k), its);
            points->GetPoint(k, at);
            for (int a = 0; a < 3; ++a) EXPECT_TRUE(its[2 * a] - 1e-9 <= at[a] && at[a] <= its[2 * a + 1] + 1e-9);
        }
        if (expected.empty()) continue;
        ++hits;
        EXPECT_EQ(t, first);
    }
    EXPECT_GT(hits, 20);
}

TEST(Bounds, FindTheCellsWhoseBoxesMeetThem) {
    const Mesh mesh = own_mesh("cube-hole");
    const auto grid = grid_of(mesh);
    const auto locator = locator_of(grid);
    double box[6] = {0.2, 0.5, 0.1, 0.45, 0.3, 0.6};
    std::set<vtkIdType> expected;
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
        double its[6];
        grid->GetCellBounds(c, its);
        bool meets = true;
        for (int a = 0; a < 3; ++a) meets = meets && its[2 * a] <= box[2 * a + 1] && box[2 * a] <= its[2 * a + 1];
        if (meets) expected.insert(c);
        double middle[3] = {(its[0] + its[1]) / 2, (its[2] + its[3]) / 2, (its[4] + its[5]) / 2};
        EXPECT_TRUE(locator->InsideCellBounds(middle, c));
        middle[1] = its[3] + 1;
        EXPECT_FALSE(locator->InsideCellBounds(middle, c));
    }
    vtkNew<vtkIdList> list;
    locator->FindCellsWithinBounds(box, list);
    EXPECT_EQ(set_of(list), expected);
    const double origin[3] = {0.5, 0.5, 0.5}, normal[3] = {0, 0, 1};
    locator->FindCellsAlongPlane(origin, normal, 0, list);
    EXPECT_GT(list->GetNumberOfIds(), 10);
    vtkNew<vtkPolyData> surface;
    locator->GenerateRepresentation(0, surface);
    EXPECT_GT(surface->GetNumberOfCells(), 0);
}

TEST(Cache, FollowsTheDataSet) {
    const auto grid = two_cells();
    const auto locator = locator_of(grid);
    double inside[3] = {0.1, 0.1, 0.1};
    EXPECT_EQ(locator->FindCell(inside), 0);
    const vtkMTimeType built = locator->GetBuildTime();
    locator->Update();
    EXPECT_EQ(locator->GetBuildTime(), built);
    grid->GetPoints()->SetPoint(0, 0.5, 0.5, 0.5);
    grid->GetPoints()->Modified();
    locator->Update();
    EXPECT_EQ(locator->FindCell(inside), -1);
    // Not told: only by force.
    grid->GetPoints()->SetPoint(0, 0, 0, 0);
    locator->BuildLocator();
    EXPECT_EQ(locator->FindCell(inside), -1);
    locator->ForceBuildLocator();
    EXPECT_EQ(locator->FindCell(inside), 0);
    // Another data set; the index of the first one is not asked.
    Mesh far;
    far.points = {10, 0, 0, 11, 0, 0, 10, 1, 0, 10, 0, 1};
    far.cells = {0, 1, 2, 3};
    const auto other = grid_of(far);
    locator->SetDataSet(other);
    EXPECT_EQ(locator->FindCell(inside), -1);
    inside[0] += 10;
    EXPECT_EQ(locator->FindCell(inside), 0);
}

TEST(Cache, OutlivesLocatorsAndDataSets) {
    double inside[3] = {0.1, 0.1, 0.1};
    vtkSmartPointer<vtkBarycertLocator> copy = vtkSmartPointer<vtkBarycertLocator>::New();
    for (int i = 0; i < 50; ++i) {
        const auto grid = two_cells();
        grid->GetPoints()->SetPoint(0, -i, 0, 0);
        const auto locator = locator_of(grid);
        EXPECT_EQ(locator->FindCell(inside), 0);
        copy->ShallowCopy(locator);
        EXPECT_EQ(copy->GetDataSet(), grid.Get());
    }
    EXPECT_EQ(copy->FindCell(inside), 0);
}

TEST(Cache, LetsDataSetsGoThatHaveTheLocator) {
    vtkWeakPointer<vtkUnstructuredGrid> watched;
    {
        const auto grid = two_cells();
        watched = grid;
        const auto locator = locator_of(grid);
        grid->SetCellLocator(locator);
        double x[3] = {0.1, 0.1, 0.1}, box[6] = {0, 1, 0, 1, 0, 1};
        EXPECT_EQ(locator->FindCell(x), 0);
        vtkNew<vtkIdList> list;
        locator->FindCellsWithinBounds(box, list);
        EXPECT_EQ(list->GetNumberOfIds(), 2);
    }
    EXPECT_EQ(watched.Get(), nullptr);
}

TEST(DataSets, WithLowerCellsHaveTheirTetrahedra) {
    const auto grid = two_cells();
    vtkNew<vtkUnstructuredGrid> mixed;
    mixed->SetPoints(grid->GetPoints());
    const vtkIdType vertex[1] = {0}, line[2] = {0, 1}, face[3] = {0, 1, 2}, a[4] = {0, 1, 2, 3}, b[4] = {4, 1, 2, 3};
    mixed->InsertNextCell(VTK_TRIANGLE, 3, face);
    mixed->InsertNextCell(VTK_TETRA, 4, b);
    mixed->InsertNextCell(VTK_LINE, 2, line);
    mixed->InsertNextCell(VTK_TETRA, 4, a);
    mixed->InsertNextCell(VTK_VERTEX, 1, vertex);
    const auto locator = locator_of(mixed);
    EXPECT_TRUE(locator->GetExact());
    double on_face[3] = {0.25, 0.25, 0}, shared[3] = {0.5, 0.25, 0.25};
    EXPECT_EQ(locator->FindCell(on_face), 3);
    EXPECT_EQ(locator->FindCell(shared), 1);
}

TEST(DataSets, OfFloatsAreTakenAsTheyAre) {
    const Mesh mesh = box(3, {2, 2, 2});
    const auto grid = grid_of(mesh);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
        double x[3];
        grid->GetPoint(i, x);
        points->InsertNextPoint(0.1 * x[0], x[1], x[2]);
    }
    grid->SetPoints(points);
    const auto locator = locator_of(grid);
    double in[3] = {static_cast<double>(0.2F), 0.5, 0.5}, beyond[3] = {std::nextafter(in[0], 1.0), 0.5, 0.5};
    EXPECT_GE(locator->FindCell(in), 0);
    EXPECT_EQ(locator->FindCell(beyond), -1);
}

// A data set that cannot be located in exactly is an error that says why, and nothing is found.
TEST(DataSets, ThatCannotBeTakenAreErrors) {
    const auto bad = two_cells();
    bad->GetPoints()->SetPoint(4, 1, 1, std::numeric_limits<double>::infinity());
    vtkNew<vtkUnstructuredGrid> line;
    line->SetPoints(two_cells()->GetPoints());
    const vtkIdType nodes[2] = {0, 1};
    line->InsertNextCell(VTK_LINE, 2, nodes);
    for (const auto& [data, reason] : {std::pair<vtkDataSet*, const char*>(bad, "a coordinate is not finite"),
                                       {line, "it has no cells but points and lines"}}) {
        Messages messages;
        const auto locator = locator_of(data);
        locator->BuildLocator();
        EXPECT_FALSE(locator->GetExact());
        EXPECT_NE(locator->GetReason().find(reason), std::string::npos) << locator->GetReason();
        EXPECT_EQ(messages.count("points cannot be located exactly in this data set"), 1) << messages.all();
        vtkNew<vtkGenericCell> cell;
        double inside[3] = {0.1, 0.1, 0.1}, pcoords[3], weights[8], closest[3], dist2 = 0;
        int sub_id = 0, within = 0;
        vtkIdType id = 0;
        EXPECT_EQ(locator->FindCell(inside), -1);
        EXPECT_EQ(locator->FindCell(inside, 1e-6, cell, pcoords, weights), -1);
        locator->FindClosestPoint(inside, closest, id, sub_id, dist2);
        EXPECT_EQ(id, -1);
        EXPECT_EQ(locator->FindClosestPointWithinRadius(inside, 1, closest, cell, id, sub_id, dist2, within), 0);
    }
}

TEST(DataSets, WithoutCellsHaveNothing) {
    Messages messages;
    vtkNew<vtkUnstructuredGrid> empty;
    const auto locator = locator_of(empty);
    EXPECT_TRUE(locator->GetExact());
    double x[3] = {0, 0, 0}, closest[3], dist2 = 0;
    vtkIdType id = 0;
    int sub_id = 0;
    EXPECT_EQ(locator->FindCell(x), -1);
    locator->FindClosestPoint(x, closest, id, sub_id, dist2);
    EXPECT_EQ(id, -1);
    EXPECT_EQ(messages.all(), "");
    vtkNew<vtkBarycertLocator> none;
    EXPECT_EQ(none->FindCell(x), -1);
    EXPECT_NE(messages.all(), "");
}

}  // namespace
}  // namespace barycert::testing

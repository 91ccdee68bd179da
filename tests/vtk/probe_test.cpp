// vtkBarycertProbe: owners, values and masks against the oracle; arrays as vtkProbeFilter has them.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProbeFilter.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include "barycert/oracle.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertProbe.h"

namespace barycert::testing {
namespace {

// Nodes have a vector field of doubles, cells their numbers plus 2^60.
vtkSmartPointer<vtkUnstructuredGrid> with_arrays(Mesh& mesh,
                                                 vtkSmartPointer<vtkUnstructuredGrid> (*make)(const Mesh&)) {
    base::Random random(11);
    Field field{.name = "v", .components = 2, .data = {}};
    for (std::size_t i = 0; i < 2 * mesh.point_count(); ++i) field.data.push_back(random.uniform(-1, 1));
    mesh.point_fields = {field};
    const auto grid = make(mesh);
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("id");
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) ids->InsertNextValue(i + (vtkIdType{1} << 60));
    grid->GetCellData()->AddArray(ids);
    return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> plain(const Mesh& mesh) {
    return grid_of(mesh);
}

// Checks the values at those points of `out` that are in the mesh, with arrays as above.
void expect_exact_values(const Mesh& mesh, vtkDataSet* out, vtkIdTypeArray* valid) {
    auto* const v = vtkDoubleArray::SafeDownCast(out->GetPointData()->GetArray("v"));
    auto* const id = vtkIdTypeArray::SafeDownCast(out->GetPointData()->GetArray("id"));
    vtkDataArray* const mask = out->GetPointData()->GetArray("vtkValidPointMask");
    ASSERT_TRUE(v != nullptr && id != nullptr && mask != nullptr);
    const PointJudge judge(mesh);
    vtkIdType inside = 0;
    for (vtkIdType i = 0; i < out->GetNumberOfPoints(); ++i) {
        double x[3];
        out->GetPoint(i, x);
        const std::vector<Held> holders = judge.holders(x);
        ASSERT_EQ(mask->GetTuple1(i), holders.empty() ? 0 : 1) << text_of(x, 3);
        ASSERT_EQ(id->GetValue(i), holders.empty() ? 0 : holders.front().cell + (vtkIdType{1} << 60));
        if (!holders.empty()) {
            ASSERT_EQ(valid->GetValue(inside), i);
            ++inside;
        }
        for (int c = 0; c < 2; ++c) {
            double expected = 0;
            if (!holders.empty()) {
                Case one = case_of(mesh, holders.front().cell, x);
                for (std::size_t k = 0; k < mesh.corners(); ++k) {
                    const auto node = static_cast<std::size_t>(
                        mesh.cells[mesh.corners() * static_cast<std::size_t>(holders.front().cell) + k]);
                    one.values[k] = mesh.point_fields[0].data[2 * node + static_cast<std::size_t>(c)];
                }
                expected = ask_oracle(one).value;
            }
            ASSERT_EQ(v->GetTypedComponent(i, c), expected) << text_of(x, 3);
        }
    }
    EXPECT_EQ(valid->GetNumberOfTuples(), inside);
    EXPECT_GT(inside, 100);
}

TEST(Probe, PointsHaveExactOwnersAndCorrectlyRoundedValues) {
    for (const char* const name : {"cube-hole", "flange", "lattice-box"}) {
        SCOPED_TRACE(name);
        Mesh mesh = own_mesh(name);
        const auto grid = with_arrays(mesh, plain);
        base::Random random(2);
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceData(grid);
        probe->SetInputData(points_of(awkward_points(mesh, 40, random)));
        probe->Update();
        EXPECT_TRUE(probe->GetExact());
        expect_exact_values(mesh, probe->GetOutput(), probe->GetValidPoints());
    }
}

TEST(Probe, ImagesHaveTheSameAsTheirPoints) {
    Mesh mesh = own_mesh("lattice-box");
    const auto grid = with_arrays(mesh, plain);
    double bounds[6];
    grid->GetBounds(bounds);
    for (const int first : {0, -3, 7}) {
        SCOPED_TRACE(first);
        vtkNew<vtkImageData> image;
        image->SetExtent(first, first + 12, 0, 11, 2 * first, 2 * first + 10);
        image->SetSpacing((bounds[1] - bounds[0]) / 12, (bounds[3] - bounds[2]) / 8, (bounds[5] - bounds[4]) / 8);
        image->SetOrigin(bounds[0] - first * image->GetSpacing()[0], bounds[2] - 0.1,
                         bounds[4] - 2 * first * image->GetSpacing()[2]);
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceData(grid);
        probe->SetInputData(image);
        probe->Update();
        expect_exact_values(mesh, probe->GetOutput(), probe->GetValidPoints());
    }
}

TEST(Probe, HasTheArraysOfVtkProbeFilter) {
    Mesh mesh = own_mesh("cube-hole");
    const auto grid = with_arrays(mesh, plain);
    vtkNew<vtkFloatArray> both, normals;
    both->SetName("id");  // of points too: that of cells is left out
    normals->SetName("n");
    normals->SetNumberOfComponents(3);
    vtkNew<vtkIntArray> global;
    global->SetName("global");
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        both->InsertNextValue(static_cast<float>(i));
        normals->InsertNextTuple3(1, 0, 0);
        global->InsertNextValue(static_cast<int>(i));
    }
    grid->GetPointData()->SetScalars(both);
    grid->GetPointData()->SetNormals(normals);
    grid->GetPointData()->SetGlobalIds(global);
    const auto points = points_of({0.1, 0.1, 0.1, 0.4, 0.2, 0.3, 9, 9, 9});
    vtkNew<vtkDoubleArray> own, same;
    own->SetName("own");
    same->SetName("v");
    for (int i = 0; i < 3; ++i) {
        own->InsertNextValue(i);
        same->InsertNextValue(-i);
    }
    points->GetPointData()->AddArray(own);
    points->GetPointData()->AddArray(same);
    for (const int pass : {0, 1}) {
        vtkNew<vtkProbeFilter> theirs;
        vtkNew<vtkBarycertProbe> ours;
        const auto run = [&](auto* probe) {
            probe->SetSourceData(grid);
            probe->SetInputData(points);
            probe->SetPassPointArrays(pass);
            probe->SetValidPointMaskArrayName("m");
            probe->Update();
            return probe->GetOutput()->GetPointData();
        };
        vtkPointData* const a = run(theirs.Get());
        vtkPointData* const b = run(ours.Get());
        ASSERT_EQ(a->GetNumberOfArrays(), b->GetNumberOfArrays());
        for (int i = 0; i < a->GetNumberOfArrays(); ++i) {
            ASSERT_STREQ(a->GetArrayName(i), b->GetArrayName(i));
            EXPECT_EQ(a->GetAbstractArray(i)->GetDataType(), b->GetAbstractArray(i)->GetDataType());
            EXPECT_EQ(a->GetAbstractArray(i)->GetNumberOfComponents(), b->GetAbstractArray(i)->GetNumberOfComponents());
            EXPECT_EQ(a->GetAbstractArray(i)->GetNumberOfTuples(), b->GetAbstractArray(i)->GetNumberOfTuples());
            EXPECT_EQ(a->IsArrayAnAttribute(i), b->IsArrayAnAttribute(i)) << a->GetArrayName(i);
        }
    }
}

// One cell with weights of a quarter at (1, 1, 1).
vtkSmartPointer<vtkUnstructuredGrid> corner() {
    Mesh mesh;
    mesh.points = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4};
    mesh.cells = {0, 1, 2, 3};
    return grid_of(mesh);
}

template <class Array>
void add(vtkUnstructuredGrid* grid, std::vector<double> values, int type = 0) {
    const auto array = vtkSmartPointer<Array>::New();
    array->SetName(type == 0 ? "a" : "b");
    for (const double value : values) array->InsertNextTuple1(value);
    grid->GetPointData()->AddArray(array);
}

double probe_one(vtkUnstructuredGrid* grid, std::vector<double> x, const char* name = "a") {
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(grid);
    probe->SetInputData(points_of(x));
    probe->Update();
    return probe->GetOutput()->GetPointData()->GetArray(name)->GetTuple1(0);
}

TEST(Probe, RoundsToFloatOnce) {
    // 1 + 2^-24 + 2^-82: as a double it is the middle of two floats.
    const auto above = corner();
    add<vtkFloatArray>(above, {2, 2 + 0x1p-22, 0x1p-80, 0});
    EXPECT_EQ(probe_one(above, {1, 1, 1}), 1 + 0x1p-23);
    // 1 + 3 * 2^-24 - 2^-82, and the middle itself, which goes to the even one.
    const auto below = corner();
    add<vtkFloatArray>(below, {2, 2 + 3 * 0x1p-22, -0x1p-80, 0});
    EXPECT_EQ(probe_one(below, {1, 1, 1}), 1 + 0x1p-23);
    const auto middle = corner();
    add<vtkFloatArray>(middle, {2, 2 + 3 * 0x1p-22, 0, 0});
    EXPECT_EQ(probe_one(middle, {1, 1, 1}), 1 + 0x1p-22);
}

TEST(Probe, RoundsToIntegersOnceHalvesAwayFromZero) {
    const auto grid = corner();
    add<vtkIntArray>(grid, {0, 1, 1, 0});
    EXPECT_EQ(probe_one(grid, {1, 1, 1}), 1);  // a half
    EXPECT_EQ(probe_one(grid, {1, std::nextafter(1.0, 0.0), 1}), 0);
    const auto negative = corner();
    add<vtkIntArray>(negative, {0, -1, -1, -4});
    EXPECT_EQ(probe_one(negative, {1, 1, 1}), -2);  // -3/2
    // 2^29 + 1/2 - 2^-54: as a double it is a half.
    const auto large = corner();
    add<vtkIntArray>(large, {0, 1 << 30, 1 << 30, 2});
    EXPECT_EQ(probe_one(large, {1, 1, 1 - 0x1p-53}), 1 << 29);
    EXPECT_EQ(probe_one(large, {1, 1, 1}), (1 << 29) + 1);
    const auto bytes = corner();
    add<vtkUnsignedCharArray>(bytes, {255, 255, 255, 255});
    EXPECT_EQ(probe_one(bytes, {1, 1, 1}), 255);
}

// A vertex with NaN has no part where its weight is zero, nor where floats are rounded once.
TEST(Probe, LeavesNaNOutWhereItHasNoPart) {
    Mesh mesh = box(3, {2, 2, 2});
    base::Random random(3);
    Field field{.name = "v", .components = 1, .data = {}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i)
        field.data.push_back(random.below(3) == 0 ? std::nan("") : random.uniform(-1, 1));
    mesh.point_fields = {field};
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(grid_of(mesh));
    probe->SetInputData(points_of(mesh.points));
    probe->Update();
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        const double found = probe->GetOutput()->GetPointData()->GetArray("v")->GetTuple1(static_cast<vtkIdType>(i));
        EXPECT_TRUE(found == field.data[i] || (std::isnan(found) && std::isnan(field.data[i]))) << i << ' ' << found;
    }
    // The value is 1 + 2^-24 + 2^-84: as a double in the middle of two floats, and nearer to the greater one.
    Mesh one;
    one.dimension = 2;
    one.points = {-1, 0, 1, 0, 0, 1};
    one.cells = {0, 1, 2};
    const auto grid = grid_of(one);
    vtkNew<vtkFloatArray> floats;
    floats->SetName("f");
    for (const float f : {1.0F, 1 + 0x1p-23F, std::numeric_limits<float>::quiet_NaN()}) floats->InsertNextValue(f);
    grid->GetPointData()->AddArray(floats);
    probe->SetSourceData(grid);
    probe->SetInputData(points_of({0x1p-60, 0, 0}));
    probe->Update();
    EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("f")->GetTuple1(0), 1 + 0x1p-23);
}

TEST(Probe, PutsNaNOutsideIfAsked) {
    const auto grid = corner();
    add<vtkFloatArray>(grid, {1, 2, 3, 4});
    add<vtkIntArray>(grid, {1, 2, 3, 4}, 1);
    for (const bool nan : {false, true}) {
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceData(grid);
        probe->SetInputData(points_of({1, 1, 1, 3, 3, 3, std::nan(""), 1, 1}));
        probe->SetOutsideIsNaN(nan);
        probe->Update();
        vtkPointData* const out = probe->GetOutput()->GetPointData();
        EXPECT_EQ(out->GetArray("a")->GetTuple1(0), 2.5);
        for (const int i : {1, 2}) {
            EXPECT_EQ(out->GetArray("vtkValidPointMask")->GetTuple1(i), 0);
            EXPECT_EQ(std::isnan(out->GetArray("a")->GetTuple1(i)), nan);
            EXPECT_EQ(out->GetArray("b")->GetTuple1(i), 0);
        }
        EXPECT_EQ(probe->GetValidPoints()->GetNumberOfTuples(), 1);
    }
}

TEST(Probe, LeavesGhostCellsOut) {
    Mesh mesh = box(3, {1, 1, 1});
    const auto grid = with_arrays(mesh, plain);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
        ghosts->InsertNextValue(i == 0   ? vtkDataSetAttributes::DUPLICATECELL
                                : i == 1 ? vtkDataSetAttributes::HIDDENCELL
                                : i == 2 ? vtkDataSetAttributes::REFINEDCELL
                                         : 0);
    grid->GetCellData()->AddArray(ghosts);
    const PointJudge judge(mesh);
    base::Random random(1);
    const std::vector<double> points = awkward_points(mesh, 30, random);
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(grid);
    probe->SetInputData(points_of(points));
    probe->Update();
    auto* const id = vtkIdTypeArray::SafeDownCast(probe->GetOutput()->GetPointData()->GetArray("id"));
    vtkDataArray* const mask = probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask");
    int beside_a_ghost = 0;
    for (vtkIdType i = 0; i < id->GetNumberOfTuples(); ++i) {
        vtkIdType expected = -1;
        const std::vector<Held> holders = judge.holders(points.data() + 3 * i);
        for (const Held& held : holders)
            if (expected < 0 && held.cell > 2) expected = held.cell;
        beside_a_ghost += expected >= 0 && holders.front().cell < 3 ? 1 : 0;
        ASSERT_EQ(mask->GetTuple1(i), expected < 0 ? 0 : 1);
        ASSERT_EQ(id->GetValue(i), expected < 0 ? 0 : expected + (vtkIdType{1} << 60));
    }
    EXPECT_GT(beside_a_ghost, 10);
}

TEST(Probe, TakesTheVertexOfGreatestWeightOfCategories) {
    const auto grid = corner();
    add<vtkIntArray>(grid, {10, 20, 30, 40});
    vtkNew<vtkStringArray> names;
    names->SetName("names");
    for (const char* const name : {"p", "q", "r", "s"}) names->InsertNextValue(name);
    grid->GetPointData()->AddArray(names);
    grid->GetPointData()->SetActiveScalars("a");
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(grid);
    probe->SetInputData(points_of({0.5, 0.5, 2, 1, 1, 1, 0, 0, 0}));
    probe->CategoricalDataOn();
    probe->Update();
    vtkPointData* const out = probe->GetOutput()->GetPointData();
    EXPECT_EQ(out->GetArray("a")->GetTuple1(0), 40);
    EXPECT_EQ(out->GetArray("a")->GetTuple1(1), 10);
    EXPECT_EQ(out->GetArray("a")->GetTuple1(2), 10);
    auto* const got = vtkStringArray::SafeDownCast(out->GetAbstractArray("names"));
    ASSERT_NE(got, nullptr);
    EXPECT_EQ(got->GetValue(0), "s");
    EXPECT_EQ(got->GetValue(2), "p");
}

TEST(Probe, TakesTheNearestPointWithinATolerance) {
    const auto grid = corner();
    add<vtkDoubleArray>(grid, {0, 4, 8, 16});
    vtkNew<vtkIntArray> id;
    id->SetName("id");
    id->InsertNextValue(7);
    grid->GetCellData()->AddArray(id);
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(grid);
    probe->SetInputData(points_of({1, 1, -0.25, 1, 1, -0.5, 1, 1, 1}));
    probe->ComputeToleranceOff();
    probe->SetTolerance(0.25);
    probe->Update();
    vtkPointData* const out = probe->GetOutput()->GetPointData();
    EXPECT_EQ(out->GetArray("a")->GetTuple1(0), 3);
    EXPECT_EQ(out->GetArray("id")->GetTuple1(0), 7);
    EXPECT_EQ(out->GetArray("vtkValidPointMask")->GetTuple1(0), 1);
    EXPECT_EQ(out->GetArray("vtkValidPointMask")->GetTuple1(1), 0);
    EXPECT_EQ(out->GetArray("a")->GetTuple1(2), 7);
}

// Beyond the face of an oblique cell the greatest weight is that of another vertex than at the nearest point.
TEST(Probe, TakesCategoriesOfTheNearestPointWithinATolerance) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 0, 1};
    mesh.cells = {0, 1, 2, 3};
    const auto grid = grid_of(mesh);
    add<vtkIntArray>(grid, {10, 20, 30, 40});
    grid->GetPointData()->SetActiveScalars("a");
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(grid);
    probe->SetInputData(points_of({1, 1, -0.5, 1, 1, 0.125}));
    probe->CategoricalDataOn();
    probe->ComputeToleranceOff();
    probe->SetTolerance(0.5);
    probe->Update();
    vtkPointData* const out = probe->GetOutput()->GetPointData();
    EXPECT_EQ(out->GetArray("vtkValidPointMask")->GetTuple1(0), 1);
    EXPECT_EQ(out->GetArray("a")->GetTuple1(0), 10);
    EXPECT_EQ(out->GetArray("a")->GetTuple1(1), 10);
}

TEST(Probe, TakesTrianglesInAPlane) {
    Mesh mesh = own_mesh("plate");
    mesh.point_fields = {{.name = "x", .data = {}}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i) mesh.point_fields[0].data.push_back(mesh.points[2 * i]);
    const auto surface = surface_of(mesh, 1, 0.3);
    const PointJudge judge(mesh);
    base::Random random(4);
    const std::vector<double> points = awkward_points(mesh, 30, random);
    std::vector<double> in_space;
    for (std::size_t i = 0; i < points.size(); i += 2)
        in_space.insert(in_space.end(), {points[i], i % 8 == 6 ? 0.31 : 0.3, points[i + 1]});
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(surface);
    probe->SetInputData(points_of(in_space));
    probe->Update();
    ASSERT_TRUE(probe->GetExact());
    vtkPointData* const out = probe->GetOutput()->GetPointData();
    int inside = 0;
    for (std::size_t i = 0; i < points.size() / 2; ++i) {
        const bool found = i % 4 != 3 && !judge.holders(points.data() + 2 * i).empty();
        ASSERT_EQ(out->GetArray("vtkValidPointMask")->GetTuple1(static_cast<vtkIdType>(i)), found ? 1 : 0);
        ASSERT_EQ(out->GetArray("x")->GetTuple1(static_cast<vtkIdType>(i)), found ? points[2 * i] : 0);
        inside += found ? 1 : 0;
    }
    EXPECT_GT(inside, 100);
}

TEST(Probe, ReadsTheSourceAgainWhenItChanges) {
    const auto grid = corner();
    add<vtkDoubleArray>(grid, {0, 4, 8, 16});
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(grid);
    probe->SetInputData(points_of({1, 1, 1}));
    probe->Update();
    vtkDataArray* const nodal = grid->GetPointData()->GetArray("a");
    nodal->SetTuple1(0, 100);
    nodal->Modified();
    probe->Update();
    EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("a")->GetTuple1(0), 32);
    grid->GetPoints()->SetPoint(3, 0, 0, 0.5);
    grid->GetPoints()->Modified();
    probe->Update();
    EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask")->GetTuple1(0), 0);
}

TEST(Probe, TakesAMeshThatHasTheMaskOfAnEarlierProbe) {
    const auto grid = corner();
    add<vtkDoubleArray>(grid, {0, 4, 8, 16});
    for (vtkDataSetAttributes* const attributes : {static_cast<vtkDataSetAttributes*>(grid->GetPointData()),
                                                   static_cast<vtkDataSetAttributes*>(grid->GetCellData())}) {
        vtkNew<vtkDoubleArray> mask;
        mask->SetName("vtkValidPointMask");
        mask->SetNumberOfTuples(attributes == grid->GetPointData() ? 4 : 1);
        mask->Fill(0.5);
        attributes->AddArray(mask);
    }
    EXPECT_EQ(probe_one(grid, {1, 1, 1}), 7);
    EXPECT_EQ(probe_one(grid, {1, 1, 1}, "vtkValidPointMask"), 1);
    EXPECT_EQ(probe_one(grid, {9, 1, 1}, "vtkValidPointMask"), 0);
}

TEST(Probe, RefusesArraysThatAreTooShort) {
    for (const bool of_cells : {false, true}) {
        const auto grid = corner();
        add<vtkDoubleArray>(grid, {0, 4, 8, 16});
        vtkNew<vtkDoubleArray> array;
        array->SetName("short");
        (of_cells ? static_cast<vtkDataSetAttributes*>(grid->GetCellData()) : grid->GetPointData())->AddArray(array);
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceData(grid);
        probe->SetInputData(points_of({1, 1, 1}));
        Messages messages;
        probe->Update();
        EXPECT_EQ(messages.count("the source has an array short of 0 tuples, and "), 1) << messages.all();
    }
}

TEST(Probe, OfNothingIsNothing) {
    vtkNew<vtkUnstructuredGrid> empty;
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(empty);
    probe->SetInputData(points_of({1, 1, 1}));
    Messages messages;
    probe->Update();
    EXPECT_EQ(messages.all(), "");
    EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask")->GetTuple1(0), 0);
    probe->SetSourceData(corner());
    probe->SetInputData(vtkSmartPointer<vtkPolyData>::New());
    probe->Update();
    EXPECT_EQ(messages.all(), "");
    EXPECT_EQ(probe->GetOutput()->GetNumberOfPoints(), 0);
}

}  // namespace
}  // namespace barycert::testing

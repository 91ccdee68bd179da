// The locator as a prototype in VTK's filters: the cells that they find are the exact owners.

#include <gtest/gtest.h>

#include <vector>

#include <vtkCellData.h>
#include <vtkCellLocatorInterpolatedVelocityField.h>
#include <vtkCellLocatorStrategy.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkInterpolatedVelocityField.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProbeFilter.h>
#include <vtkResampleWithDataSet.h>
#include <vtkStreamTracer.h>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertLocator.h"

namespace barycert::testing {
namespace {

// The mesh with its cells' numbers as a cell array.
vtkSmartPointer<vtkUnstructuredGrid> numbered(const Mesh& mesh) {
    const auto grid = grid_of(mesh);
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("cell");
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) ids->InsertNextValue(i);
    grid->GetCellData()->AddArray(ids);
    return grid;
}

// Owners and masks of an output whose points are those of `points`.
void expect_owners(const Mesh& mesh, const std::vector<double>& points, vtkPointData* out) {
    vtkDataArray* const cells = out->GetArray("cell");
    vtkDataArray* const mask = out->GetArray("vtkValidPointMask");
    ASSERT_TRUE(cells != nullptr && mask != nullptr);
    ASSERT_EQ(static_cast<std::size_t>(cells->GetNumberOfTuples()), points.size() / 3);
    const PointJudge judge(mesh);
    for (vtkIdType i = 0; i < cells->GetNumberOfTuples(); ++i) {
        const double* const x = points.data() + 3 * i;
        const std::vector<Held> holders = judge.holders(x);
        ASSERT_EQ(mask->GetTuple1(i), holders.empty() ? 0 : 1) << text_of(x, 3);
        ASSERT_EQ(cells->GetTuple1(i), holders.empty() ? 0 : holders.front().cell) << text_of(x, 3);
    }
}

TEST(Filters, ProbeFilterFindsExactOwners) {
    for (const char* const name : {"cube-hole", "lattice-box"}) {
        const Mesh mesh = own_mesh(name);
        base::Random random(5);
        const std::vector<double> points = awkward_points(mesh, 60, random);
        vtkNew<vtkBarycertLocator> locator;
        vtkNew<vtkProbeFilter> probe;
        probe->SetSourceData(numbered(mesh));
        probe->SetInputData(points_of(points));
        probe->SetCellLocatorPrototype(locator);
        for (const bool own_tolerance : {true, false}) {
            probe->SetComputeTolerance(own_tolerance);
            probe->Update();
            expect_owners(mesh, points, probe->GetOutput()->GetPointData());
        }
    }
}

TEST(Filters, ProbeFilterFindsExactOwnersByAStrategy) {
    const Mesh mesh = own_mesh("cube-hole");
    const auto grid = numbered(mesh);
    base::Random random(5);
    const std::vector<double> points = awkward_points(mesh, 60, random);
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(grid);
    locator->BuildLocator();
    vtkNew<vtkCellLocatorStrategy> strategy;
    strategy->SetCellLocator(locator);
    vtkNew<vtkProbeFilter> probe;
    probe->SetSourceData(grid);
    probe->SetInputData(points_of(points));
    probe->SetFindCellStrategy(strategy);
    probe->Update();
    expect_owners(mesh, points, probe->GetOutput()->GetPointData());
}

TEST(Filters, ResampleWithDataSetFindsExactOwners) {
    const Mesh mesh = own_mesh("cube-hole");
    base::Random random(9);
    const std::vector<double> points = awkward_points(mesh, 60, random);
    vtkNew<vtkBarycertLocator> locator;
    vtkNew<vtkResampleWithDataSet> resample;
    resample->SetSourceData(numbered(mesh));
    resample->SetInputData(points_of(points));
    resample->SetCellLocatorPrototype(locator);
    resample->SetMarkBlankPointsAndCells(false);  // crashes in VTK 9.1 if there are points without cells
    resample->Update();
    auto* const out = vtkDataSet::SafeDownCast(resample->GetOutput());
    ASSERT_NE(out, nullptr);
    expect_owners(mesh, points, out->GetPointData());
}

// A velocity of (1, 0, 0) at every node.
vtkSmartPointer<vtkUnstructuredGrid> with_velocities(const Mesh& mesh) {
    const auto grid = grid_of(mesh);
    vtkNew<vtkDoubleArray> velocities;
    velocities->SetName("u");
    velocities->SetNumberOfComponents(3);
    for (std::size_t i = 0; i < mesh.point_count(); ++i) velocities->InsertNextTuple3(1, 0, 0);
    grid->GetPointData()->SetVectors(velocities);
    return grid;
}

TEST(Filters, VelocityFieldsAskTheExactOwner) {
    const Mesh mesh = own_mesh("lattice-box");
    const auto grid = with_velocities(mesh);
    const PointJudge judge(mesh);
    base::Random random(2);
    const std::vector<double> points = awkward_points(mesh, 40, random);
    vtkNew<vtkBarycertLocator> locator;
    vtkNew<vtkCellLocatorInterpolatedVelocityField> by_prototype;
    by_prototype->SetCellLocatorPrototype(locator);
    vtkNew<vtkBarycertLocator> built;
    built->SetDataSet(grid);
    built->BuildLocator();
    grid->SetCellLocator(built);  // the strategy is cloned without its locator, and takes that of the data set
    vtkNew<vtkCellLocatorStrategy> strategy;
    vtkNew<vtkInterpolatedVelocityField> by_strategy;
    by_strategy->SetFindCellStrategy(strategy);
    for (vtkCompositeInterpolatedVelocityField* const field :
         {static_cast<vtkCompositeInterpolatedVelocityField*>(by_prototype.Get()),
          static_cast<vtkCompositeInterpolatedVelocityField*>(by_strategy.Get())}) {
        SCOPED_TRACE(field->GetClassName());
        field->SetCaching(false);
        field->SelectVectors(vtkDataObject::FIELD_ASSOCIATION_POINTS, "u");
        field->AddDataSet(grid);
        for (std::size_t i = 0; i < points.size(); i += 3) {
            double x[3] = {points[i], points[i + 1], points[i + 2]}, velocity[3] = {0, -1, 0};
            const std::vector<Held> holders = judge.holders(x);
            field->ClearLastCellId();
            ASSERT_EQ(field->FunctionValues(x, velocity), holders.empty() ? 0 : 1) << text_of(x, 3);
            if (!holders.empty()) {
                ASSERT_EQ(field->GetLastCellId(), holders.front().cell) << text_of(x, 3);
            }
        }
    }
}

// A line along faces and edges of the cells of a lattice goes through the whole of it.
TEST(Filters, StreamTracerGoesAlongFacesToTheEnd) {
    const Mesh mesh = box(3, {8, 2, 2});
    const auto grid = with_velocities(mesh);
    vtkNew<vtkBarycertLocator> locator;
    vtkNew<vtkCellLocatorInterpolatedVelocityField> field;
    field->SetCellLocatorPrototype(locator);
    vtkNew<vtkStreamTracer> tracer;
    tracer->SetInputData(grid);
    tracer->SetSourceData(points_of({0.25, 1, 1, 0.25, 1, 0.5, 0.25, 0, 0, 0.25, 2, 2, 0.25, 0.3, 0.7, 0.25, 2.5, 1}));
    tracer->SetInterpolatorPrototype(field);
    tracer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "u");
    tracer->SetIntegratorTypeToRungeKutta4();
    tracer->SetIntegrationStepUnit(vtkStreamTracer::LENGTH_UNIT);
    tracer->SetInitialIntegrationStep(0.125);
    tracer->SetMaximumPropagation(100);
    tracer->Update();
    vtkPolyData* const lines = tracer->GetOutput();
    ASSERT_EQ(lines->GetNumberOfCells(), 5);  // the last seed is outside
    for (vtkIdType i = 0; i < lines->GetNumberOfCells(); ++i) {
        vtkNew<vtkIdList> nodes;
        lines->GetCellPoints(i, nodes);
        double first[3], last[3];
        lines->GetPoint(nodes->GetId(0), first);
        lines->GetPoint(nodes->GetId(nodes->GetNumberOfIds() - 1), last);
        EXPECT_EQ(first[0], 0.25);
        EXPECT_GE(last[0], 8 - 0.125);
        EXPECT_EQ(last[1], first[1]);
        EXPECT_EQ(last[2], first[2]);
    }
}

}  // namespace
}  // namespace barycert::testing

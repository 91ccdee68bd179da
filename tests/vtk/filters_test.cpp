// The locator as a prototype in VTK's filters: the cells that they find are the exact owners.

#include <gtest/gtest.h>

#include <vector>

#include <vtkCellData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProbeFilter.h>

#include "check/meshes.hpp"
#include "locate/judge.hpp"
#include "locate/points.hpp"
#include "vtk/grids.hpp"
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

TEST(Filters, ProbeFilterFindsExactOwners) {
    const Mesh mesh = own_mesh("cube-hole");
    base::Random random(5);
    const std::vector<double> points = awkward_points(mesh, 60, random);
    vtkNew<vtkBarycertLocator> locator;
    vtkNew<vtkProbeFilter> probe;
    probe->SetSourceData(numbered(mesh));
    probe->SetInputData(points_of(points));
    probe->SetCellLocatorPrototype(locator);
    probe->Update();
    vtkDataArray* const cells = probe->GetOutput()->GetPointData()->GetArray("cell");
    vtkDataArray* const mask = probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask");
    ASSERT_NE(cells, nullptr);
    const PointJudge judge(mesh);
    for (vtkIdType i = 0; i < probe->GetOutput()->GetNumberOfPoints(); ++i) {
        const double* const x = points.data() + 3 * i;
        const std::vector<Held> holders = judge.holders(x);
        ASSERT_EQ(mask->GetTuple1(i), holders.empty() ? 0 : 1) << text_of(x, 3);
        ASSERT_EQ(cells->GetTuple1(i), holders.empty() ? 0 : holders.front().cell) << text_of(x, 3);
    }
}

}  // namespace
}  // namespace barycert::testing

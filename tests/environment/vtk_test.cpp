// VTK's classes: the same answers in every floating-point environment. Meshes of ordinary and of subnormal size, nodes
// as doubles and as floats; indexes are made in the environment that asks.
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericCell.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include "core/base/random.hpp"
#include "tests/core/same_everywhere.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertLocator.h"
#include "vtkBarycertProbe.h"

namespace barycert::testing {
namespace {

using testing_environments::Answers;
using testing_environments::expect_same_everywhere;

struct Source {
    std::string name;
    vtkSmartPointer<vtkUnstructuredGrid> grid;
    double size = 1;  ///< of a lattice cell
};

vtkSmartPointer<vtkUnstructuredGrid> in_floats(vtkUnstructuredGrid* grid) {
    const auto copy = vtkSmartPointer<vtkUnstructuredGrid>::New();
    copy->DeepCopy(grid);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) points->InsertNextPoint(grid->GetPoint(i));
    copy->SetPoints(points);
    return copy;
}

/// Lattices whose nodes are moved a little; triangles at a z that flushing makes 0.
std::vector<Source> sources() {
    std::vector<Source> all;
    for (const int d : {2, 3}) {
        for (const double unit : {0x1p-1074, 0x1p-145, 1.0 / 16}) {
            base::Random random(static_cast<std::uint64_t>(d));
            Mesh mesh = box(d, {3, 3, 3});
            for (double& x : mesh.points) {
                const double moved = 16 * x + random.integer(-3, 3);
                x = moved * unit;
            }
            const auto grid = grid_of(mesh, unit);
            vtkNew<vtkDoubleArray> doubles;
            vtkNew<vtkFloatArray> floats;
            vtkNew<vtkIntArray> integers;
            doubles->SetName("doubles");
            floats->SetName("floats");
            integers->SetName("integers");
            for (std::size_t i = 0; i < mesh.point_count(); ++i) {
                doubles->InsertNextValue(random.integer(-9, 9) * 0x1p-1074);
                floats->InsertNextValue(static_cast<float>(random.integer(-9, 9)) * 0x1p-149F);
                integers->InsertNextValue(static_cast<int>(random.integer(-9, 9)));
            }
            for (vtkDataArray* const array : {static_cast<vtkDataArray*>(doubles), static_cast<vtkDataArray*>(floats),
                                              static_cast<vtkDataArray*>(integers)})
                grid->GetPointData()->AddArray(array);
            vtkNew<vtkIdTypeArray> ids;
            ids->SetName("cell");
            for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) ids->InsertNextValue(i);
            grid->GetCellData()->AddArray(ids);
            const std::string name = std::to_string(d) + "D, " + std::to_string(std::ilogb(unit));
            all.push_back({name, grid, 16 * unit});
            if (unit != 0x1p-1074) all.push_back({name + ", floats", in_floats(grid), 16 * unit});
        }
    }
    return all;
}

/// In and around the mesh, on and off the plane, at nodes.
std::vector<std::array<double, 3>> places(const Source& source) {
    std::vector<std::array<double, 3>> all;
    base::Random random(5);
    const bool flat = source.name[0] == '2';
    for (int i = 0; i < 150; ++i) {
        std::array<double, 3> x{};
        for (double& c : x) c = std::ldexp(random.integer(-16, 64), -4) * source.size;
        if (flat && i % 8 != 0) x[2] = source.size / 16;
        if (i % 5 == 0) source.grid->GetPoint(random.integer(0, 9), x.data());
        all.push_back(x);
    }
    return all;
}

vtkSmartPointer<vtkUnstructuredGrid> copy_of(const Source& source) {
    const auto copy = vtkSmartPointer<vtkUnstructuredGrid>::New();
    copy->DeepCopy(source.grid);
    return copy;
}

TEST(EveryEnvironment, VtkBarycertLocator) {
    for (const Source& source : sources()) {
        const std::vector<std::array<double, 3>> points = places(source);
        // A distance that some points have; of the smallest mesh its square is 0.
        const double radius = source.size / 8, tolerance2 = source.size * source.size / 256;
        expect_same_everywhere("vtkBarycertLocator, " + source.name, [&](Answers& out) {
            const auto grid = copy_of(source);
            vtkNew<vtkBarycertLocator> locator;
            locator->SetDataSet(grid);
            locator->TolerantOn();
            locator->BuildLocator();
            out.add(locator->GetReason());
            vtkNew<vtkGenericCell> cell;
            for (std::array<double, 3> x : points) {
                std::array<double, 3> at{};
                std::array<double, 4> weights{};
                out.add(locator->FindCell(x.data()));
                out.add(locator->FindCell(x.data(), tolerance2, cell, at.data(), weights.data()));
                out.add_all(at);
                out.add_all(weights);
                for (const vtkIdType id : {0, 7}) out.add(static_cast<int>(locator->InsideCellBounds(x.data(), id)));
                vtkIdType id = -1;
                int sub_id = 0, inside = 0;
                double dist2 = 0;
                for (const double limit : {radius, std::numeric_limits<double>::infinity()}) {
                    out.add(locator->FindClosestPointWithinRadius(x.data(), limit, at.data(), cell, id, sub_id, dist2,
                                                                  inside));
                    out.add(id);
                    out.add(inside);
                    out.add(dist2);
                    out.add_all(at);
                }
            }
        });
    }
}

void add(Answers& out, vtkDataSet* probed) {
    for (const char* const name : {"doubles", "floats", "integers", "cell", "vtkValidPointMask"}) {
        vtkDataArray* const array = probed->GetPointData()->GetArray(name);
        ASSERT_NE(array, nullptr) << name;
        for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
            // As they are: a float that is made a double might be flushed.
            if (auto* const floats = vtkFloatArray::SafeDownCast(array)) {
                out.add(std::bit_cast<std::uint32_t>(floats->GetValue(i)));
            } else {
                out.add(array->GetComponent(i, 0));
            }
        }
    }
}

TEST(EveryEnvironment, VtkBarycertProbe) {
    for (const Source& source : sources()) {
        std::vector<double> coordinates;
        for (const std::array<double, 3>& x : places(source)) coordinates.insert(coordinates.end(), x.begin(), x.end());
        const auto points = points_of(coordinates);
        vtkNew<vtkImageData> image;
        image->SetDimensions(7, 7, 7);
        image->SetSpacing(source.size / 2, source.size / 2, source.size / 2);
        image->SetOrigin(0, 0, source.size / 16);
        vtkNew<vtkBarycertProbe> probe;
        probe->SetTolerance(source.size / 8);
        expect_same_everywhere("vtkBarycertProbe, " + source.name, [&](Answers& out) {
            for (vtkDataSet* const where : {static_cast<vtkDataSet*>(points), static_cast<vtkDataSet*>(image)}) {
                for (const bool tolerant : {false, true}) {
                    const auto grid = copy_of(source);
                    probe->SetSourceData(grid);
                    probe->SetInputData(where);
                    probe->SetComputeTolerance(!tolerant);
                    probe->Update();
                    out.add(static_cast<int>(probe->GetExact()));
                    add(out, probe->GetOutput());
                }
            }
        });
    }
}

}  // namespace
}  // namespace barycert::testing

// Beside VTK's contour filter on real meshes: the same area and number of parts. (Bits differ: VTK rounds its
// parameter, and merges what is near.)
#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkConnectivityFilter.h>
#include <vtkContourGrid.h>
#include <vtkDoubleArray.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkTriangle.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>

#include "barycert/surface.hpp"
#include "core/base/disjoint_sets.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

struct Measures {
    double area = 0;
    long parts = 0;
};

Measures measures_of(const Surface& s) {
    Measures m;
    std::vector<std::size_t> root(s.point_count());
    for (std::size_t v = 0; v < root.size(); ++v) root[v] = v;
    const auto find = [&](std::size_t v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    for (std::size_t t = 0; t < s.cell_count(); ++t) {
        const double* x[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const auto v = static_cast<std::size_t>(s.cells[3 * t + i]);
            x[i] = s.points.data() + 3 * v;
            root[find(v)] = find(static_cast<std::size_t>(s.cells[3 * t]));
        }
        m.area += vtkTriangle::TriangleArea(x[0], x[1], x[2]);
    }
    for (std::size_t v = 0; v < root.size(); ++v) m.parts += root[v] == v ? 1 : 0;
    return m;
}

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Mesh& mesh, const Field& field) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (std::size_t i = 0; i < mesh.point_count(); ++i) points->InsertNextPoint(mesh.points.data() + 3 * i);
    grid->SetPoints(points);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        vtkIdType ids[4];
        for (std::size_t i = 0; i < 4; ++i) ids[i] = mesh.cells[4 * c + i];
        grid->InsertNextCell(VTK_TETRA, 4, ids);
    }
    vtkNew<vtkDoubleArray> values;
    values->SetName("f");
    for (const double x : field.data) values->InsertNextValue(x);
    grid->GetPointData()->SetScalars(values);
    return grid;
}

Measures contour_by_vtk(const Mesh& mesh, const Field& field, double value) {
    // Not vtkContourFilter: the areas of 9.3's differ by 1e-9.
    vtkNew<vtkContourGrid> filter;
    filter->SetInputData(grid_of(mesh, field));
    filter->SetValue(0, value);
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    vtkNew<vtkPolyDataConnectivityFilter> parts;
    parts->SetInputConnection(filter->GetOutputPort());
    parts->SetExtractionModeToAllRegions();
    parts->Update();
    Measures m;
    m.parts = parts->GetNumberOfExtractedRegions();
    vtkPolyData* const out = filter->GetOutput();
    for (vtkIdType t = 0; t < out->GetNumberOfCells(); ++t) {
        double a[3], b[3], c[3];
        vtkCell* const cell = out->GetCell(t);
        cell->GetPoints()->GetPoint(0, a);
        cell->GetPoints()->GetPoint(1, b);
        cell->GetPoints()->GetPoint(2, c);
        m.area += vtkTriangle::TriangleArea(a, b, c);
    }
    return m;
}

TEST(IsosurfaceBesideVtk, AreaAndPartsOfOwnMeshes) {
    for (const char* const name : {"bracket", "flange", "torus", "cube-hole"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = own_mesh(name);
        double low[3], high[3];
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = HUGE_VAL;
            high[k] = -HUGE_VAL;
            for (std::size_t i = k; i < mesh.points.size(); i += 3) {
                low[k] = std::min(low[k], mesh.points[i]);
                high[k] = std::max(high[k], mesh.points[i]);
            }
        }
        Field waves{"f", 1, {}};
        for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
            double f = 0;
            for (std::size_t k = 0; k < 3; ++k) f += std::sin(9 * (mesh.points[i + k] - low[k]) / (high[k] - low[k]));
            waves.data.push_back(f);
        }
        for (const double value : {-0.7, 0.1, 1.3}) {
            SCOPED_TRACE(value);
            const Measures own = measures_of(isosurface(mesh, waves, value).value().surface);
            const Measures theirs = contour_by_vtk(mesh, waves, value);
            EXPECT_GT(own.area, 0);
            // Sums of some thousand areas, each of coordinates rounded to doubles.
            EXPECT_NEAR(own.area, theirs.area, 1e-12 * own.area);
            EXPECT_EQ(own.parts, theirs.parts);
        }
    }
}

}  // namespace
}  // namespace barycert::testing

// vtkProbeFilter with VTK's locators and with vtkBarycertLocator, and vtkBarycertProbe: a million points, and an image
// of 128^3, in about 2 million tetrahedra. Wall times on all threads that each of them uses.
//
//   bench_vtk_probe [POINTS [CUBES]]   CUBES: cubes along each edge of a lattice instead of TetGen's mesh
//
// Before any time is taken, owners and values must be those of barycert's own sampler, which the tests hold against the
// oracle. "first" has the index to make, as after a new file; "again" has it, as in a series of fields or points.
// Demands are printed, no more.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <vtkCellData.h>
#include <vtkCellTreeLocator.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProbeFilter.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>

#include "barycert/sampler.hpp"
#include "core/base/random.hpp"
#include "cube_mesh.hpp"
#include "require.hpp"
#include "tests/mesh/whole_cells.hpp"
#include "tests/vtk_grid.hpp"
#include "vtkBarycertLocator.h"
#include "vtkBarycertProbe.h"

namespace {

using namespace barycert;
using bench::require;

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Mesh& mesh) {
    const test::CellArrays cells = test::whole_cells(mesh);
    auto grid = test::vtk_grid(test::vtk_points(mesh.points), cells.types, cells.ends, cells.nodes, "f",
                               mesh.point_fields[0].data);
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("cell");
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) ids->InsertNextValue(i);
    grid->GetCellData()->AddArray(ids);
    return grid;
}

double time(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Probe>
double probe(vtkDataSet* source, vtkDataSet* where, vtkAbstractCellLocator* prototype, vtkDataSet* keep = nullptr) {
    vtkNew<Probe> filter;
    filter->SetSourceData(source);
    filter->SetInputData(where);
    if constexpr (std::is_same_v<Probe, vtkProbeFilter>) filter->SetCellLocatorPrototype(prototype);
    const double seconds = time([&] { filter->Update(); });
    if (keep != nullptr) keep->ShallowCopy(filter->GetOutput());
    return seconds;
}

void require_rows(const Table& rows, vtkDataSet* out, bool values_too, const char* what) {
    auto* const cells = vtkIdTypeArray::SafeDownCast(out->GetPointData()->GetArray("cell"));
    auto* const values = vtkDoubleArray::SafeDownCast(out->GetPointData()->GetArray("f"));
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        const auto k = static_cast<vtkIdType>(i);
        if (rows.cells[i] < 0) continue;
        require(cells->GetValue(k) == rows.cells[i] && (!values_too || values->GetValue(k) == rows.value(i, 0)), what);
    }
}

void line(const char* what, double seconds, double count, double peer) {
    std::printf("%-58s %9.3f %9.0f %8.1f\n", what, seconds, 1e9 * seconds / count, peer / seconds);
    std::fflush(stdout);
}

double median_of_five(const std::function<double()>& run) {
    std::array<double, 5> seconds{};
    for (double& s : seconds) s = run();
    std::sort(seconds.begin(), seconds.end());
    return seconds[2];
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
    const int cubes = argc > 2 ? std::atoi(argv[2]) : 0;
    Mesh mesh = bench::cube_mesh(cubes);
    base::Random random(1);
    mesh.point_fields = {{.name = "f", .data = {}}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i) mesh.point_fields[0].data.push_back(random.uniform(-1, 1));
    std::vector<double> coordinates;
    for (std::size_t i = 0; i < 3 * count; ++i) coordinates.push_back(random.uniform(0, 1));
    vtkNew<vtkPolyData> points;
    points->SetPoints(test::vtk_points(coordinates));
    constexpr int side = 128;
    vtkNew<vtkImageData> image;
    image->SetDimensions(side, side, side);
    image->SetOrigin(0.5 / side, 0.5 / side, 0.5 / side);
    image->SetSpacing(1.0 / side, 1.0 / side, 1.0 / side);

    // The index dies with its data set, hence a new one for every first time.
    const auto first = [&](auto run) { return median_of_five([&] { return run(grid_of(mesh).Get()); }); };
    const double locator_first = [&] {
        const auto own = grid_of(mesh);
        return probe<vtkProbeFilter>(own, points, vtkSmartPointer<vtkBarycertLocator>::New());
    }();
    const double probe_first = first([&](vtkDataSet* own) { return probe<vtkBarycertProbe>(own, points, nullptr); });
    const double image_first = first([&](vtkDataSet* own) { return probe<vtkBarycertProbe>(own, image, nullptr); });

    const auto grid = grid_of(mesh);
    vtkNew<vtkBarycertLocator> ours;
    vtkNew<vtkCellTreeLocator> tree;
    vtkNew<vtkStaticCellLocator> buckets;
    {
        const Sampler sampler = Sampler::build(mesh, {"f"}).value();
        const Table rows = sampler.sample(coordinates).value();
        vtkNew<vtkPolyData> out;
        probe<vtkBarycertProbe>(grid, points, nullptr, out);
        require_rows(rows, out, true, "vtkBarycertProbe at points");
        probe<vtkProbeFilter>(grid, points, ours, out);
        require_rows(rows, out, false, "vtkProbeFilter with vtkBarycertLocator");
        std::vector<double> voxels;
        for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i) {
            double x[3];
            image->GetPoint(i, x);
            voxels.insert(voxels.end(), x, x + 3);
        }
        vtkNew<vtkImageData> volume;
        probe<vtkBarycertProbe>(grid, image, nullptr, volume);
        require_rows(sampler.sample(voxels).value(), volume, true, "vtkBarycertProbe on an image");
    }
    const double by_tree = probe<vtkProbeFilter>(grid, points, tree);
    const double by_buckets = probe<vtkProbeFilter>(grid, points, buckets);
    const double best = std::min(by_tree, by_buckets);
    const double locator_again = median_of_five([&] { return probe<vtkProbeFilter>(grid, points, ours); });
    const double probe_again = median_of_five([&] { return probe<vtkBarycertProbe>(grid, points, nullptr); });
    const double theirs_image = probe<vtkProbeFilter>(grid, image, nullptr);
    const double image_again = median_of_five([&] { return probe<vtkBarycertProbe>(grid, image, nullptr); });

    const auto n = static_cast<double>(count), voxels = static_cast<double>(image->GetNumberOfPoints());
    std::printf("%zu cells, %zu points, %.0f voxels\n", mesh.cell_count(), count, voxels);
    std::printf("%-58s %9s %9s %8s\n", "", "s", "ns/point", "times");
    line("vtkProbeFilter, vtkStaticCellLocator", by_buckets, n, best);
    line("vtkProbeFilter, vtkCellTreeLocator", by_tree, n, best);
    line("vtkProbeFilter, vtkBarycertLocator, first", locator_first, n, best);
    line("vtkProbeFilter, vtkBarycertLocator, again (demand: 5)", locator_again, n, best);
    line("vtkBarycertProbe, first", probe_first, n, best);
    line("vtkBarycertProbe, again (demand: 50)", probe_again, n, best);
    line("vtkProbeFilter onto an image", theirs_image, voxels, theirs_image);
    line("vtkBarycertProbe onto an image, first", image_first, voxels, theirs_image);
    line("vtkBarycertProbe onto an image, again", image_again, voxels, theirs_image);
}

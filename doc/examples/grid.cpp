// Fills a regular grid.

#include <barycert/grid.hpp>
#include <barycert/mesh_files.hpp>

#include <cstdio>

using namespace barycert;

int main() {
    const Mesh mesh = read_mesh("data/meshes/flange").value();
    const Sampler sampler = Sampler::build(mesh, {"attribute0"}).value();

    const Bounds3 box = bounds_of_cells(mesh);
    const Grid grid = grid_over(3, {64, 64, 16}, box.low, box.high).value();
    const Table rows = resample(sampler, grid).value();  // x runs fastest
    std::printf("%d of %d voxels are inside\n", static_cast<int>(rows.counts.locations.inside()),
                static_cast<int>(rows.row_count()));

    double sum = 0;
    const auto add = [&](const TableView& layers) -> Status {  // some whole layers at a time
        for (std::size_t i = 0; i < layers.row_count(); ++i) sum += layers.cells[i] >= 0 ? layers.values[i] : 0;
        return Done{};
    };
    const SampleCounts counts = resample(sampler, grid, {}, add).value();
    std::printf("mean %.6f\n", sum / static_cast<double>(counts.locations.inside()));
}

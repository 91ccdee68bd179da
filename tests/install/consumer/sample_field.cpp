// barycert::barycert: a field at points and on a grid. Prints what the test expects.

#include <cmath>
#include <cstdio>
#include <vector>

#include "barycert/grid.hpp"
#include "barycert/sampler.hpp"

int main() {
    using namespace barycert;
    Mesh mesh;  // the unit square in two triangles
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 1, 1, 0, 1};
    mesh.cells = {0, 1, 2, 0, 2, 3};
    mesh.point_fields = {{"height", 1, {0, 1, 3, 2}}};
    const std::vector<double> points = {0.5, 0.25, 0.5, 0.5, 2, 2};

    const Sampler sampler = Sampler::build(mesh, {"height"}).value();
    const Table rows = sampler.sample(points).value();
    std::printf("%s, cells %d %d %d, values %g %g %s",
                sampler.locator().method() == Method::walk ? "walk" : "candidates", rows.cells[0], rows.cells[1],
                rows.cells[2], rows.value(0, 0), rows.value(1, 0), std::isnan(rows.value(2, 0)) ? "nan" : "a number");

    const Grid grid = grid_over(2, {3, 3, 1}, {0, 0, 0}, {1, 1, 0}).value();
    const Table on_grid = resample(sampler, grid).value();
    std::printf(", grid to %g, %d points\n", on_grid.values.back(),
                static_cast<int>(rows.counts.locations.points() + on_grid.counts.locations.points()));
    return 0;
}

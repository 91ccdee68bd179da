// barycert::barycert: locate points in a mesh and sample a field there. Prints what the test expects.

#include <cmath>
#include <cstdio>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/grid.hpp"
#include "barycert/locator.hpp"
#include "barycert/sampler.hpp"

int main() {
    using namespace barycert;
    Mesh mesh;  // the unit square in two triangles
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 1, 1, 0, 1};
    mesh.cells = {0, 1, 2, 0, 2, 3};
    const Field field{"height", 1, {0, 1, 3, 2}};

    const auto locator = Locator::build(mesh, check_mesh(mesh).certificate);
    const auto sampler = Sampler::build(*locator, {{&field}});
    const std::vector<double> points = {0.5, 0.25, 0.5, 0.5, 2, 2};
    Samples samples;
    SampleCounts counts;
    if (!sampler->sample(points, {}, samples, counts)) return 2;
    std::printf("%s, cells %d %d %d, values %g %g %s", locator->method() == Method::walk ? "walk" : "candidates",
                samples.cells[0], samples.cells[1], samples.cells[2], samples.values[0], samples.values[1],
                std::isnan(samples.values[2]) ? "nan" : "a number");

    const auto grid = grid_over(2, {3, 3, 1}, {0, 0, 0}, {1, 1, 0});
    double last = 0;
    const Status status = resample(
        *sampler, *grid, {},
        [&](const GridBlock& block) -> Status {
            last = block.values.back();
            return Done{};
        },
        counts);
    std::printf(", grid to %g, %d points\n", status ? last : -1, static_cast<int>(counts.locations.points()));
    return 0;
}

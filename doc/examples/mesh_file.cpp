// Interpolates the fields of a mesh file; what to do with points outside; what the counts say.

#include <barycert/mesh_files.hpp>
#include <barycert/sampler.hpp>

#include <cstdio>
#include <vector>

using namespace barycert;

int main() {
    const std::vector<double> points = {0.1, 0.2, 0.3, 0.5, 0.5, 0.5};  // the second one lies in the hole

    const Mesh mesh = read_mesh("data/meshes/cube-hole").value();
    const Sampler sampler = Sampler::build(mesh, {"attribute0"}).value();
    const Table rows = sampler.sample(points).value();
    std::printf("%g, %g\n", rows.values[0], rows.values[1]);

    const SampleCounts& counts = rows.counts;
    std::printf("%d inside, %d outside\n", static_cast<int>(counts.locations.inside()),
                static_cast<int>(counts.locations.outside));

    SampleOptions options;
    options.outside = {.kind = Outside::nearest, .limit = 0.5};  // farther points get NaN
    options.rounding = Rounding::correct;
    options.threads = 1;
    const Table nearest = sampler.sample(points, options).value();
    std::printf("%g at distance %g\n", nearest.values[1], nearest.distances[1]);

    const Result<Mesh> missing = read_mesh("data/meshes/no-such-mesh");
    if (!missing) std::printf("%s\n", missing.error().message().c_str());
}

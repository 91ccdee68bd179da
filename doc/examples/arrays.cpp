// Interpolates a field given as arrays in memory: no files.

#include <barycert/sampler.hpp>

#include <cstdint>
#include <cstdio>
#include <span>

using namespace barycert;

/// nodes, points: 3 coordinates each; tetrahedra: 4 node indices each; temperature: one number per node.
Table temperatures_at(std::span<const double> points, std::span<const double> nodes,
                      std::span<const std::int32_t> tetrahedra, std::span<const double> temperature) {
    Mesh mesh;
    mesh.points.assign(nodes.begin(), nodes.end());
    mesh.cells.assign(tetrahedra.begin(), tetrahedra.end());
    mesh.point_fields.push_back({.name = "T", .data = {temperature.begin(), temperature.end()}});

    const Sampler sampler = Sampler::build(mesh, {"T"}).value();
    return sampler.sample(points).value();
}

int main() {
    const double nodes[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const std::int32_t tetrahedra[] = {0, 1, 2, 3, 4, 1, 2, 3};  // two cells with a common face
    const double temperature[] = {10, 20, 30, 40, 50};
    const double points[] = {0.25, 0.25, 0.25, 0.25, 0.25, 0.5, 2, 0, 0};

    const Table rows = temperatures_at(points, nodes, tetrahedra, temperature);
    for (std::size_t i = 0; i < rows.row_count(); ++i)
        std::printf("cell %2d, %-8s, T = %g\n", rows.cells[i], name(rows.features[i]).data(), rows.value(i, 0));
}

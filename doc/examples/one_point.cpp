// Follows a particle: the cell of one point at a time, and the nearest point of the mesh.

#include <barycert/locator.hpp>
#include <barycert/mesh_files.hpp>

#include <cstdio>
#include <limits>

using namespace barycert;

int main() {
    const Mesh mesh = read_mesh("data/meshes/flange").value();
    const Locator locator = Locator::build(mesh).value();

    double particle[] = {0.75, 0, 0.25};
    Mesh::Index last_cell = -1;
    for (int step = 0; step < 3; ++step) {
        const Location at = locator.locate(particle, last_cell).value();  // the hint makes the search shorter
        std::printf("%g: cell %d, %s\n", particle[0], at.cell, name(at.feature).data());
        last_cell = at.cell;
        particle[0] += 0.25;
    }

    particle[0] = 3;
    const Nearest nearest = locator.nearest(particle, std::numeric_limits<double>::infinity()).value();
    std::printf("outside: cell %d is %.4f away\n", nearest.cell, nearest.distance);
}

// barycert::barycert: read a mesh, weigh a point. Prints the numbers that the test expects.

#include <cstdio>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/weights.hpp"

int main(int argc, char** argv) {
    const auto mesh =
        barycert::read_tetgen(argc > 1 ? argv[1] : "", {.faces = false, .neighbours = false, .threads = 1});
    if (!mesh) {
        std::fprintf(stderr, "%s\n", mesh.error().message().c_str());
        return 2;
    }
    const double vertices[] = {0, 0, 1, 0, 0, 1}, point[] = {0.25, 0.5};
    const barycert::Weights w = barycert::barycentric_weights(barycert::Simplex::triangle, vertices, point).value();
    std::printf("%d dimensions, %s, weights %g %g %g\n", mesh->dimension, mesh->cell_count() > 0 ? "cells" : "no cells",
                w.weights[0], w.weights[1], w.weights[2]);
    return 0;
}

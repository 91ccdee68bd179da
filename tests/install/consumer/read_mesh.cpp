// barycert::barycert: read a mesh, list the kernels. Prints the numbers that the test expects.

#include <cstdio>

#include "barycert/io.hpp"
#include "barycert/kernels.hpp"

int main(int argc, char** argv) {
    const auto mesh =
        barycert::read_tetgen(argc > 1 ? argv[1] : "", {.faces = false, .neighbours = false, .threads = 1});
    if (!mesh) {
        std::fprintf(stderr, "%s\n", mesh.error().message().c_str());
        return 2;
    }
    const barycert::Kernel kernel = barycert::kernels_matching("triangle.inverse").at(0);
    const double vertices[] = {0, 0, 1, 0, 0, 1}, point[] = {0.25, 0.5};
    double weights[3] = {};
    kernel.weights(vertices, point, weights);
    std::printf("%d dimensions, %s, kernels %s, weights %g %g %g\n", mesh->dimension,
                mesh->cell_count() > 0 ? "cells" : "no cells", barycert::catalogue().size() > 10 ? "many" : "few",
                weights[0], weights[1], weights[2]);
    return 0;
}

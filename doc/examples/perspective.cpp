// Perspective-correct interpolation at pixels of a triangle in a window.

#include <barycert/perspective.hpp>

#include <cstdio>
#include <vector>

using namespace barycert;

int main() {
    // x, y in the window and w, the depth that the projection divided by, of three vertices.
    const double triangle[] = {0, 0, 1, 8, 0, 3, 0, 8, 2};
    const double pixel[] = {4, 0};  // the middle of an edge with depths 1 and 3

    const PerspectiveWeights w = perspective_weights(triangle, pixel).value();
    const double depth = perspective_depth(triangle, pixel).value().value;
    std::printf("%g %g %g, depth %g\n", w.weights[0], w.weights[1], w.weights[2], depth);

    // Texture coordinates u, v at the vertices; at many pixels at once.
    const std::vector<double> uv = {0, 0, 1, 0, 0, 1}, pixels = {4, 0, 2.5, 2.5, 0.5, 6.5};
    std::vector<double> out(pixels.size());
    perspective_values(triangle, pixels, uv, 2, out).value();
    for (std::size_t j = 0; j < out.size(); j += 2) std::printf("%g, %g\n", out[j], out[j + 1]);
}

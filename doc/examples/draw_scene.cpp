// Draws a triangle.

#include <barycert/scene.hpp>

#include <cstdio>

using namespace barycert;

int main() {
    Scene scene;
    scene.size = {64, 64};
    scene.positions = {-1, -1, 0, 1, 1, -1, 0, 1, 0, 1, 0, 1};  // x, y, z, w
    scene.colours = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    scene.triangles = {0, 1, 2};

    RenderCounts counts;
    const Image image = render(scene, &counts).value();
    write_png("triangle.png", image).value();
    std::printf("%d of %d pixels\n", static_cast<int>(counts.pixels), image.width * image.height);
}

// Families of triangles in a window with a depth w at each vertex: what is left of a triangle in space after its
// projection.

#include <cmath>
#include <cstddef>

#include "barycert/audit/recipes.hpp"
#include "barycert/base/random.hpp"

namespace barycert::audit {
namespace {

constexpr double window = 1024;

void set_window_triangle(Case& c, base::Random& random) {
    for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 2; ++axis) c.vertex(i, axis) = random.uniform(0, window);
    }
}

void set_depths(Case& c, base::Random& random) {
    for (int i = 0; i < 3; ++i) c.depth(i) = random.uniform(1, 10);
}

void perspective_ordinary(Case& c, base::Random& random, std::uint64_t) {
    set_window_triangle(c, random);
    set_depths(c, random);
    c.point = random_point(c, random, 3);
    random_values(c, random);
}

void depth_ratio(Case& c, base::Random& random, std::uint64_t) {
    set_window_triangle(c, random);
    for (int i = 0; i < 3; ++i) c.depth(i) = random.scaled(1, 2, 0, 19);
    c.point = random_point(c, random, 3);
    random_values(c, random);
}

void pixel_edges(Case& c, base::Random& random, std::uint64_t) {
    const int size = 1 << random.integer(2, 12);
    set_pixel_case(c, random, size, true);
    set_depths(c, random);
    random_values(c, random);
}

// The last vertex beside the middle part of the opposite side, at 2^-10 to 2^-40 of the window.
void edge_on(Case& c, base::Random& random, std::uint64_t) {
    set_window_triangle(c, random);
    set_depths(c, random);
    const auto foot = random_point(c, random, 2);
    const double height = random.scaled(window / 2, window, -40, -10);
    set_vertex(c, 2, lifted(c, random, foot, height));
    c.point = random_point(c, random, 3);
    random_values(c, random);
}

// Anywhere in a larger window: 1/Z is small or negative at some.
void outside(Case& c, base::Random& random, std::uint64_t) {
    set_window_triangle(c, random);
    set_depths(c, random);
    for (std::size_t k = 0; k < 2; ++k) c.point[k] = random.uniform(-window, 2 * window);
    random_values(c, random);
}

Family of_perspective(const char* name, const char* tests, const char* parameters, Family::Recipe recipe) {
    Family f = built(name, tests, parameters, recipe, triangle_only);
    f.perspective = true;
    return f;
}

}  // namespace

std::vector<Family> perspective_families() {
    return {
        of_perspective("perspective.ordinary", "triangles of a window with depths of like size, points inside",
                       "x, y U[0,1024), w U[1,10), point fl(sum w_i v_i)", perspective_ordinary),
        of_perspective("perspective.depth-ratio", "depths up to 10^6 apart: a weight may be all but 0 or 1",
                       "x, y U[0,1024), w U[1,2) 2^[0,19], point fl(sum w_i v_i)", depth_ratio),
        of_perspective("perspective.pixel-edges",
                       "pixel centres on edges: a weight is exactly zero, whatever the depths",
                       "triangle.pixels on an edge, w U[1,10)", pixel_edges),
        of_perspective("perspective.edge-on", "triangles seen nearly edge-on: flat in the window, not in space",
                       "x, y U[0,1024), the last vertex at 2^-[10,40] of the window from the opposite side, w U[1,10)",
                       edge_on),
        of_perspective("perspective.outside", "points outside: towards the horizon 1/Z goes through zero",
                       "x, y U[0,1024), w U[1,10), point U[-1024,2048)", outside),
    };
}

}  // namespace barycert::audit

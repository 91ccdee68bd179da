// Families of triangles in window coordinates: those whose points are pixel centres and whose vertices lie on the grid
// of 1/256 of a pixel that rasterisers round to, and those in perspective.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "audit/recipes.hpp"
#include "barycert/family.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"

namespace barycert::audit {
namespace {

/// Exact: coordinates are multiples of 1/256 below 2^14, so that products are multiples of 2^-16 below 2^30.
bool in_triangle(const Case& c) {
    bool left = false, right = false;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const double area = (c.vertex(j, 0) - c.vertex(i, 0)) * (c.point[1] - c.vertex(i, 1)) -
                            (c.vertex(j, 1) - c.vertex(i, 1)) * (c.point[0] - c.vertex(i, 0));
        left |= area > 0;
        right |= area < 0;
    }
    return !(left && right);
}

/// A pixel centre near a random point of the triangle, the first of a few that is in it.
void set_inner_pixel(Case& c, base::Random& random) {
    for (int attempt = 0; attempt < 32; ++attempt) {
        c.point = random_point(c, random, 3);
        for (std::size_t k = 0; k < 2; ++k) c.point[k] = std::floor(c.point[k]) + 0.5;
        if (in_triangle(c)) return;
    }
}

/// A pixel centre, and two vertices on a line through it, on either side.
void set_edge_pixel(Case& c, base::Random& random, const double (&origin)[2], int size) {
    const int before = random.integer(1, 4);
    const int behind = random.integer(1, 4);
    for (int axis = 0; axis < 2; ++axis) {
        const double p = origin[axis] + random.integer(0, size - 1) + 0.5;
        const double step = random.integer(-32 * size, 32 * size) * 0x1p-8;
        c.point[static_cast<std::size_t>(axis)] = p;
        c.vertex(0, axis) = p - before * step;
        c.vertex(1, axis) = p + behind * step;
    }
}

int box_size(base::Random& random) {
    return 1 << random.integer(2, 12);
}

// With a depth w at each vertex: what is left of a triangle in space after its projection.

constexpr double window = 1024;

void set_depths(Case& c, base::Random& random) {
    for (int i = 0; i < 3; ++i) c.depth(i) = random.uniform(1, 10);
}

void set_ratios(Case& c, base::Random& random) {
    for (int i = 0; i < 3; ++i) c.depth(i) = random.scaled(1, 2, 0, 19);
}

void set_inner_point(Case& c, base::Random& random) {
    c.point = random_point(c, random, 3);
}

/// The last vertex beside the middle part of the opposite side, at 2^-10 to 2^-40 of the window.
void set_flat(Case& c, base::Random& random) {
    const auto foot = random_point(c, random, 2);
    const double height = random.scaled(window / 2, window, -40, -10);
    set_vertex(c, 2, lifted(c, random, foot, height));
    set_inner_point(c, random);
}

/// Anywhere in a larger window: 1/Z is small or negative at some.
void set_far_point(Case& c, base::Random& random) {
    for (std::size_t k = 0; k < 2; ++k) c.point[k] = random.uniform(-window, 2 * window);
}

/// A triangle of the window, step after step.
template <void (*... steps)(Case&, base::Random&)>
void in_window(Case& c, base::Random& random, std::uint64_t) {
    for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 2; ++axis) c.vertex(i, axis) = random.uniform(0, window);
    }
    (steps(c, random), ...);
    random_values(c, random);
}

}  // namespace

void set_pixel_case(Case& c, base::Random& random, int size, bool on_edge, int window) {
    double origin[2];
    for (double& o : origin) o = random.integer(0, window - 1);
    for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 2; ++axis) c.vertex(i, axis) = origin[axis] + random.integer(0, 256 * size) * 0x1p-8;
    }
    if (!on_edge) return set_inner_pixel(c, random);
    set_edge_pixel(c, random, origin, size);
    const int last = random.integer(0, 2);  // the vertex that the edge leaves out
    for (int axis = 0; axis < 2; ++axis) std::swap(c.vertex(last, axis), c.vertex(2, axis));
}

std::vector<Family> window_families() {
    return {
        {"triangle.pixels", "pixel centres in and on the edges of triangles of 4 to 4096 pixels: steps add up",
         "vertices k/256 in a box of 2^[2,12] pixels, point (i + 1/2, j + 1/2), half of them on an edge", triangle_only,
         [](Case& c, base::Random& random, std::uint64_t) {
             const int size = box_size(random);
             set_pixel_case(c, random, size, random.coin());
             random_values(c, random);
         }},
        {"perspective.ordinary", "triangles of a window with depths of like size, points inside",
         "x, y U[0,1024), w U[1,10), point fl(sum w_i v_i)", triangle_only, in_window<set_depths, set_inner_point>},
        {"perspective.depth-ratio", "depths up to 10^6 apart: a weight may be all but 0 or 1",
         "x, y U[0,1024), w U[1,2) 2^[0,19], point fl(sum w_i v_i)", triangle_only,
         in_window<set_ratios, set_inner_point>},
        {"perspective.pixel-edges", "pixel centres on edges: a weight is exactly zero, whatever the depths",
         "triangle.pixels on an edge, w U[1,10)", triangle_only,
         [](Case& c, base::Random& random, std::uint64_t) {
             set_pixel_case(c, random, box_size(random), true);
             set_depths(c, random);
             random_values(c, random);
         }},
        {"perspective.edge-on", "triangles seen nearly edge-on: flat in the window, not in space",
         "x, y U[0,1024), the last vertex at 2^-[10,40] of the window from the opposite side, w U[1,10)", triangle_only,
         in_window<set_depths, set_flat>},
        {"perspective.outside", "points outside: towards the horizon 1/Z goes through zero",
         "x, y U[0,1024), w U[1,10), point U[-1024,2048)", triangle_only, in_window<set_depths, set_far_point>},
    };
}

}  // namespace barycert::audit

/// What recipes share.
#pragma once

#include <utility>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/audit/combine.hpp"
#include "barycert/base/random.hpp"

namespace barycert::audit {

/// The parts of all_families(): from meshes, and made.
std::vector<Family> mesh_families();
std::vector<Family> near_families();
std::vector<Family> shape_families();
std::vector<Family> range_families();
std::vector<Family> raster_families();
std::vector<Family> perspective_families();

/// Every coordinate of every vertex, and of the point, from `make(axis)`.
template <class Make>
void fill(Case& c, base::Random& random, Make make) {
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        for (int i = 0; i < vertex_count(c.simplex); ++i) c.vertex(i, axis) = make(axis);
        c.point[static_cast<std::size_t>(axis)] = make(axis);
    }
    random_values(c, random);
}

inline void ordinary(Case& c, base::Random& random, std::uint64_t = 0) {
    fill(c, random, [&](int) { return random.uniform(-1, 1); });
}

/// `from` moved by `h` along the normal of the first n - 1 vertices.
inline std::array<double, 3> lifted(const Case& c, base::Random& random, std::array<double, 3> from, double h) {
    const auto normal = facet_normal(c, random);
    for (std::size_t k = 0; k < 3; ++k) from[k] += h * normal[k];
    return from;
}

/// Sets a triangle on the grid of 1/256 pixel, in a box of `size` pixels that starts somewhere in a window, and a pixel
/// centre in it (a few have none), or, `on_edge`, exactly on one of its edges. Does not set values.
/// (families_raster.cpp)
void set_pixel_case(Case& c, base::Random& random, int size, bool on_edge, int window = 4096);

inline Family built(const char* name, const char* tests, const char* parameters, Family::Recipe recipe,
                    std::vector<Simplex> simplices) {
    Family f;
    f.name = name;
    f.tests = tests;
    f.parameters = parameters;
    f.simplices = std::move(simplices);
    f.recipe = recipe;
    return f;
}

inline const std::vector<Simplex> every{all_simplices.begin(), all_simplices.end()};
inline const std::vector<Simplex> triangle_only{Simplex::triangle};
inline const std::vector<Simplex> tetrahedron_only{Simplex::tetrahedron};
inline const std::vector<Simplex> solid{Simplex::triangle, Simplex::tetrahedron};  ///< of full dimension
inline const std::vector<Simplex> sided{Simplex::triangle, Simplex::triangle3d, Simplex::tetrahedron};

}  // namespace barycert::audit

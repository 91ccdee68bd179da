/// Steps that recipes share: simplices drawn from meshes (their cells, and faces and edges of these), and points made
/// from vertices, in plain rounded arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/family.hpp"
#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"
#include "core/base/range.hpp"
#include "core/base/ulp.hpp"
#include "core/base/vectors.hpp"

namespace barycert::audit {

/// A mesh prepared for drawing simplices: its neighbours, hull and bounding box.
struct PreparedMesh {
    std::string name;
    Mesh mesh;
    std::vector<Mesh::Index> neighbours = {};    ///< as compute_neighbours gives them
    std::vector<std::int64_t> hull_facets = {};  ///< cell * corners + opposite corner
    std::array<base::Range, 3> box = {};         ///< bounding box
    Certificate certificate;                     ///< what is known of the mesh
};

/// A simplex drawn from a mesh, with the cell it belongs to.
struct Draw {
    const PreparedMesh* from = nullptr;
    Mesh::Index cell = 0;
    std::array<Mesh::Index, 4> nodes{};
    Case simplex;  ///< vertices and nodal values set, point not
};

/// A random cell, or a random face or edge of one. Nodal values are a component of one of the mesh's point fields,
/// drawn as well, or random in [-1, 1) if it has none and where it is not finite. Requires: meshes.supplies(s).
Draw draw_any(const MeshSource& meshes, Simplex s, base::Random& random);

/// A random cell at the hull, its vertices ordered so that the hull's facet is the one opposite to the last.
Draw draw_at_hull(const MeshSource& meshes, Simplex s, base::Random& random);

/// The simplex that given nodes make.
Draw draw_of_nodes(const PreparedMesh& from, Mesh::Index cell, std::array<Mesh::Index, 4> nodes, Simplex s,
                   base::Random& random);

/// The cell itself.
Draw draw_of_cell(const PreparedMesh& from, Mesh::Index cell, base::Random& random);

/// n weights >= 0 that sum to about 1, evenly spread over the simplex: the gaps between n - 1 sorted random cuts of [0,
/// 1].
inline std::array<double, 4> random_weights(base::Random& random, int n) {
    std::array<double, 5> cuts{0, 1, 1, 1, 1};
    for (int i = 1; i < n; ++i) cuts[static_cast<std::size_t>(i)] = random.unit();
    std::sort(cuts.begin() + 1, cuts.end() - 1);  // the others are 1, and random ones less
    std::array<double, 4> w{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) w[i] = cuts[i + 1] - cuts[i];
    return w;
}

/// fl(sum of w_i v_i) over the first n vertices, from left to right.
inline std::array<double, 3> combination(const Case& c, const std::array<double, 4>& w, int n) {
    std::array<double, 3> p{};
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        for (int i = 0; i < n; ++i)
            p[static_cast<std::size_t>(axis)] += w[static_cast<std::size_t>(i)] * c.vertex(i, axis);
    }
    return p;
}

/// A rounded point in the whole simplex, or in the face of its first n vertices.
inline std::array<double, 3> random_point(const Case& c, base::Random& random, int n) {
    return combination(c, random_weights(random, n), n);
}

/// In the plane the third coordinate is 0.
inline std::array<double, 3> vertex_at(const Case& c, int i) {
    std::array<double, 3> p{};
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) p[static_cast<std::size_t>(axis)] = c.vertex(i, axis);
    return p;
}

inline void set_vertex(Case& c, int i, const std::array<double, 3>& p) {
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) c.vertex(i, axis) = p[static_cast<std::size_t>(axis)];
}

/// Kernels and oracles are asked of finite points alone: where the recipe of a point leaves the range of doubles, as in
/// meshes as large as that, the end of the range, or zero if there is no telling which.
inline void keep_finite(std::array<double, 3>& point) {
    constexpr double most = std::numeric_limits<double>::max();
    for (double& x : point) x = std::isnan(x) ? 0 : std::clamp(x, -most, most);
}

/// Moves a coordinate by one ulp, up or down. The neighbour of zero would be a subnormal, a test of underflow and not
/// of sides: zero moves by an ulp of the largest coordinate on its axis, or of 1 if all are zero.
inline void move_by_ulp(const Case& c, double& x, int axis, base::Random& random) {
    const bool up = random.coin();
    if (x != 0) {
        x = up ? base::next_up(x) : base::next_down(x);
        return;
    }
    double max = 0;
    for (int i = 0; i < vertex_count(c.simplex); ++i) max = std::max(max, std::fabs(c.vertex(i, axis)));
    const double ulp = std::ldexp(1, base::ulp_exponent(max == 0 ? 1.0 : max));
    x = up ? ulp : -ulp;
}

/// Up to two doubles up or down.
inline double ulps_away(double x, base::Random& random) {
    return base::places_above(x, random.integer(-2, 2));
}

inline void random_values(Case& c, base::Random& random) {
    for (int i = 0; i < vertex_count(c.simplex); ++i) c.values[static_cast<std::size_t>(i)] = random.uniform(-1, 1);
}

/// The parts of all_families(): from meshes, and made.
std::vector<Family> mesh_families();
std::vector<Family> plain_families();
std::vector<Family> window_families();

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

/// `from` moved by `h` along a unit vector, up to rounding, along which the last vertex leaves the facet of the others:
/// normal to that edge of a triangle or face of a tetrahedron; where there are many (an edge in 3-space, a point), a
/// random one.
inline std::array<double, 3> lifted(const Case& c, base::Random& random, std::array<double, 3> from, double h) {
    const auto edge = [&](int i) { return base::minus(vertex_at(c, i), vertex_at(c, 0)); };
    std::array<double, 3> a{0, 0, 1}, b{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (c.simplex != Simplex::segment) a = edge(1);
    if (c.simplex == Simplex::triangle) b = {0, 0, 1};
    if (c.simplex == Simplex::tetrahedron) b = edge(2);
    const std::array<double, 3> n = base::cross(a, b);
    const double length = std::sqrt(base::dot(n, n));
    for (std::size_t k = 0; k < 3; ++k) from[k] += h * (length > 0 ? n[k] / length : k == 0 ? 1.0 : 0.0);
    return from;
}

/// Sets a triangle on the grid of 1/256 pixel, in a box of `size` pixels that starts somewhere in a window, and a pixel
/// centre in it (a few have none), or, `on_edge`, exactly on one of its edges. Does not set values.
/// (families_window.cpp)
void set_pixel_case(Case& c, base::Random& random, int size, bool on_edge, int window = 4096);

inline const std::vector<Simplex> every{all_simplices.begin(), all_simplices.end()};
inline const std::vector<Simplex> triangle_only{Simplex::triangle};
inline const std::vector<Simplex> tetrahedron_only{Simplex::tetrahedron};
inline const std::vector<Simplex> solid{Simplex::triangle, Simplex::tetrahedron};  ///< of full dimension
inline const std::vector<Simplex> sided{Simplex::triangle, Simplex::triangle3d, Simplex::tetrahedron};

}  // namespace barycert::audit

// Families whose simplices come from a mesh: what a kernel meets in use.

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

using Source = Draw (*)(const MeshSource& meshes, Simplex s, base::Random& random);
using Step = void (*)(Draw& draw, base::Random& random);
/// A recipe: a simplex from a mesh, then step after step.
template <Source source, Step... steps>
Draw drawn(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = source(meshes, s, random);
    (steps(draw, random), ...);
    return draw;
}

// Faces of dimension n - 1: the first n vertices after a random one has been put last, and so on.
void shuffle(Draw& draw, base::Random& random) {
    const int n = vertex_count(draw.simplex.simplex);
    for (int i = n - 1; i > 0; --i)
        std::swap(draw.nodes[random.below(static_cast<std::uint64_t>(i) + 1)], draw.nodes[static_cast<std::size_t>(i)]);
    draw = draw_of_nodes(*draw.from, draw.cell, draw.nodes, draw.simplex.simplex, random);
}

void nudge(Draw& draw, base::Random& random) {
    Case& c = draw.simplex;
    const auto axis = static_cast<std::size_t>(random.below(static_cast<std::uint64_t>(space_dimension(c.simplex))));
    move_by_ulp(c, c.point[axis], static_cast<int>(axis), random);
}

/// In the face of all vertices but the last so many.
template <int fewer>
void point_in_face(Draw& draw, base::Random& random) {
    draw.simplex.point = random_point(draw.simplex, random, vertex_count(draw.simplex.simplex) - fewer);
}

/// On the edge of the first two vertices, or at the first one.
template <int vertices>
void point_on_first(Draw& draw, base::Random& random) {
    draw.simplex.point = random_point(draw.simplex, random, vertices);
}

void point_at_centroid(Draw& draw, base::Random&) {
    const int n = vertex_count(draw.simplex.simplex);
    draw.simplex.point = combination(draw.simplex, {1, 1, 1, 1}, n);
    for (double& x : draw.simplex.point) x /= n;
}

/// From the hull's facet outwards, away from the vertex that the facet leaves out.
void step_outwards(Draw& draw, base::Random& random) {
    Case& c = draw.simplex;
    const double step = random.scaled(0.5, 1, -50, -4);
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        double& x = c.point[static_cast<std::size_t>(axis)];
        x += step * (x - c.vertex(vertex_count(c.simplex) - 1, axis));
    }
}

void point_far_away(Draw& draw, base::Random& random) {
    const double reach = std::ldexp(1, random.integer(1, 20));
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(space_dimension(draw.simplex.simplex)); ++axis) {
        const double low = draw.from->box[axis].low, size = draw.from->box[axis].high - low;
        draw.simplex.point[axis] = low + size * random.uniform(-reach, reach);
    }
}

/// The cell across a random facet; the drawn one's own where there is no neighbour.
Case neighbour_cell(const Draw& draw, base::Random& random) {
    const auto corners = draw.from->mesh.corners();
    const auto cell = static_cast<std::size_t>(draw.cell);
    const auto other = draw.from->neighbours[cell * corners + random.below(corners)];
    return draw_of_cell(*draw.from, other < 0 ? draw.cell : other, random).simplex;
}

void point_in_neighbour(Draw& draw, base::Random& random) {
    const Case other = neighbour_cell(draw, random);
    draw.simplex.point = random_point(other, random, vertex_count(other.simplex));
}

void vertex_of_neighbour(Draw& draw, base::Random& random) {
    const Case other = neighbour_cell(draw, random);
    const auto i = static_cast<int>(random.below(static_cast<std::uint64_t>(vertex_count(other.simplex))));
    draw.simplex.point = vertex_at(other, i);
}

}  // namespace

std::vector<Family> mesh_families() {
    return {
        {"mesh.inside", "ordinary points inside a cell: what most users compute",
         "fl(sum w_i v_i), w even over the simplex", every, nullptr, drawn<draw_any, point_in_face<0>>},
        {"mesh.centroids", "points whose exact weights are almost equal", "fl(fl(sum v_i) / n)", every, nullptr,
         drawn<draw_any, point_at_centroid>},
        {"mesh.faces", "points computed on a face: after rounding most are beside it",
         "fl(sum w_i v_i) over three vertices", tetrahedron_only, nullptr, drawn<draw_any, shuffle, point_in_face<1>>},
        {"mesh.edges", "points computed on an edge", "fl(w_0 v_0 + w_1 v_1)", sided, nullptr,
         drawn<draw_any, shuffle, point_on_first<2>>},
        {"mesh.vertices", "vertices: all weights but one are exactly zero", "the vertex itself", every, nullptr,
         drawn<draw_any, shuffle, point_on_first<1>>},
        {"mesh.faces.ulp", "points one ulp off a face", "mesh.faces, one coordinate moved by one ulp", tetrahedron_only,
         nullptr, drawn<draw_any, shuffle, point_in_face<1>, nudge>},
        {"mesh.edges.ulp", "points one ulp off an edge", "mesh.edges, one coordinate moved by one ulp", sided, nullptr,
         drawn<draw_any, shuffle, point_on_first<2>, nudge>},
        {"mesh.vertices.ulp", "points one ulp off a vertex", "mesh.vertices, one coordinate moved by one ulp", every,
         nullptr, drawn<draw_any, shuffle, point_on_first<1>, nudge>},
        {"mesh.hull.near", "points just outside the mesh", "from the hull outwards by 2^-50 to 2^-4 of the height",
         solid, nullptr, drawn<draw_at_hull, point_in_face<1>, step_outwards>},
        {"mesh.hull.far", "points far outside: large weights that cancel", "up to 2^20 bounding boxes away", solid,
         nullptr, drawn<draw_at_hull, point_far_away>},
        {"mesh.neighbours", "points of a neighbouring cell", "fl(sum w_i v_i) of a neighbouring cell", every, nullptr,
         drawn<draw_any, point_in_neighbour>},
        {"mesh.neighbours.vertices", "vertices of a neighbouring cell: exact zeros, and points clearly outside",
         "a vertex of a neighbouring cell", every, nullptr, drawn<draw_any, vertex_of_neighbour>},
    };
}

}  // namespace barycert::audit

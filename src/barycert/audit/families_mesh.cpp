// Families whose simplices come from a mesh: what a kernel meets in use.

#include <algorithm>
#include <cmath>

#include "barycert/audit/combine.hpp"
#include "barycert/audit/mesh_draws.hpp"
#include "barycert/audit/recipes.hpp"

namespace barycert::audit {
namespace {

// Faces of dimension n - 1: the first n vertices after a random one has been put last, and so on.
void shuffle_vertices(Draw& draw, base::Random& random) {
    const int n = vertex_count(draw.simplex.simplex);
    for (int i = n - 1; i > 0; --i) {
        std::swap(draw.nodes[random.below(static_cast<std::uint64_t>(i) + 1)], draw.nodes[static_cast<std::size_t>(i)]);
    }
    draw = draw_of_nodes(*draw.from, draw.cell, draw.nodes, draw.simplex.simplex, random);
}

Draw shuffled(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = draw_any(meshes, s, random);
    shuffle_vertices(draw, random);
    return draw;
}

Draw nudged(Draw draw, base::Random& random) {
    Case& c = draw.simplex;
    const auto axis = static_cast<std::size_t>(random.below(static_cast<std::uint64_t>(space_dimension(c.simplex))));
    move_by_ulp(c, c.point[axis], static_cast<int>(axis), random);
    return draw;
}

Draw inside(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = draw_any(meshes, s, random);
    draw.simplex.point = random_point(draw.simplex, random, vertex_count(s));
    return draw;
}

Draw centroids(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = draw_any(meshes, s, random);
    const int n = vertex_count(s);
    draw.simplex.point = combination(draw.simplex, {1, 1, 1, 1}, n);
    for (double& x : draw.simplex.point) x /= n;
    return draw;
}

Draw facets(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = shuffled(random, meshes, s);
    draw.simplex.point = random_point(draw.simplex, random, vertex_count(s) - 1);
    return draw;
}

Draw edges(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = shuffled(random, meshes, s);
    draw.simplex.point = random_point(draw.simplex, random, 2);
    return draw;
}

Draw vertices(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = shuffled(random, meshes, s);
    draw.simplex.point = combination(draw.simplex, {1, 0, 0, 0}, 1);
    return draw;
}

Draw facets_nudged(base::Random& random, const MeshSource& meshes, Simplex s) {
    return nudged(facets(random, meshes, s), random);
}

Draw edges_nudged(base::Random& random, const MeshSource& meshes, Simplex s) {
    return nudged(edges(random, meshes, s), random);
}

Draw vertices_nudged(base::Random& random, const MeshSource& meshes, Simplex s) {
    return nudged(vertices(random, meshes, s), random);
}

// From a point of the hull's facet outwards, away from the vertex that the facet leaves out.
Draw hull_near(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = draw_at_hull(meshes, s, random);
    Case& c = draw.simplex;
    const int n = vertex_count(s);
    c.point = random_point(c, random, n - 1);
    const double step = random.scaled(0.5, 1, -50, -4);
    for (int axis = 0; axis < space_dimension(s); ++axis) {
        double& x = c.point[static_cast<std::size_t>(axis)];
        x += step * (x - c.vertex(n - 1, axis));
    }
    return draw;
}

Draw hull_far(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = draw_at_hull(meshes, s, random);
    const double reach = std::ldexp(1, random.integer(1, 20));
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(space_dimension(s)); ++axis) {
        const double low = draw.from->low[axis], size = draw.from->high[axis] - low;
        draw.simplex.point[axis] = low + size * random.uniform(-reach, reach);
    }
    return draw;
}

// A point of the cell across a random facet; the cell's own where there is no neighbour.
Draw neighbour_cell(const Draw& draw, base::Random& random) {
    const auto corners = draw.from->mesh.corners();
    const auto cell = static_cast<std::size_t>(draw.cell);
    const auto other = draw.from->neighbours[cell * corners + random.below(corners)];
    const auto chosen = other < 0 ? cell : static_cast<std::size_t>(other);
    std::array<Mesh::Index, 4> nodes{};
    for (std::size_t i = 0; i < corners; ++i) nodes[i] = draw.from->mesh.cells[chosen * corners + i];
    const Simplex whole = draw.from->mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron;
    return draw_of_nodes(*draw.from, static_cast<Mesh::Index>(chosen), nodes, whole, random);
}

Draw neighbour_points(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = draw_any(meshes, s, random);
    const Case other = neighbour_cell(draw, random).simplex;
    draw.simplex.point = random_point(other, random, vertex_count(other.simplex));
    return draw;
}

Draw neighbour_vertices(base::Random& random, const MeshSource& meshes, Simplex s) {
    Draw draw = draw_any(meshes, s, random);
    const Case other = neighbour_cell(draw, random).simplex;
    const auto i = static_cast<int>(random.below(static_cast<std::uint64_t>(vertex_count(other.simplex))));
    for (int axis = 0; axis < space_dimension(s); ++axis)
        draw.simplex.point[static_cast<std::size_t>(axis)] = other.vertex(i, axis);
    return draw;
}

Family family(const char* name, const char* tests, const char* parameters, Family::MeshRecipe recipe,
              std::vector<Simplex> simplices) {
    Family f;
    f.name = std::string("mesh.") + name;
    f.tests = tests;
    f.parameters = parameters;
    f.needs_mesh = true;
    f.simplices = std::move(simplices);
    f.mesh_recipe = recipe;
    return f;
}

}  // namespace

std::vector<Family> mesh_families() {
    const std::vector<Simplex> all(all_simplices.begin(), all_simplices.end());
    const std::vector<Simplex> faced{Simplex::tetrahedron};
    const std::vector<Simplex> edged{Simplex::triangle, Simplex::triangle3d, Simplex::tetrahedron};
    return {
        family("inside", "ordinary points inside a cell: what most users compute",
               "fl(sum w_i v_i), w even over the simplex", inside, all),
        family("centroids", "points whose exact weights are almost equal", "fl(fl(sum v_i) / n)", centroids, all),
        family("faces", "points computed on a face: after rounding most are beside it",
               "fl(sum w_i v_i) over three vertices", facets, faced),
        family("edges", "points computed on an edge", "fl(w_0 v_0 + w_1 v_1)", edges, edged),
        family("vertices", "vertices: all weights but one are exactly zero", "the vertex itself", vertices, all),
        family("faces.ulp", "points one ulp off a face", "mesh.faces, one coordinate moved by one ulp", facets_nudged,
               faced),
        family("edges.ulp", "points one ulp off an edge", "mesh.edges, one coordinate moved by one ulp", edges_nudged,
               edged),
        family("vertices.ulp", "points one ulp off a vertex", "mesh.vertices, one coordinate moved by one ulp",
               vertices_nudged, all),
        family("hull.near", "points just outside the mesh", "from the hull outwards by 2^-50 to 2^-4 of the height",
               hull_near, {Simplex::triangle, Simplex::tetrahedron}),
        family("hull.far", "points far outside: large weights that cancel", "up to 2^20 bounding boxes away", hull_far,
               {Simplex::triangle, Simplex::tetrahedron}),
        family("neighbours", "points of a neighbouring cell", "fl(sum w_i v_i) of a neighbouring cell",
               neighbour_points, all),
        family("neighbours.vertices", "vertices of a neighbouring cell: exact zeros, and points clearly outside",
               "a vertex of a neighbouring cell", neighbour_vertices, all),
    };
}

}  // namespace barycert::audit

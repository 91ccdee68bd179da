#include "tests/mesh/check/defects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/adjacency.hpp"
#include "tests/mesh/check/signs.hpp"

namespace barycert::testing {
namespace {

using Index = Mesh::Index;
using P = DefectKind;

constexpr DefectSet pinched = set_of(P::pinched_ridge, P::pinched_node);
constexpr DefectSet gone = set_of(P::unused_node, P::missing_cell) | pinched;  // as if the cell were not there
constexpr DefectSet overlap = set_of(P::overlapping_cells);

Index& corner(const Site& s, std::size_t cell, std::size_t i) {
    return s.mesh.cells[cell * s.mesh.corners() + i];
}

std::size_t any_corner(const Site& s, base::Random& random) {
    return random.below(s.mesh.corners());
}

void add_cell(const Site& s, const std::vector<Index>& nodes) {
    s.mesh.cells.insert(s.mesh.cells.end(), nodes.begin(), nodes.end());
    if (!s.mesh.neighbours.empty()) s.mesh.neighbours.insert(s.mesh.neighbours.end(), nodes.size(), -1);
}

std::vector<Index> nodes_of(const Site& s, std::size_t cell) {
    std::vector<Index> nodes;
    for (std::size_t i = 0; i < s.mesh.corners(); ++i) nodes.push_back(corner(s, cell, i));
    return nodes;
}

bool in_range(const Site& s, std::size_t cell) {
    const auto nodes = nodes_of(s, cell);
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](Index n) { return n >= 0 && static_cast<std::size_t>(n) < s.mesh.point_count(); });
}

/// Another one than those that a defect planted before gave a wild index.
std::size_t any_cell(const Site& s, base::Random& random) {
    while (true) {
        const std::size_t c = s.first_cell + random.below(s.cells);
        if (in_range(s, c)) return c;
    }
}

std::vector<std::size_t> cells_at(const Site& s, Index node) {
    std::vector<std::size_t> cells;
    for (std::size_t c = s.first_cell; c < s.first_cell + s.cells; ++c) {
        if (!in_range(s, c)) continue;
        const auto n = nodes_of(s, c);
        if (std::find(n.begin(), n.end(), node) != n.end()) cells.push_back(c);
    }
    return cells;
}

double& coordinate(const Site& s, Index node, std::size_t axis) {
    return s.mesh.points[static_cast<std::size_t>(node * s.mesh.dimension) + axis];
}

/// Not on the surface of the box: from 1 to side - 1 along all axes.
Index inner_node(const Site& s, base::Random& random) {
    std::size_t at = 0, stride = 1;
    for (int k = 0; k < s.mesh.dimension; ++k, stride *= site_side + 1)
        at += stride * static_cast<std::size_t>(random.integer(1, site_side - 1));
    return static_cast<Index>(s.first_node + at);
}

template <Index value>
void wild_index(const Site& s, base::Random& random) {
    corner(s, any_cell(s, random), any_corner(s, random)) = value;
}

void index_past_the_end(const Site& s, base::Random& random) {  // and past all that may be added
    corner(s, any_cell(s, random), any_corner(s, random)) = static_cast<Index>(s.mesh.point_count()) + 1000;
}

template <int which>
void not_finite(const Site& s, base::Random& random) {
    const double values[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};
    coordinate(s, static_cast<Index>(s.any_node(random)), random.below(static_cast<std::size_t>(s.mesh.dimension))) =
        values[which];
}

void repeated_node(const Site& s, base::Random& random) {
    const std::size_t c = any_cell(s, random), i = any_corner(s, random);
    corner(s, c, i) = corner(s, c, (i + 1) % s.mesh.corners());
}

/// A further cell whose new corner lies on the line of two others.
void flat_cell(const Site& s, base::Random& random) {
    auto nodes = nodes_of(s, any_cell(s, random));
    auto at = node_at(s.mesh, nodes[1]);
    const auto other = node_at(s.mesh, nodes[2]);
    for (std::size_t k = 0; k < at.size(); ++k) at[k] = at[k] / 2 + other[k] / 2;
    nodes[0] = add_node(s.mesh, at);
    add_cell(s, nodes);
}

/// A further cell, apart from all, along a line; or with all corners in one point.
template <int step>
void cell_on_a_line(const Site& s, base::Random& random) {
    std::vector<Index> nodes;
    std::vector<double> at = node_at(s.mesh, static_cast<Index>(s.first_node));
    at[0] -= 5;
    for (std::size_t i = 0; i < s.mesh.corners(); ++i) {
        for (double& x : at) x -= step * (0.25 + static_cast<double>(i));
        if (step != 0) at[1] = at[0] * 2;
        nodes.push_back(add_node(s.mesh, at));
    }
    std::swap(nodes[0], nodes[random.below(nodes.size())]);
    add_cell(s, nodes);
}

template <bool permuted>
void duplicate(const Site& s, base::Random& random) {
    auto nodes = nodes_of(s, any_cell(s, random));
    if (permuted) {
        for (std::size_t i = nodes.size(); i > 1; --i) std::swap(nodes[i - 1], nodes[random.below(i)]);
    }
    add_cell(s, nodes);
}

void third_at_a_facet(const Site& s, base::Random& random) {
    // Takes a cell at an inner node: the facet opposite to another of its nodes is an inner one.
    const Index inner = inner_node(s, random);
    const auto star = cells_at(s, inner);
    auto nodes = nodes_of(s, star[random.below(star.size())]);
    const std::size_t i = nodes[0] == inner ? 1 : 0;
    nodes[i] = add_node(s.mesh, in_cell(s.mesh, star[0], {0.3, 0.25, 0.3, 0.15}));
    add_cell(s, nodes);
}

void node_through_a_facet(const Site& s, base::Random& random) {
    const Index node = inner_node(s, random);
    const auto star = cells_at(s, node);
    const auto nodes = nodes_of(s, star[random.below(star.size())]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(s.mesh.dimension); ++k) {
        double mean = 0;
        for (const Index n : nodes) mean += n == node ? 0 : coordinate(s, n, k) / s.mesh.dimension;
        coordinate(s, node, k) += 1.37 * (mean - coordinate(s, node, k)) + random.uniform(-0.01, 0.01);
    }
}

/// Cells of the box on one side of an inner node get a copy of it.
void crack(const Site& s, base::Random& random) {
    const Index node = inner_node(s, random), copy = add_node(s.mesh, node_at(s.mesh, node));
    const auto axis = random.below(static_cast<std::size_t>(s.mesh.dimension));
    for (const std::size_t c : cells_at(s, node)) {
        double max = -std::numeric_limits<double>::infinity();
        for (const Index n : nodes_of(s, c)) max = std::max(max, coordinate(s, n, axis));
        if (max <= coordinate(s, node, axis)) continue;
        for (std::size_t i = 0; i < s.mesh.corners(); ++i) {
            if (corner(s, c, i) == node) corner(s, c, i) = copy;
        }
    }
}

void copy_of_all(const Site& s, std::vector<double> shift) {
    const auto first = static_cast<Index>(s.mesh.point_count());
    for (std::size_t n = 0; n < s.nodes; ++n) {
        auto at = node_at(s.mesh, static_cast<Index>(s.first_node + n));
        for (std::size_t k = 0; k < at.size(); ++k) at[k] += shift[k];
        add_node(s.mesh, at);
    }
    for (std::size_t c = s.first_cell; c < s.first_cell + s.cells; ++c) {
        auto nodes = nodes_of(s, c);
        for (Index& n : nodes) n = in_range(s, c) ? n + first - static_cast<Index>(s.first_node) : -1;
        add_cell(s, nodes);
    }
}

void overlapping_copy(const Site& s, base::Random& random) {
    copy_of_all(s, {random.uniform(-2, 2), random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)});
}

void same_copy(const Site& s, base::Random&) {
    copy_of_all(s, {0, 0, 0});
}

void touching_copy(const Site& s, base::Random& random) {
    copy_of_all(s, {random.coin() ? s.width : -s.width, 0, 0});
}

/// One cell cut in two through the middle of an edge between inner facets; its neighbours are left as they are.
void hanging_node(const Site& s, base::Random& random) {
    const Index inner = inner_node(s, random);
    const auto star = cells_at(s, inner);
    const std::size_t c = star[random.below(star.size())];
    auto nodes = nodes_of(s, c);
    std::swap(nodes[0], *std::find(nodes.begin(), nodes.end(), inner));
    auto at = node_at(s.mesh, nodes[0]);
    const auto other = node_at(s.mesh, nodes[1]);
    for (std::size_t k = 0; k < at.size(); ++k) at[k] = at[k] / 2 + other[k] / 2;
    const Index middle = add_node(s.mesh, at);
    auto half = nodes;
    half[0] = middle;
    add_cell(s, half);
    for (std::size_t i = 0; i < nodes.size(); ++i) corner(s, c, i) = i == 1 ? middle : nodes[i];
}

/// A small cell about a point; `apex` >= 0: with that node for its first corner.
void small_cell(const Site& s, const std::vector<double>& about, Index apex, base::Random& random) {
    std::vector<Index> nodes;
    for (std::size_t i = 0; i < s.mesh.corners(); ++i) {
        auto at = about;
        for (std::size_t k = 0; k < at.size(); ++k) at[k] += (i == k + 1 ? 0.01 : -0.004) + random.uniform(-1e-3, 1e-3);
        nodes.push_back(i == 0 && apex >= 0 ? apex : add_node(s.mesh, at));
    }
    add_cell(s, nodes);
}

void nested_in_one(const Site& s, base::Random& random) {
    small_cell(s, in_cell(s.mesh, any_cell(s, random), {0.3, 0.3, s.mesh.dimension == 2 ? 0.4 : 0.2, 0.2}), -1, random);
}

void nested_in_several(const Site& s, base::Random& random) {
    small_cell(s, node_at(s.mesh, inner_node(s, random)), -1, random);
}

void nested_at_a_node(const Site& s, base::Random& random) {
    const std::size_t c = any_cell(s, random);
    small_cell(s, in_cell(s.mesh, c, {0.3, 0.3, s.mesh.dimension == 2 ? 0.4 : 0.2, 0.2}), corner(s, c, 0), random);
}

/// All cells at an inner node a second time, at a node of their own.
template <bool moved>
void star_twice(const Site& s, base::Random& random) {
    const Index node = inner_node(s, random);
    auto at = node_at(s.mesh, node);
    for (double& x : at) x += moved ? random.uniform(-0.1, 0.1) : 0;
    const Index copy = add_node(s.mesh, at);
    for (const std::size_t c : cells_at(s, node)) {
        auto nodes = nodes_of(s, c);
        std::replace(nodes.begin(), nodes.end(), node, copy);
        add_cell(s, nodes);
    }
}

void wrong_neighbour(const Site& s, base::Random& random) {
    Index& n = s.mesh.neighbours[any_cell(s, random) * s.mesh.corners() + any_corner(s, random)];
    const Index wild[] = {-1, 0, 5, std::numeric_limits<Index>::max(), std::numeric_limits<Index>::min()};
    const Index before = n;
    while (n == before) n = wild[random.below(std::size(wild))];
}

void wrong_face(const Site& s, base::Random& random) {
    Index& n = s.mesh.faces[random.below(s.mesh.faces.size())];
    n = random.coin() ? -1 : n + 1000000;
}

void unused(const Site& s, base::Random& random) {
    std::vector<double> at(static_cast<std::size_t>(s.mesh.dimension), -7);
    at[0] = random.unit();
    add_node(s.mesh, at);
}

void coincident_unused(const Site& s, base::Random& random) {
    add_node(s.mesh, node_at(s.mesh, static_cast<Index>(s.any_node(random))));
}

void flipped(const Site& s, base::Random& random) {
    const std::size_t c = any_cell(s, random);
    std::swap(corner(s, c, 0), corner(s, c, 1 + random.below(2)));
}

/// A cell along the diagonal, apart from all, too thin for plain double.
void thin_cell(const Site& s, base::Random& random) {
    const double x = node_at(s.mesh, static_cast<Index>(s.first_node))[0] - 8;
    Mesh one;
    one.dimension = s.mesh.dimension;
    for (int i = 0; i <= one.dimension; ++i) one.cells.push_back(i);
    do {
        one.points.clear();
        for (int i = 0; i <= one.dimension; ++i) {
            const double t = x + random.unit();
            const double y = random.coin() ? std::nextafter(t, 1e9) : random.coin() ? std::nextafter(t, -1e9) : t;
            one.points.insert(one.points.end(), {t, y});
            if (one.dimension == 3) one.points.push_back(x + random.unit());
        }
    } while (exact_sign(one, 0) == 0 || exact_sign(one, 0) == plain_sign(one, 0));
    std::vector<Index> nodes;
    for (Index i = 0; i <= one.dimension; ++i) nodes.push_back(add_node(s.mesh, node_at(one, i)));
    add_cell(s, nodes);
}

}  // namespace

constexpr DefectSet doubled = set_of(P::same_side, P::overfull_facet, P::open_boundary, P::boundary_contact,
                                     P::nested_part, P::mixed_orientation, P::hanging_node, P::crack) |
                              pinched;

const std::vector<PlantedDefect> defects{
    {"index -1", set_of(P::index_out_of_range), gone, wild_index<-1>},
    {"index past the end", set_of(P::index_out_of_range), gone, index_past_the_end},
    {"largest index", set_of(P::index_out_of_range), gone, wild_index<std::numeric_limits<Index>::max()>},
    {"least index", set_of(P::index_out_of_range), gone, wild_index<std::numeric_limits<Index>::min()>},
    {"NaN", set_of(P::not_finite), gone, not_finite<0>},
    {"infinity", set_of(P::not_finite), gone, not_finite<1>},
    {"minus infinity", set_of(P::not_finite), gone, not_finite<2>},
    {"repeated node", set_of(P::repeated_node), gone, repeated_node},
    {"flat cell", set_of(P::degenerate_cell), doubled | overlap, flat_cell},
    {"cell on a line", set_of(P::degenerate_cell), set_of(P::plain_sign_wrong, P::boundary_contact, P::hanging_node),
     cell_on_a_line<1>},
    {"cell in a point", set_of(P::degenerate_cell, P::coincident_nodes), 0, cell_on_a_line<0>},
    {"duplicate", set_of(P::duplicate_cell) | overlap, doubled, duplicate<false>},
    {"duplicate, permuted", set_of(P::duplicate_cell) | overlap, doubled, duplicate<true>},
    {"third cell at a facet", set_of(P::overfull_facet) | overlap, doubled, third_at_a_facet},
    {"node through a facet", set_of(P::same_side) | overlap, doubled, node_through_a_facet},
    {"crack", set_of(P::boundary_contact, P::coincident_nodes, P::crack), pinched, crack},
    {"overlapping copy", set_of(P::boundary_contact) | overlap, set_of(P::nested_part), overlapping_copy},
    {"copy in the same place", set_of(P::boundary_contact, P::coincident_nodes, P::crack) | overlap,
     set_of(P::nested_part), same_copy},
    {"touching copy", set_of(P::boundary_contact, P::coincident_nodes, P::crack), 0, touching_copy},
    {"hanging node", set_of(P::boundary_contact, P::hanging_node), set_of(P::mixed_orientation) | pinched,
     hanging_node},
    {"nested in one cell", set_of(P::nested_part) | overlap, set_of(P::mixed_orientation), nested_in_one},
    {"nested in several cells", set_of(P::nested_part) | overlap, set_of(P::mixed_orientation), nested_in_several},
    {"nested at a common node", set_of(P::nested_part) | overlap, doubled, nested_at_a_node},
    {"star twice", overlap, doubled, star_twice<true>},
    {"star twice in the same place", set_of(P::coincident_nodes) | overlap, doubled, star_twice<false>},
    {"wrong neighbour", set_of(P::wrong_neighbour), 0, wrong_neighbour},
    {"wrong face", set_of(P::wrong_face), 0, wrong_face, true},
    {"unused node", set_of(P::unused_node), 0, unused},
    {"unused node at the place of another", set_of(P::unused_node, P::coincident_nodes), 0, coincident_unused},
    {"flipped cell", set_of(P::mixed_orientation), 0, flipped},
    {"thin cell", set_of(P::plain_sign_wrong), set_of(P::mixed_orientation), thin_cell},
};

bool harmless(const PlantedDefect& defect) {
    for (const auto& t : defect_texts) {
        if (t.breaks && (defect.must & defect_bit(t.kind)) != 0) return false;
    }
    return true;
}

Mesh mesh_of_sites(int d, int sites) {
    Mesh mesh;
    mesh.dimension = d;
    for (int i = 0; i < sites; ++i)
        mesh = joined(std::move(mesh), mapped(box(d, {site_side, site_side, site_side}), {1, 1, 1}, {40.0 * i, 0, 0}));
    mesh.neighbours = mesh::compute_neighbours(mesh);
    for (std::size_t c = 0; d == 3 && c < mesh.cell_count(); c += 7)
        mesh.faces.insert(mesh.faces.end(), &mesh.cells[c * 4 + 1], &mesh.cells[c * 4 + 1] + 3);
    return mesh;
}

Site site_of(Mesh& mesh, int sites, int index) {
    const std::size_t nodes = mesh.point_count() / static_cast<std::size_t>(sites),
                      cells = mesh.cell_count() / static_cast<std::size_t>(sites), i = static_cast<std::size_t>(index);
    return {mesh, i * nodes, nodes, i * cells, cells, site_side};
}

}  // namespace barycert::testing

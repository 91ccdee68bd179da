#include "mesh/adjacency.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace barycert {
namespace {

using Indices = std::vector<Mesh::Index>;

/// The definition, word for word, in quadratic time.
Indices slow_neighbours(const Mesh& mesh) {
    const std::size_t corners = mesh.corners();
    const auto nodes = [&](std::size_t place) {
        std::multiset<Mesh::Index> set;
        for (std::size_t i = 0; i < corners; ++i) {
            if (i != place % corners) set.insert(mesh.cells[place / corners * corners + i]);
        }
        return set;
    };
    Indices result(mesh.cells.size(), -1);
    for (std::size_t a = 0; a < mesh.cells.size(); ++a) {
        std::vector<std::size_t> holders;  // the facets equal to a, ascending, one a cell
        for (std::size_t b = 0; b < mesh.cells.size(); ++b) {
            if (nodes(a) == nodes(b) && (holders.empty() || holders.back() / corners != b / corners))
                holders.push_back(b);
        }
        if (holders.size() < 2) continue;
        if (a == holders[0]) result[a] = static_cast<Mesh::Index>(holders[1] / corners);
        if (a == holders[1]) result[a] = static_cast<Mesh::Index>(holders[0] / corners);
    }
    return result;
}

Mesh mesh_of(int dimension, std::size_t nodes, Indices cells) {
    Mesh mesh;
    mesh.dimension = dimension;
    mesh.points.assign(nodes * static_cast<std::size_t>(dimension), 0.0);
    mesh.cells = std::move(cells);
    return mesh;
}

TEST(Adjacency, TwoTetrahedra) {
    const Mesh mesh = mesh_of(3, 5, {0, 1, 2, 3, 4, 3, 2, 1});
    const Indices neighbours = mesh::compute_neighbours(mesh);
    EXPECT_EQ(neighbours, (Indices{1, -1, -1, -1, 0, -1, -1, -1}));
    EXPECT_EQ(mesh::hull_facets(mesh, neighbours), (std::vector<std::int64_t>{1, 2, 3, 5, 6, 7}));
}

TEST(Adjacency, TwoTriangles) {
    const Mesh mesh = mesh_of(2, 4, {0, 1, 2, 3, 2, 1});
    EXPECT_EQ(mesh::compute_neighbours(mesh), (Indices{1, -1, -1, 0, -1, -1}));
}

TEST(Adjacency, OfThreeCellsAtAFacetTheLowestTwoAreNeighbours) {
    const Mesh mesh = mesh_of(3, 6, {3, 0, 1, 2, 0, 1, 2, 4, 2, 1, 0, 5});
    EXPECT_EQ(mesh::compute_neighbours(mesh), (Indices{1, -1, -1, -1, -1, -1, -1, 0, -1, -1, -1, -1}));
}

TEST(Adjacency, ACellIsNotItsOwnNeighbour) {
    const Mesh mesh = mesh_of(3, 4, {0, 0, 1, 2});  // the facets opposite to both corners 0 are 0 1 2
    EXPECT_EQ(mesh::compute_neighbours(mesh), Indices(4, -1));
}

TEST(Adjacency, Empty) {
    const Mesh mesh = mesh_of(3, 0, {});
    EXPECT_TRUE(mesh::compute_neighbours(mesh).empty());
    EXPECT_TRUE(mesh::hull_facets(mesh, {}).empty());
}

TEST(Adjacency, AsTheDefinitionSays) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        base::Random random = base::Random::stream(1, seed, 0);
        const int dimension = random.integer(2, 3);
        const auto nodes = static_cast<std::size_t>(random.integer(dimension + 1, 8));  // few: facets are often shared
        Indices cells(static_cast<std::size_t>(random.integer(1, 12) * (dimension + 1)));
        for (Mesh::Index& corner : cells) corner = static_cast<Mesh::Index>(random.below(nodes));
        const Mesh mesh = mesh_of(dimension, nodes, std::move(cells));
        EXPECT_EQ(mesh::compute_neighbours(mesh), slow_neighbours(mesh)) << "seed " << seed;
    }
}

}  // namespace
}  // namespace barycert

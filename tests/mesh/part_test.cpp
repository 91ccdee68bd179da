#include "mesh/part.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace barycert::mesh {
namespace {

/// Cells of random nodes, quadratic ones if `quadratic`; some nodes belong to none.
Mesh random_mesh(int dimension, bool quadratic, base::Random& random) {
    Mesh mesh;
    mesh.dimension = dimension;
    const std::size_t nodes = 200, cells = 150, corners = static_cast<std::size_t>(dimension) + 1;
    for (std::size_t i = 0; i < nodes * static_cast<std::size_t>(dimension); ++i)
        mesh.points.push_back(random.uniform(-1, 1));
    const auto node = [&] { return static_cast<Mesh::Index>(random.below(nodes)); };
    for (std::size_t i = 0; i < cells * corners; ++i) mesh.cells.push_back(node());
    for (std::size_t i = 0; quadratic && i < cells * (dimension == 2 ? 3 : 6); ++i) mesh.mid_nodes.push_back(node());
    return mesh;
}

TEST(Submesh, HasTheCellsTheirNodesAndTheirValues) {
    base::Random random(5);
    for (int round = 0; round < 200; ++round) {
        const int d = 2 + static_cast<int>(random.below(2));
        const Mesh mesh = random_mesh(d, random.below(2) == 0, random);
        const Field of_nodes{"n", 2, [&] {
                                 std::vector<double> v(2 * mesh.point_count());
                                 for (double& x : v) x = random.uniform(0, 1);
                                 return v;
                             }()};
        Field of_cells{"c", 1, {}};
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) of_cells.data.push_back(random.uniform(0, 1));
        std::vector<Mesh::Index> cells;
        const std::uint64_t one_in = 1 + random.below(20);
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
            if (random.below(one_in) == 0) cells.push_back(static_cast<Mesh::Index>(c));
        }
        const Submesh part = part_of(mesh, cells);
        ASSERT_EQ(part.cells, cells);
        ASSERT_EQ(part.mesh.cell_count(), cells.size());
        ASSERT_EQ(part.mesh.point_count(), part.nodes.size());
        ASSERT_TRUE(std::is_sorted(part.nodes.begin(), part.nodes.end()));
        const Field nodal = rows_of(of_nodes, part.nodes), cellular = rows_of(of_cells, part.cells);
        std::vector<bool> used(part.nodes.size(), false);
        const auto expect_same = [&](Mesh::Index of_part, Mesh::Index whole) {
            const auto here = static_cast<std::size_t>(of_part), there = static_cast<std::size_t>(whole);
            used.at(here) = true;
            ASSERT_EQ(part.nodes.at(here), whole);
            for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k)
                ASSERT_EQ(part.mesh.points[static_cast<std::size_t>(d) * here + k],
                          mesh.points[static_cast<std::size_t>(d) * there + k]);
            for (std::size_t k = 0; k < 2; ++k) ASSERT_EQ(nodal.data[2 * here + k], of_nodes.data[2 * there + k]);
        };
        const std::size_t mids = mesh.mid_nodes.size() / mesh.cell_count();
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const auto whole = static_cast<std::size_t>(cells[c]);
            for (std::size_t i = 0; i < mesh.corners(); ++i)
                expect_same(part.mesh.cells[mesh.corners() * c + i], mesh.cells[mesh.corners() * whole + i]);
            for (std::size_t i = 0; i < mids; ++i)
                expect_same(part.mesh.mid_nodes[mids * c + i], mesh.mid_nodes[mids * whole + i]);
            ASSERT_EQ(cellular.data[c], of_cells.data[whole]);
        }
        for (const bool u : used) ASSERT_TRUE(u) << "a node of no cell";
    }
}

}  // namespace
}  // namespace barycert::mesh

#include "mesh/mid_edges.hpp"

#include <gtest/gtest.h>

#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"

namespace barycert::testing {
namespace {

using Indices = std::vector<Mesh::Index>;

/// A 10-node tetrahedron whose mid-edge nodes 4.. stand on the edges 01 12 02 03 13 23, listed as `listed`.
Result<Mesh> read_tetrahedron(const std::string& listed) {
    return read_texts(
        "10 3\n0 0 0 0\n1 2 0 0\n2 0 2 0\n3 0 0 2\n4 1 0 0\n5 1 1 0\n6 0 1 0\n7 0 0 1\n8 1 0 1\n9 0 1 1\n",
        "1 10\n0 0 1 2 3 " + listed + "\n");
}

TEST(MidEdges, OrdersOfTetrahedra) {
    struct Row {
        const char* listed;
        MidEdgeOrder order;
    };
    for (const Row& row : {Row{"4 5 6 7 8 9", MidEdgeOrder::vtk}, Row{"9 7 4 5 8 6", MidEdgeOrder::tetgen15},
                           Row{"4 5 6 7 9 8", MidEdgeOrder::gmsh}}) {
        const Result<Mesh> mesh = read_tetrahedron(row.listed);
        ASSERT_TRUE(mesh) << mesh.error().message();
        EXPECT_EQ(mesh->mid_edge_order, row.order);
        EXPECT_EQ(mesh->cells, (Indices{0, 1, 2, 3}));
        EXPECT_EQ(mesh->mid_nodes, (Indices{4, 5, 6, 7, 8, 9}));
    }
}

TEST(MidEdges, AnUnknownOrderIsRefused) {
    expect_error(read_tetrahedron("5 4 6 7 8 9"), ".ele", 1, "the order of the mid-edge nodes is unknown", nullptr,
                 "another order in most cells", nullptr);
    expect_error(read_tetrahedron("4 5 6 8 7 9"), ".ele", 1, "the order of the mid-edge nodes is unknown", nullptr,
                 nullptr, nullptr);
}

TEST(MidEdges, OrdersOfTriangles) {
    const std::string node = "6 2\n1 0 0\n2 2 0\n3 0 2\n4 1 0\n5 1 1\n6 0 1\n";
    const Result<Mesh> vtk = read_texts(node, "1 6\n1 1 2 3 4 5 6\n");
    ASSERT_TRUE(vtk) << vtk.error().message();
    EXPECT_EQ(vtk->mid_edge_order, MidEdgeOrder::vtk);
    EXPECT_EQ(vtk->mid_nodes, (Indices{3, 4, 5}));
    const Result<Mesh> triangle = read_texts(node, "1 6\n1 1 2 3 5 6 4\n");
    ASSERT_TRUE(triangle) << triangle.error().message();
    EXPECT_EQ(triangle->mid_edge_order, MidEdgeOrder::triangle);
    EXPECT_EQ(triangle->mid_nodes, (Indices{3, 4, 5}));
    EXPECT_FALSE(read_texts(node, "1 6\n1 1 2 3 6 5 4\n"));
}

TEST(MidEdges, DegenerateCellsAbstain) {
    // All ten nodes of the second cell coincide; it says nothing and is brought into order with the rest.
    const Result<Mesh> mesh =
        read_texts("10 3\n0 0 0 0\n1 2 0 0\n2 0 2 0\n3 0 0 2\n4 1 0 0\n5 1 1 0\n6 0 1 0\n7 0 0 1\n8 1 0 1\n9 0 1 1\n",
                   "2 10\n0 0 1 2 3 9 7 4 5 8 6\n1 0 0 0 0 0 0 0 0 0 0\n");
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_EQ(mesh->mid_edge_order, MidEdgeOrder::tetgen15);
    const Result<Mesh> silent = read_texts("1 3\n0 0 0 0\n", "1 10\n0 0 0 0 0 0 0 0 0 0 0\n");
    ASSERT_TRUE(silent) << silent.error().message();
    EXPECT_EQ(silent->mid_edge_order, MidEdgeOrder::tetgen15);
    ASSERT_EQ(silent->notes.size(), 1U);  // a guess is told
    EXPECT_EQ(silent->notes.front().kind, Note::Kind::guessed);
}

TEST(MidEdges, FoundAtAnyScaleAndForCurvedCells) {
    for (const double scale : {1e-300, 1e-160, 1.0, 1e160, 8e307}) {
        for (const int dimension : {2, 3}) {
            for (const MidEdgeOrder order : orders_in(dimension)) {
                Mesh mesh = second_order_mesh(dimension, order, 50, 3, scale, 0.05);
                const Indices wanted = mesh.mid_nodes;
                // The nodes as a file of that order would list them.
                const auto sequence = mesh::edge_sequence(order, dimension);
                for (std::size_t i = 0; i < wanted.size(); ++i) {
                    mesh.mid_nodes[i] = wanted[i / sequence.size() * sequence.size() + sequence[i % sequence.size()]];
                }
                const auto vote = mesh::detect_mid_edge_order(mesh);
                ASSERT_TRUE(vote) << scale;
                EXPECT_TRUE(vote->order == order && !vote->guessed) << scale;
                mesh::normalise_mid_nodes(mesh);
                EXPECT_EQ(mesh.mid_nodes, wanted);
            }
        }
    }
}

// Where offsets are so unlike that squares would underflow, or halves of them would.
TEST(MidEdges, FoundInThinCellsAndAmongSubnormalNumbers) {
    const double tiny = std::numeric_limits<double>::denorm_min();
    for (const auto& [x, y] : {std::pair(1.0, 1e-170), {4 * tiny, 4 * tiny}, {1e300, 1e-300}}) {
        Mesh mesh;
        mesh.dimension = 2;
        mesh.points = {0, 0, x, 0, 0, y, x / 2, 0, x / 2, y / 2, 0, y / 2};
        mesh.cells = {0, 1, 2};
        mesh.mid_nodes = {3, 4, 5};
        auto vote = mesh::detect_mid_edge_order(mesh);
        ASSERT_TRUE(vote);
        EXPECT_TRUE(vote->order == MidEdgeOrder::vtk && !vote->guessed) << x;
        mesh.mid_nodes = {4, 5, 3};
        vote = mesh::detect_mid_edge_order(mesh);
        ASSERT_TRUE(vote);
        EXPECT_TRUE(vote->order == MidEdgeOrder::triangle && !vote->guessed) << x;
    }
}

}  // namespace
}  // namespace barycert::testing

// A copy with all cells positive: only the order of corners changes, and what depends on it.

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "mesh/adjacency.hpp"
#include "mesh/mid_edges.hpp"
#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"

namespace barycert::testing {
namespace {

using MidNodes = std::map<std::pair<Mesh::Index, Mesh::Index>, Mesh::Index>;

/// The node at the middle of each edge of a cell, by the nodes of the edge: independent of the order of corners.
MidNodes mid_nodes_of(const Mesh& mesh, std::size_t cell) {
    MidNodes nodes;
    if (mesh.mid_nodes.empty()) return nodes;
    const auto edges = mesh::edges_of(mesh.dimension);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const Mesh::Index* const corners = &mesh.cells[cell * mesh.corners()];
        const auto [low, high] = std::minmax(corners[edges[e][0]], corners[edges[e][1]]);
        nodes[{low, high}] = mesh.mid_nodes[cell * edges.size() + e];
    }
    return nodes;
}

/// The mesh with the corners of a random choice of cells in a random order.
Mesh shuffled(const Mesh& mesh, std::uint64_t seed) {
    base::Random random(seed);
    Mesh out = mesh;
    const std::size_t n = mesh.corners();
    const auto edges = mesh::edges_of(mesh.dimension);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        if (random.coin()) continue;
        MidNodes mids = mid_nodes_of(mesh, cell);
        for (std::size_t i = n - 1; i > 0; --i) {
            const std::size_t j = random.below(i + 1);
            std::swap(out.cells[cell * n + i], out.cells[cell * n + j]);
            if (!mesh.neighbours.empty()) std::swap(out.neighbours[cell * n + i], out.neighbours[cell * n + j]);
        }
        for (std::size_t e = 0; e < edges.size() && !mesh.mid_nodes.empty(); ++e) {
            const auto [low, high] = std::minmax(out.cells[cell * n + edges[e][0]], out.cells[cell * n + edges[e][1]]);
            out.mid_nodes[cell * edges.size() + e] = mids.at({low, high});
        }
    }
    return out;
}

void expect_only_reordered(const Mesh& before, const Mesh& after) {
    Mesh same = after;
    same.cells = before.cells;
    same.mid_nodes = before.mid_nodes;
    same.neighbours = before.neighbours;
    expect_same(same, before);
    const auto n = static_cast<std::ptrdiff_t>(before.corners());
    for (std::size_t cell = 0; cell < before.cell_count(); ++cell) {
        const auto at = static_cast<std::ptrdiff_t>(cell) * n;
        ASSERT_TRUE(std::is_permutation(before.cells.begin() + at, before.cells.begin() + at + n,
                                        after.cells.begin() + at, after.cells.begin() + at + n));
        ASSERT_EQ(mid_nodes_of(before, cell), mid_nodes_of(after, cell)) << cell;
    }
}

Mesh turned(const Mesh& mesh) {
    FixReport report;
    return fix_mesh(mesh, {.nodes = false, .cells = false}, report).value();
}

/// The law, on a mesh with cells of both orders.
void expect_fixed(const Mesh& mixed) {
    const CheckReport before = check_mesh(mixed);
    ASSERT_GT(before.negative, 0U);
    const Mesh fixed = turned(mixed);
    expect_only_reordered(mixed, fixed);
    const CheckReport after = check_mesh(fixed);
    EXPECT_EQ(after.positive, before.positive + before.negative);
    EXPECT_EQ(after.negative, 0U);
    EXPECT_EQ(after.degenerate, before.degenerate);
    EXPECT_EQ(after.certified(), before.certified());
    for (std::size_t cell = 0; cell < mixed.cell_count(); ++cell)
        ASSERT_EQ(after.measures.volume[cell], std::fabs(before.measures.volume[cell]));
    if (!mixed.neighbours.empty()) {
        EXPECT_EQ(fixed.neighbours, mesh::compute_neighbours(fixed));
    }
    const TemporaryFolder folder;
    ASSERT_TRUE(write_tetgen(fixed, folder / "m"));
    const Result<Mesh> read = read_tetgen(folder / "m");
    ASSERT_TRUE(read) << read.error().message();
    expect_same(*read, fixed);
}

Mesh own(const std::string& name) {
    return read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/" + name + ".node").value();
}

TEST(Orientation, OfMeshesFromFiles) {
    // With neighbours and faces; with nodes at mid-edges; in the plane.
    for (const char* name : {"cube-hole", "cube-hole-o2", "bracket", "plate", "lattice-eighths"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = own(name);
        expect_fixed(shuffled(mesh, 1));
        EXPECT_TRUE(check_mesh(shuffled(mesh, 1)).certified());
    }
    EXPECT_FALSE(own("cube-hole").neighbours.empty());
    EXPECT_FALSE(own("cube-hole").faces.empty());
    EXPECT_FALSE(own("cube-hole-o2").mid_nodes.empty());
}

TEST(Orientation, OfSecondOrderCellsInEveryOrderOfFiles) {
    for (const int dimension : {2, 3}) {
        for (const MidEdgeOrder order : orders_in(dimension))
            expect_fixed(shuffled(second_order_mesh(dimension, order, 50, 7), 2));
    }
}

TEST(Orientation, LeavesPositiveAndDegenerateCellsAlone) {
    const Mesh mesh = own("cube-hole");
    expect_same(turned(mesh), mesh);
    Mesh flat;
    flat.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    flat.cells = {0, 1, 2, 3};
    expect_same(turned(flat), flat);
}

}  // namespace
}  // namespace barycert::testing

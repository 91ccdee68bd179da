/// Every option has its effect.
#include <cmath>

#include "tests/app/tetgen/harness.hpp"

namespace barycert::test {
namespace {

class TetgenOptions : public ::testing::Test {
protected:
    Mesh mesh_with(std::vector<std::string> words, const std::string& text = cube_poly()) {
        words.insert(words.begin(), {folder_.put("part.poly", text), "--output", folder_.path("out")});
        const Outcome run = run_tetgen(std::move(words));
        EXPECT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(run.out, "");
        return read_tetgen(folder_.path("out")).value();
    }

    /// A flat box: its coarsest mesh has cells of bad shape.
    static std::string flat_box() {
        std::string text = "8 3 0 0\n";
        for (std::size_t i = 0; i < 8; ++i) {
            const auto& [x, y, z] = cube_nodes[i];
            text += std::to_string(i) + " " + std::to_string(4 * x) + " " + std::to_string(4 * y) + " " +
                    (z == 0 ? "0" : "0.25") + "\n";
        }
        return text + "6 0\n" + side_rows(0, "1\n", "") + "0\n";
    }

    Scratch folder_;
};

using Vector = std::array<double, 3>;

Vector difference(const Mesh& mesh, std::size_t cell, std::size_t from, std::size_t to) {
    Vector d{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        d[axis] = mesh.points[3 * static_cast<std::size_t>(mesh.cells[4 * cell + to]) + axis] -
                  mesh.points[3 * static_cast<std::size_t>(mesh.cells[4 * cell + from]) + axis];
    }
    return d;
}
double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Largest ratio of circumradius to shortest edge.
double worst_ratio(const Mesh& mesh) {
    double worst = 0;
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        const Vector a = difference(mesh, i, 0, 1);
        const Vector b = difference(mesh, i, 0, 2);
        const Vector c = difference(mesh, i, 0, 3);
        const Vector bc = cross(b, c);
        const Vector ca = cross(c, a);
        const Vector ab = cross(a, b);
        Vector centre{};
        for (std::size_t k = 0; k < 3; ++k) {
            centre[k] = (dot(a, a) * bc[k] + dot(b, b) * ca[k] + dot(c, c) * ab[k]) / (2 * dot(a, bc));
        }
        double shortest = dot(a, a);
        for (std::size_t p = 0; p < 4; ++p) {
            for (std::size_t q = 0; q < p; ++q) {
                const Vector e = difference(mesh, i, p, q);
                shortest = std::min(shortest, dot(e, e));
            }
        }
        worst = std::max(worst, std::sqrt(dot(centre, centre) / shortest));
    }
    return worst;
}

TEST_F(TetgenOptions, QualityBoundsTheRatio) {
    EXPECT_GT(worst_ratio(mesh_with({}, flat_box())), 2.5);
    EXPECT_LE(worst_ratio(mesh_with({"--quality"}, flat_box())), 2.0 + 1e-9);
    // TetGen's optimisation after the refinement may exceed the bound by a little.
    EXPECT_LE(worst_ratio(mesh_with({"--quality", "1.2"}, flat_box())), 1.3);
}

TEST_F(TetgenOptions, WithoutItsRatioQualityLeavesTheInput) {
    const Outcome run = run_tetgen({"--quality", folder_.put("part.poly", cube_poly())});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_GT(read_tetgen(folder_.path("part.1")).value().cell_count(), 0U);
}

TEST_F(TetgenOptions, MinDihedralRefines) {
    const std::size_t plain = mesh_with({"--quality", "2", "--min-dihedral", "0"}, flat_box()).cell_count();
    EXPECT_GT(mesh_with({"--quality", "2", "--min-dihedral", "18"}, flat_box()).cell_count(), plain);
}

TEST_F(TetgenOptions, MaxVolumeBoundsTheVolume) {
    EXPECT_GT(max_volume(mesh_with({})), 0.1);
    const Mesh fine = mesh_with({"--max-volume", "1e-3"});
    EXPECT_LE(max_volume(fine), 1e-3 * (1 + 1e-9));
    EXPECT_NEAR(total_volume(fine), 1, 1e-12);
}

TEST_F(TetgenOptions, KeepBoundaryAddsNoNodesThere) {
    const Mesh mesh = mesh_with({"--max-volume", "0.01", "--keep-boundary"});
    EXPECT_EQ(mesh.face_count(), 12U);
    EXPECT_GT(mesh_with({"--max-volume", "0.01"}).face_count(), 12U);
}

// Catches a wrong table of mid-edges: each mid node must lie at the middle of its own edge, in Mesh and in the file.
TEST_F(TetgenOptions, SecondOrderNodesLieAtMidEdges) {
    const Mesh mesh = mesh_with({"--max-volume", "0.02", "--order", "2"});
    EXPECT_EQ(mesh.mid_edge_order, MidEdgeOrder::tetgen15);
    ASSERT_EQ(mesh.mid_nodes.size(), 6 * mesh.cell_count());
    constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        for (std::size_t e = 0; e < 6; ++e) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto at = [&](Mesh::Index node) {
                    return mesh.points[3 * static_cast<std::size_t>(node) + axis];
                };
                const double a = at(mesh.cells[4 * i + edges[e][0]]);
                const double b = at(mesh.cells[4 * i + edges[e][1]]);
                ASSERT_EQ(at(mesh.mid_nodes[6 * i + e]), 0.5 * (a + b)) << "cell " << i << " edge " << e;
            }
        }
    }
    EXPECT_EQ(mesh.face_mid_nodes.size(), mesh.faces.size());
    EXPECT_NE(contents(folder_.path("out.ele")).find(" 10 0\n"), std::string::npos);
}

TEST_F(TetgenOptions, IndexBase) {
    EXPECT_EQ(mesh_with({"--index-base", "1"}).index_base, 1);
    EXPECT_EQ(mesh_with({"--index-base", "0"}, cube_poly(1)).index_base, 0);
    EXPECT_EQ(mesh_with({"--index-base", "0"}, cube_poly(1)).cells, mesh_with({}, cube_poly(1)).cells);
}

TEST_F(TetgenOptions, SwitchesAreTetgensOwn) {
    const Mesh by_switches = mesh_with({"--switches", "pq1.2a0.01"});
    const Mesh by_options = mesh_with({"--quality", "1.2", "--max-volume", "0.01"});
    EXPECT_EQ(by_switches.points, by_options.points);
    EXPECT_EQ(by_switches.cells, by_options.cells);
}

TEST_F(TetgenOptions, RegionsBecomeCellFields) {
    const Mesh mesh = mesh_with({"--switches", "pA"}, cube_poly() + "1\n0 0.5 0.5 0.5 42\n");
    ASSERT_EQ(mesh.cell_fields.size(), 1U);
    EXPECT_EQ(mesh.cell_fields[0].data, std::vector<double>(mesh.cell_count(), 42));
}

TEST_F(TetgenOptions, SwitchDLooksForIntersections) {
    const Outcome run = run_tetgen({folder_.put("cube.poly", cube_poly()), "--switches", "pd"});
    EXPECT_EQ(run.code, 0);
    EXPECT_NE(run.err.find("No faces are intersecting"), std::string::npos) << run.err;
    EXPECT_EQ(folder_.names().size(), 1U);
}

TEST_F(TetgenOptions, OutputIsNumberedAsTetgenNumbers) {
    ASSERT_EQ(run_tetgen({folder_.put("cube.off", cube_off()), "--quiet"}).code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_.path("cube.1.node")));
    ASSERT_EQ(run_tetgen({folder_.put("cube.1.off", cube_off())}).code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_.path("cube.2.node")));
    ASSERT_EQ(run_tetgen({folder_.put("cube.v3.off", cube_off())}).code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_.path("cube.v3.1.node")));
}

TEST_F(TetgenOptions, QuietIsSilentAndHelpIsNot) {
    const Outcome quiet = run_tetgen({folder_.put("cube.off", cube_off()), "--quiet"});
    EXPECT_EQ(quiet.err + quiet.out, "");
    const Outcome help = run_tetgen({"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("--max-volume"), std::string::npos);
}

}  // namespace
}  // namespace barycert::test

// Meshes of real meshers are certified, and their parts, pieces, tunnels and volumes are the known ones.
#include <gtest/gtest.h>

#include <filesystem>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "mesh/adjacency.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

struct Good {
    const char* stem;
    DefectSet told = 0;  ///< harmless
    std::int64_t tunnels = 0;
    std::uint64_t cavities = 0;
    double volume = 0;  ///< 0: not known by heart
};

/// Compares what does not depend on how things are numbered, ordered and turned.
void expect_same_counts(const CheckReport& r, const CheckReport& s) {
    EXPECT_EQ(r.certified(), s.certified());
    EXPECT_EQ(r.nodes, s.nodes);
    EXPECT_EQ(r.cells, s.cells);
    EXPECT_EQ(r.parts, s.parts);
    EXPECT_EQ(r.boundary.facets, s.boundary.facets);
    EXPECT_EQ(r.boundary.pieces, s.boundary.pieces);
    EXPECT_EQ(r.boundary.cavities, s.boundary.cavities);
    EXPECT_EQ(r.boundary.tunnels, s.boundary.tunnels);
    EXPECT_EQ(r.boundary.manifold, s.boundary.manifold);
    EXPECT_EQ(r.volume.cells, s.volume.cells);
    EXPECT_EQ(r.volume.boundary, s.volume.boundary);
    EXPECT_EQ(r.volume.equal, s.volume.equal);
}

void expect_good(const std::string& folder, const Good& good, bool positive) {
    SCOPED_TRACE(good.stem);
    Result<Mesh> mesh = read_tetgen(folder + good.stem);
    ASSERT_TRUE(mesh) << mesh.error().message();
    const CheckReport r = check_mesh(*mesh);
    EXPECT_TRUE(r.certified());
    EXPECT_EQ(words(found(r)), words(good.told));
    EXPECT_TRUE(r.certificate.covers(*mesh));
    EXPECT_TRUE(r.contacts.empty());
    EXPECT_EQ(r.degenerate, 0U);
    EXPECT_EQ(r.positive + r.negative, mesh->cell_count());
    if (positive) {
        EXPECT_EQ(r.positive, mesh->cell_count());
    }
    EXPECT_EQ(r.parts, 1U);
    EXPECT_TRUE(r.boundary.closed);
    EXPECT_TRUE(r.boundary.manifold);
    EXPECT_EQ(r.boundary.cavities, good.cavities);
    EXPECT_EQ(r.boundary.pieces, 1 + good.cavities);
    EXPECT_EQ(r.boundary.tunnels, mesh->dimension == 3 ? std::optional<std::int64_t>(good.tunnels) : std::nullopt);
    EXPECT_TRUE(r.volume.equal);
    EXPECT_EQ(r.volume.cells, r.volume.boundary);
    if (good.volume != 0) {
        EXPECT_DOUBLE_EQ(r.volume.cells, good.volume);
    }

    if (mesh->cell_count() > 60000) return;
    // The boundary that the library's own adjacency has.
    EXPECT_EQ(r.boundary.facets, mesh::hull_facets(*mesh, mesh::compute_neighbours(*mesh)).size());
    base::Random random(base::hash64(good.stem));
    Mesh other = *mesh;
    other.neighbours.clear(), other.faces.clear();
    const auto flipped = flip_some(other, random);
    const CheckReport s = check_mesh(other);
    EXPECT_EQ(words(found(s)), words(good.told | set_of(DefectKind::mixed_orientation)));
    if (positive) {
        EXPECT_EQ(s.negative, flipped);
    }
    EXPECT_EQ(s.find(DefectKind::mixed_orientation)->count, std::min(s.negative, s.positive));
    expect_same_counts(s, r);
    const std::size_t unused = r.find(DefectKind::unused_node) != nullptr ? r.find(DefectKind::unused_node)->count : 0;
    if (!mesh->mid_nodes.empty()) return;  // renumbered() leaves nodes at mid-edges out
    const CheckReport t = check_mesh(renumbered(other, random));
    EXPECT_EQ(words(found(t)), words(found(s)));
    EXPECT_EQ(t.find(DefectKind::unused_node) != nullptr ? t.find(DefectKind::unused_node)->count : 0, unused);
    expect_same_counts(t, r);
}

TEST(GoodMeshes, Own) {
    const std::string folder = std::string(BARYCERT_DATA_DIR) + "/meshes/";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files += entry.path().extension() == ".node";
    const Good all[] = {
        {"bracket", 0, 1},
        {"cube-hole", 0, 0, 1},
        {"cube-hole-o2", 0, 0, 1},
        {"flange", 0, 7},
        {"lattice-box", 0, 0, 0, 0.48},
        {"lattice-eighths", 0, 0, 0, 1},
        {"needle-slit"},
        {"plate", 0, 0, 1},
        {"torus", 0, 1},
    };
    EXPECT_EQ(files, std::size(all));
    for (const Good& good : all) expect_good(folder, good, true);
}

TEST(GoodMeshes, OfOtherPrograms) {
    const std::string folder = std::string(BARYCERT_SHARED_DATA_DIR) + "/tetgen/";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    for (const Good& good : {
             Good{"Cube21"},
             Good{"armadillo_203693"},
             Good{"cube_136_elements"},
             Good{"cube_1626_elements_quadratic"},
             Good{"cube_2mm_12_elements_with_node_attributes"},
             Good{"cylinder_14748_elem"},
             Good{"disk_984_elements"},
             Good{"disk_984_elements_indexed_from_1"},
             Good{"ellipsoid_15811_elements"},
         }) {
        expect_good(folder, good, false);
    }
}

// A volume that is known exactly: 8 * 8 * 8 cubes of side 1/8.
TEST(GoodMeshes, VolumeExact) {
    const Result<Mesh> mesh = read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/lattice-eighths");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(check_mesh(*mesh).volume.cells, 1.0);
    EXPECT_EQ(check_mesh(*mesh).volume.boundary, 1.0);
}

}  // namespace
}  // namespace barycert::testing

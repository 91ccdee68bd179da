// The meshes of data/ and of ../shared/data, brute force.
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
#include "tests/check/meshes.hpp"
#include "tests/locate/points.hpp"
#include "tests/locate/ways.hpp"

namespace barycert::testing {
namespace {

TEST(LocateData, L1L2OwnMeshes) {
    for (const char* stem : {"bracket", "cube-hole", "cube-hole-o2", "lattice-box", "lattice-eighths", "needle-slit",
                             "plate", "torus", "flange"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_mesh(stem);
        const std::vector<double> points = awkward_points(mesh, mesh.cell_count() > 10000 ? 40 : 100, random);
        EXPECT_TRUE(expect_right(mesh, points, random, stem)) << stem;
    }
}

// Holes, slits and thin walls are no different where the numbers are.
TEST(LocateData, L1L2OwnMeshesElsewhere) {
    struct Place {
        std::array<double, 3> factor, shift;
    };
    for (const char* stem : {"bracket", "needle-slit", "lattice-eighths", "plate"}) {
        for (const Place& place :
             {Place{{1, 1, 1}, {1e6, -1e6, 1e6}}, Place{{0x1p-1000, 0x1p-1000, 0x1p-1000}, {}},
              Place{{1e300, 1e300, 1e300}, {}}, Place{{1e-9, 1, 1e9}, {}}, Place{{-1e-6, 1, 1}, {1, 0, 0}}}) {
            base::Random random(base::hash64(stem));
            const Mesh mesh = mapped(own_mesh(stem), place.factor, place.shift);
            expect_right(mesh, awkward_points(mesh, 25, random), random,
                         std::string(stem) + " times " + std::to_string(place.factor[0]));
        }
    }
}

TEST(LocateData, L1L2FlippedAndRenumbered) {
    for (const char* stem : {"cube-hole", "lattice-eighths", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = renumbered(own_mesh(stem), random);
        flip_some(mesh, random);
        EXPECT_TRUE(expect_right(mesh, awkward_points(mesh, 60, random), random, stem)) << stem;
    }
}

TEST(LocateData, L1L2SharedMeshes) {
    const std::string folder = BARYCERT_SHARED_DATA_DIR "/tetgen";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
    for (const char* stem : {"Cube21", "ellipsoid_15811_elements", "cylinder_14748_elem", "cube_136_elements",
                             "cube_1626_elements_quadratic", "disk_984_elements", "disk_984_elements_indexed_from_1",
                             "cube_2mm_12_elements_with_node_attributes", "armadillo_203693"}) {
        base::Random random(base::hash64(stem));
        const auto mesh = read_tetgen(folder + "/" + stem);
        ASSERT_TRUE(mesh) << mesh.error().message();
        const std::vector<double> points = awkward_points(*mesh, mesh->cell_count() > 10000 ? 25 : 80, random);
        expect_right(*mesh, points, random, stem, {.targets = mesh->cell_count() < 10000});
    }
}

}  // namespace
}  // namespace barycert::testing

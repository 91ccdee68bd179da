// Files from real programs, in a folder beside the checkout that may be absent.
#include <filesystem>

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
#include "tests/io/medit/medit_files.hpp"

namespace barycert::testing {
namespace {

const std::string shared = BARYCERT_SHARED_DATA_DIR "/medit/";

TEST(MeditRealFiles, TextOfSfepy) {
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no " << shared;
    const Result<Mesh> mesh = read_mesh(shared + "sfepy_cubecyl.mesh");
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_EQ(mesh->point_count(), 10490U);
    EXPECT_EQ(mesh->points[0], 1);
    EXPECT_TRUE(check_mesh(*mesh).certified());
}

TEST(MeditRealFiles, BinaryOfRefine) {
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no " << shared;
    const Result<Mesh> mesh = read_mesh(shared + "refine_cubesphere.meshb");
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_EQ(mesh->point_count(), 5062U);
    EXPECT_FALSE(mesh->faces.empty());
    EXPECT_EQ(mesh->faces.size(), 3 * mesh->face_markers.size());
    EXPECT_TRUE(check_mesh(*mesh).certified());
}

}  // namespace
}  // namespace barycert::testing

// data/certified.txt: the fingerprints by which barycert-audit, which checks nothing, knows barycert's own meshes.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <set>
#include <sstream>
#include <string>

#include "barycert/check.hpp"
#include "barycert/tetgen_files.hpp"

namespace barycert::testing {
namespace {

TEST(OwnMeshes, AreThoseThatAreKnownAsCertified) {
    const std::filesystem::path folder = std::filesystem::path(BARYCERT_DATA_DIR) / "meshes";
    std::set<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
        if (file.path().extension() == ".ele") names.insert(file.path().stem());
    }
    ASSERT_FALSE(names.empty());
    std::ostringstream certified;
    for (const std::string& name : names) {
        // As the audit reads them: it draws simplices, and needs no other files.
        const Mesh mesh = read_tetgen(folder / name, {.faces = false, .neighbours = false}).value();
        const Certificate certificate = check_mesh(mesh).certificate;
        EXPECT_EQ(certificate.verdict(), Verdict::certified) << name;
        certified << std::hex << std::setw(16) << std::setfill('0') << certificate.fingerprint() << ' ' << name << '\n';
    }
    std::stringstream known;
    known << std::ifstream(std::filesystem::path(BARYCERT_DATA_DIR) / "certified.txt").rdbuf();
    EXPECT_EQ(known.str(), certified.str()) << "what the file should have";
}

TEST(OwnMeshes, AreNoLongerKnownWhenOneCoordinateChanges) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1};
    mesh.cells = {0, 1, 2};
    const std::uint64_t own = check_mesh(mesh).certificate.fingerprint();
    EXPECT_TRUE(Certificate::known(mesh, std::array{own + 1, own}).covers(mesh));
    EXPECT_EQ(Certificate::known(mesh, {}).verdict(), Verdict::not_checked);
    mesh.points[2] = 0x1.0000000000001p0;
    EXPECT_EQ(Certificate::known(mesh, std::array{own}).verdict(), Verdict::not_checked);
    EXPECT_EQ(Certificate::known(mesh, std::array{own}).fingerprint(), 0U);
}

}  // namespace
}  // namespace barycert::testing

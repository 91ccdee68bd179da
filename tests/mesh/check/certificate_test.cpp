// A certificate speaks of one mesh, and of no other.
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

void expect_not_covered(const Certificate& c, const Mesh& mesh) {
    EXPECT_FALSE(c.covers(mesh));
    EXPECT_EQ(c.verdict_on(mesh), Verdict::not_checked);
}

TEST(Certificate, CoversTheMeshAlone) {
    for (const int d : {2, 3}) {
        const Mesh mesh = box(d, {2, 2, 2});
        const Certificate c = quick(mesh).certificate;
        ASSERT_TRUE(c.covers(mesh));
        EXPECT_TRUE(c.covers(Mesh(mesh)));
        EXPECT_EQ(c.verdict(), Verdict::certified);
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            for (int bit = 0; bit < 64; ++bit) {
                Mesh other = mesh;
                other.points[i] =
                    std::bit_cast<double>(std::bit_cast<std::uint64_t>(mesh.points[i]) ^ std::uint64_t{1} << bit);
                expect_not_covered(c, other);
            }
        }
        for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
            for (int bit = 0; bit < 32; ++bit) {
                Mesh other = mesh;
                other.cells[i] = static_cast<Mesh::Index>(static_cast<std::uint32_t>(mesh.cells[i]) ^ 1U << bit);
                expect_not_covered(c, other);
            }
        }
    }
}

TEST(Certificate, OrderAndSizeMatter) {
    for (const int d : {2, 3}) {
        const Mesh mesh = box(d, {2, 2, 2});
        const Certificate c = quick(mesh).certificate;
        for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (mesh.cells[i] == mesh.cells[j]) continue;
                Mesh other = mesh;
                std::swap(other.cells[i], other.cells[j]);
                expect_not_covered(c, other);
            }
        }
        base::Random random(3);
        for (int i = 0; i < 20; ++i) expect_not_covered(c, renumbered(mesh, random));
        Mesh other = mesh;
        other.points.resize(other.points.size() + static_cast<std::size_t>(d), 0.0);
        expect_not_covered(c, other);
        other = mesh, other.cells.resize(other.cells.size() - mesh.corners());
        expect_not_covered(c, other);
        other = mesh, other.dimension = 5 - d;
        expect_not_covered(c, other);
        expect_not_covered(c, Mesh{});
    }
}

TEST(Certificate, OfNothingAndOfABadMesh) {
    const Mesh mesh = box(3, {1, 1, 1});
    expect_not_covered(Certificate{}, mesh);
    expect_not_covered(Certificate{}, Mesh{});
    Mesh bad = mesh;
    bad.cells[0] = -1;
    const Certificate c = quick(bad).certificate;
    EXPECT_EQ(c.verdict(), Verdict::not_certified);
    EXPECT_EQ(c.verdict_on(bad), Verdict::not_certified);
    EXPECT_FALSE(c.covers(bad));
    expect_not_covered(c, mesh);
    EXPECT_TRUE(quick(Mesh{}).certificate.covers(Mesh{}));
}

}  // namespace
}  // namespace barycert::testing

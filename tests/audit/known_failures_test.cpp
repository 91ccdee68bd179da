// Known failures stand where they must: an audit that did not see them would not see others. The shares in brackets
// were measured elsewhere with the same recipes; families differ a little in what else a case holds, so each test
// states the order of magnitude.

#include <gtest/gtest.h>

#include "audit_helpers.hpp"

namespace barycert::audit {
namespace {

constexpr std::uint64_t cases = 20000;

double wrong_share(const std::string& kernel, const std::string& family, std::uint64_t count = cases) {
    const Statistics s = statistics_of(kernel, family, count, own_meshes());
    return share(s, s.wrong_cases);
}

double sign_share(const std::string& kernel, const std::string& family) {
    const Statistics s = statistics_of(kernel, family, cases);
    return share(s, count_of(s, Finding::opposite_sign)) / vertex_count(kernel_named(kernel).simplex);
}

TEST(KnownFailures, UnsignedRatiosNeverSayOutside) {
    for (const char* kernel : {"triangle.unsigned-area", "tetrahedron.unsigned-volume"}) {
        for (const char* family : {"mesh.hull.near", "mesh.hull.far", "random"}) {
            const Statistics s = statistics_of(kernel, family, 2000, own_meshes());
            const auto& outside = s.confusion[static_cast<std::size_t>(Region::outside)];
            EXPECT_EQ(outside[static_cast<std::size_t>(Region::outside)], 0U) << kernel << " " << family;
            EXPECT_GT(count_of(s, Finding::false_inside), 1000U) << kernel << " " << family;
        }
        EXPECT_EQ(wrong_share(kernel, "random.inside"), 0) << kernel;
    }
}

TEST(KnownFailures, HomogeneousDeterminantsAtAnOffset) {  // [43 % and 49 %: signs are all but a coin's toss]
    EXPECT_GT(sign_share("tetrahedron.homogeneous", "offset.2^17"), 0.40);
    EXPECT_GT(sign_share("tetrahedron.homogeneous", "offset.2^20"), 0.43);
    EXPECT_LT(sign_share("tetrahedron.homogeneous", "offset.2^20"), 0.51);
    EXPECT_EQ(wrong_share("tetrahedron.signed-volume", "offset.2^20"), 0);
}

TEST(KnownFailures, Float32LosesTheSide) {
    // One half of the points near a face change sides: what is closer than 2^-24 of the coordinates is chance.
    for (const char* kernel :
         {"tetrahedron.signed-volume.float32", "tetrahedron.cramer.float32", "tetrahedron.homogeneous.float32"}) {
        EXPECT_GT(wrong_share(kernel, "near-facet.1e-13"), 0.40) << kernel;
    }
    EXPECT_EQ(wrong_share("tetrahedron.signed-volume", "near-facet.1e-13"), 0);
    EXPECT_GT(wrong_share("triangle.signed-area.float32", "ulp-grid.1", 65536), 0.99);
}

TEST(KnownFailures, UlpGrids) {  // [17.8 %, 30.1 %, 16.5 %, pivot at the point]
    EXPECT_NEAR(wrong_share("triangle.relative-to-point", "ulp-grid.1", 65536), 0.178, 0.02);
    EXPECT_NEAR(wrong_share("triangle.relative-to-point", "ulp-grid.2", 65536), 0.301, 0.02);
    EXPECT_NEAR(wrong_share("triangle.relative-to-point", "ulp-grid.3", 65536), 0.165, 0.02);
}

TEST(KnownFailures, AnisotropicPlane) {  // [43 %, of which 21 % opposite]
    const Statistics s = statistics_of("tetrahedron.signed-volume", "anisotropic-plane", cases);
    EXPECT_NEAR(share(s, s.wrong_cases), 0.43, 0.06);
    EXPECT_NEAR(share(s, count_of(s, Finding::opposite_sign)), 0.21, 0.04);
}

TEST(KnownFailures, PointsOnAFace) {  // [6 % in the unit cube, none at 1000]
    EXPECT_NEAR(wrong_share("tetrahedron.signed-volume", "on-facet"), 0.06, 0.03);
    EXPECT_EQ(wrong_share("tetrahedron.signed-volume", "on-facet.offset"), 0);
}

TEST(KnownFailures, Slivers) {  // [2.8 %, 0.3 %, 0.1 %]
    EXPECT_NEAR(wrong_share("tetrahedron.signed-volume", "sliver.1e-15"), 0.03, 0.02);
    EXPECT_NEAR(wrong_share("tetrahedron.signed-volume", "sliver.1e-14"), 0.004, 0.003);
    EXPECT_LT(wrong_share("tetrahedron.signed-volume", "sliver.1e-13"), 0.002);
}

TEST(KnownFailures,
     SliversOfHeight1e12LoseTheWeightsToo) {  // [error to 2.6e15 u, sum - 1 to 1.2e15 u, of translated determinants]
    const Statistics s = statistics_of("tetrahedron.homogeneous", "sliver.1e-12", cases);
    EXPECT_GT(s.weight_ulp.value, 1e15);
    EXPECT_GT(s.partition_residual.value, 1e12 * 0x1p-53);
}

TEST(KnownFailures, Lattices) {  // [1 % of signs at tenths; integers exact, 11 % exact zeros]
    EXPECT_GT(wrong_share("tetrahedron.signed-volume", "lattice.tenths"), 0.01);
    EXPECT_EQ(wrong_share("tetrahedron.signed-volume", "lattice.integers"), 0);
}

TEST(KnownFailures, ExactZerosOfTheDiagonal) {  // [90.4 %]
    EXPECT_GT(wrong_share("tetrahedron.signed-volume", "diagonal"), 0.7);
}

TEST(KnownFailures, RangeFamiliesUnderflowAndOverflow) {
    EXPECT_GT(wrong_share("tetrahedron.signed-volume", "tiny"), 0.99);
    EXPECT_GT(wrong_share("tetrahedron.signed-volume", "huge"), 0.99);
    EXPECT_GT(wrong_share("tetrahedron.kahan", "subnormal"), 0.5);
}

TEST(KnownFailures, TheTolerantRuleTakesOutsideForInside) {
    const Statistics s = statistics_of("tetrahedron.vtk-tolerance", "near-facet.1e-13", cases);
    EXPECT_GT(share(s, count_of(s, Finding::false_inside)), 0.4);
}

}  // namespace
}  // namespace barycert::audit

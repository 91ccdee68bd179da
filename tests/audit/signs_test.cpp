// Pictures of signs: the exact one is what the construction says, and kernels fail where they are known to.

#include "barycert/audit_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "barycert/oracle.hpp"

namespace barycert::audit {
namespace {

TEST(Signs, TheExactPictureIsADiagonal) {
    for (const SignPicture& p : sign_pictures(kernels_matching("*"))) {
        if (!p.kernel.empty()) continue;
        const int side = p.signs[SignPicture::side];  // of point (0, 1), above the diagonal
        for (int j = 0; j < SignPicture::side; ++j) {
            for (int i = 0; i < SignPicture::side; ++i) {
                const int sign = p.signs[static_cast<std::size_t>(j) * SignPicture::side + static_cast<std::size_t>(i)];
                ASSERT_EQ(sign, i < j ? side : i > j ? -side : 0) << name(p.simplex) << ' ' << i << ' ' << j;
            }
        }
        EXPECT_NE(side, 0);
        EXPECT_EQ(p.wrong, 0U);
    }
}

TEST(Signs, OnePictureAKernelAfterThatOfItsKind) {
    const std::vector<SignPicture> pictures = sign_pictures(kernels_matching("*"));
    std::vector<Kernel> expected;
    for (const Kernel& k : catalogue()) {
        if (k.simplex != Simplex::segment) expected.push_back(k);
    }
    std::size_t next = 0, exact = 0;
    for (const SignPicture& p : pictures) {
        ASSERT_EQ(p.signs.size(), 65536U);
        if (p.kernel.empty()) {
            ++exact;
            ASSERT_LT(next, expected.size());
            EXPECT_EQ(p.simplex, expected[next].simplex);
            EXPECT_EQ(p.perspective, expected[next].perspective);
            continue;
        }
        ASSERT_LT(next, expected.size());
        EXPECT_EQ(p.kernel, expected[next++].name);
    }
    EXPECT_EQ(next, expected.size());
    EXPECT_EQ(exact, 4U);
}

TEST(Signs, RightKernelsAreRightAndPlainOnesAreNot) {
    for (const SignPicture& p : sign_pictures(kernels_matching("*"))) {
        if (p.kernel.ends_with("exact")) {
            EXPECT_EQ(p.wrong, 0U) << p.kernel;
        }
        // Every plain kernel loses differences of one ulp beside coordinates of 12 and 24.
        if (p.kernel.ends_with(".cramer") || p.kernel.ends_with("signed-area")) {
            EXPECT_GT(p.wrong, 1000U) << p.kernel;
        }
    }
}

TEST(Signs, AKernelThatDeclaresOrGivesNoNumberHasNoSign) {
    Kernel silent;
    silent.name = "triangle.silent";
    silent.simplex = Simplex::triangle;
    silent.weights = [](const double*, const double*, double*) { return 1; };
    silent.value = [](const double*, const double*) { return 0.0; };
    Kernel unset = silent;
    unset.weights = [](const double*, const double*, double*) { return 0; };
    const std::vector<SignPicture> pictures = sign_pictures({silent, unset});
    ASSERT_EQ(pictures.size(), 3U);
    for (const std::size_t i : {1U, 2U}) {
        EXPECT_EQ(pictures[i].wrong, 65536U);
        for (const std::int8_t s : pictures[i].signs) ASSERT_EQ(s, 2);
    }
}

TEST(Signs, AKernelInAProcessOfItsOwnIsAskedThere) {
    const std::string folder = std::string(BARYCERT_UNRULY_DIR) + "/unruly-";
    const auto inside = sign_pictures({load_kernel_library(folder + "quiet.so").value()});
    const auto apart = sign_pictures({load_contained_kernel(folder + "quiet.so").value()});
    ASSERT_EQ(inside.size(), 2U);
    EXPECT_EQ(inside[1].signs, apart[1].signs);
    // One that crashes has no sign there, and this process goes on.
    const auto crashing = sign_pictures({load_contained_kernel(folder + "crash.so").value()});
    EXPECT_GT(std::count(crashing[1].signs.begin(), crashing[1].signs.end(), std::int8_t{2}), 100);
}

}  // namespace
}  // namespace barycert::audit

// The catalogue as a list, and how regions are read from weights.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "barycert/kernels.hpp"

namespace barycert {
namespace {

Region claimed(const Kernel& k, int status, const std::vector<double>& w) {
    return claimed_region(k, status, w);
}

TEST(Catalogue, NamesAreUniqueAndWellFormed) {
    std::set<std::string> seen;
    for (const Kernel& k : catalogue()) {
        EXPECT_TRUE(seen.insert(k.name).second) << k.name;
        const std::string prefix = std::string(name(k.simplex)) + ".";
        EXPECT_EQ(k.name.substr(0, prefix.size()), prefix);
        EXPECT_EQ(k.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789.-O"), std::string::npos) << k.name;
    }
}

TEST(Catalogue, EveryKernelIsDescribed) {
    for (const Kernel& k : catalogue()) {
        for (const std::string* text : {&k.formula, &k.source, &k.fails}) {
            EXPECT_FALSE(text->empty()) << k.name;
            EXPECT_EQ(text->find('\n'), std::string::npos) << k.name;
        }
        EXPECT_NE(k.weights, nullptr);
        EXPECT_NE(k.value, nullptr);
        const bool exact = k.name.ends_with("exact");
        EXPECT_EQ(k.certifies, exact) << "a plain formula certifies nothing: " << k.name;
        // Exact kernels, and those whose formula has the value in it.
        bool of_its_own = exact;
        for (const char* formula : {"increments", "perspective-textbook", "perspective-varying"})
            of_its_own = of_its_own || k.name.find(formula) != std::string::npos;
        EXPECT_EQ(k.interpolate != nullptr, of_its_own) << k.name;
        EXPECT_EQ(k.perspective, k.name.starts_with("triangle.perspective-")) << k.name;
        EXPECT_EQ(k.rule == RegionRule::tolerant, k.tolerance != 0) << k.name;
    }
}

TEST(Catalogue, IsGroupedBySimplexInOrder) {
    for (std::size_t i = 1; i < catalogue().size(); ++i) {
        EXPECT_LE(catalogue()[i - 1].simplex, catalogue()[i].simplex);
    }
}

TEST(Catalogue, GlobSelects) {
    EXPECT_EQ(kernels_matching("*").size(), catalogue().size());
    EXPECT_EQ(kernels_matching("tetrahedron.kahan").size(), 1U);
    EXPECT_EQ(kernels_matching("segment.*").size(), 6U);
    EXPECT_EQ(kernels_matching("tetrahedron.*.float32").size(), 4U);
    EXPECT_EQ(kernels_matching("*.fast-math").size(), 4U);
    EXPECT_EQ(kernels_matching("*.O0").size(), 4U);
    EXPECT_EQ(kernels_matching("tetrahedron").size(), 0U);
    EXPECT_EQ(kernels_matching("*.exact").size(), 4U);
    EXPECT_EQ(kernels_matching("triangle.perspective-*").size(), 6U);
#ifdef __x86_64__
    EXPECT_EQ(kernels_matching("*.contracted").size(), __builtin_cpu_supports("fma") != 0 ? 4U : 0U);
#endif
}

/// Kernels that declare do so where all vertices coincide; the others return NaN or infinity, but for full-lu, whose
/// rank decision turns a singular system into finite weights.
TEST(Catalogue, CoincidentVerticesAreDeclaredOrNotFinite) {
    for (const Kernel& k : catalogue()) {
        const double vertices[12] = {}, point[3] = {1, 2, 3};
        double w[4] = {};
        const int status = k.weights(vertices, point, w);
        EXPECT_EQ(status, k.declares_degenerate ? 1 : 0) << k.name;
        const Region region = claimed_region(k, status, {w, static_cast<std::size_t>(vertex_count(k.simplex))});
        const bool rank_revealing = k.name.find("full-lu") != std::string::npos;
        EXPECT_EQ(region == Region::degenerate, !rank_revealing) << k.name;
    }
}

TEST(Catalogue, DefaultValueIsTheSumFromTheLeft) {
    const double w[4] = {1, 1, 1, 1}, f[4] = {0x1p53, 1, 1, -0x1p53};
    EXPECT_EQ(kernels_matching("tetrahedron.cramer").at(0).value(w, f), 0.0);
    const double g[4] = {1, 1, 0x1p53, -0x1p53};
    EXPECT_EQ(kernels_matching("tetrahedron.cramer").at(0).value(w, g), 2.0);
    EXPECT_EQ(kernels_matching("triangle.inverse").at(0).value(w, g), 0x1p53 + 2);
    EXPECT_EQ(kernels_matching("segment.projection").at(0).value(w, g), 2.0);
}

TEST(Region, IsReadFromSigns) {
    const Kernel k;
    EXPECT_EQ(claimed(k, 0, {0.25, 0.25, 0.5}), Region::interior);
    EXPECT_EQ(claimed(k, 0, {0.5, 0.5, -0.0}), Region::boundary);
    EXPECT_EQ(claimed(k, 0, {0, 1.5, -0.5}), Region::outside);
    EXPECT_EQ(claimed(k, 0, {0.5, 0.5, -std::numeric_limits<double>::denorm_min()}), Region::outside);
    EXPECT_EQ(claimed(k, 1, {0.25, 0.25, 0.5}), Region::degenerate);
    EXPECT_EQ(claimed(k, 0, {-1, HUGE_VAL, 0.5}), Region::degenerate);
    EXPECT_EQ(claimed(k, 0, {-1, 0.5, std::nan("")}), Region::degenerate);
}

TEST(Region, ToleranceMovesTheBoundaryAndKnowsNoBoundary) {
    Kernel k;
    k.rule = RegionRule::tolerant;
    k.tolerance = 0.001;
    EXPECT_EQ(claimed(k, 0, {0.5, 0.5, 0}), Region::interior);
    EXPECT_EQ(claimed(k, 0, {0.5, 0.501, -0.001}), Region::interior);
    EXPECT_EQ(claimed(k, 0, {0.5, 0.5, std::nextafter(-0.001, -1)}), Region::outside);
    EXPECT_EQ(claimed(k, 0, {0.5, 0.5, std::nan("")}), Region::degenerate);
    EXPECT_EQ(claimed(k, 1, {0.5, 0.5, 0}), Region::degenerate);
}

}  // namespace
}  // namespace barycert

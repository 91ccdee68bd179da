// Each built family does what its line says: checked with the oracle on a few hundred of its cases.

#include "barycert/audit/families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "audit_helpers.hpp"

namespace barycert::audit {
namespace {

constexpr std::uint64_t cases = 400;

template <class Check>
void for_each_case(const std::string& family, Check check) {
    const Family& f = family_named(family);
    for (const Simplex s : f.simplices) {
        for (std::uint64_t i = 0; i < cases; ++i) check(make_case(f, s, 1, i, own_meshes()));
    }
}

double share_of(const std::string& family, bool (*holds)(const Case&)) {
    double hits = 0, all = 0;
    for_each_case(family, [&](const Case& c) {
        hits += holds(c) ? 1 : 0;
        all += 1;
    });
    return hits / all;
}

bool zero_weight(const Case& c) {
    const exact::Answer a = exact::ask(c);
    return a.region != Region::degenerate && std::popcount(a.support) < vertex_count(c.simplex);
}

bool degenerate(const Case& c) {
    return exact::ask(c).region == Region::degenerate;
}

TEST(Families, NamesAreUniqueAndExplained) {
    std::set<std::string> names;
    for (const Family& f : all_families()) {
        EXPECT_TRUE(names.insert(f.name).second) << f.name;
        EXPECT_FALSE(f.after.empty()) << f.name;
        EXPECT_FALSE(f.parameters.empty()) << f.name;
        EXPECT_FALSE(f.simplices.empty()) << f.name;
    }
}

TEST(Families, EveryCaseIsFinite) {
    for (const Family& f : all_families()) {
        for_each_case(f.name, [&](const Case& c) {
            const auto finite = [](double x) { return std::isfinite(x); };
            EXPECT_TRUE(std::all_of(c.vertices.begin(), c.vertices.end(), finite)) << f.name;
            EXPECT_TRUE(std::all_of(c.point.begin(), c.point.end(), finite)) << f.name;
            EXPECT_TRUE(std::all_of(c.values.begin(), c.values.end(), finite)) << f.name;
        });
    }
}

// The same seed gives the same cases on every machine: a hash of all of them, pinned.
TEST(Families, BitsArePinned) {
    std::uint64_t hash = 0;
    for (const Family& f : built_families()) {
        for (const Simplex s : f.simplices) {
            for (std::uint64_t i = 0; i < 64; ++i) {
                const Case c = make_case(f, s, 1, i, {});
                for (const double x : c.vertices) hash = mix64(hash ^ std::bit_cast<std::uint64_t>(x));
                for (const double x : c.point) hash = mix64(hash ^ std::bit_cast<std::uint64_t>(x));
                for (const double x : c.values) hash = mix64(hash ^ std::bit_cast<std::uint64_t>(x));
            }
        }
    }
    EXPECT_EQ(hash, 0x85903bb578807ab2ULL);
}

TEST(Families, SeedsAndNumbersGiveDifferentCases) {
    const Family& f = family_named("random");
    const auto point = [&](std::uint64_t seed, std::uint64_t i) {
        return make_case(f, Simplex::tetrahedron, seed, i, {}).point;
    };
    EXPECT_NE(point(1, 0), point(2, 0));
    EXPECT_NE(point(1, 0), point(1, 1));
    EXPECT_EQ(point(1, 5), point(1, 5));
}

TEST(Families, DegenerateOnesAreDegenerate) {
    for (const char* name : {"degenerate.point", "degenerate.line", "degenerate.plane"})
        EXPECT_EQ(share_of(name, degenerate), 1) << name;
    for_each_case("degenerate.point", [](const Case& c) { EXPECT_EQ(exact::affine_dimension(c), 0); });
    for_each_case("degenerate.line", [](const Case& c) { EXPECT_LE(exact::affine_dimension(c), 1); });
    for_each_case("degenerate.plane", [](const Case& c) { EXPECT_LE(exact::affine_dimension(c), 2); });
}

TEST(Families, NearlyDegenerateOnesMostlyAreNot) {
    EXPECT_LT(share_of("nearly-degenerate", degenerate), 0.5);
}

TEST(Families, LatticesAreFullOfZeros) {
    EXPECT_GT(share_of("lattice.integers", zero_weight), 0.1);
    EXPECT_GT(share_of("lattice.integers", degenerate), 0.01);
}

TEST(Families, DiagonalHasExactZeros) {
    EXPECT_EQ(share_of("diagonal", zero_weight), 1);
}

TEST(Families, PointsOnFacetsMostlyMissThem) {
    EXPECT_LT(share_of("on-facet", zero_weight), 0.9);
    for_each_case("on-facet", [](const Case& c) {
        const exact::Answer a = exact::ask(c);
        EXPECT_LT(std::fabs(a.weights[static_cast<std::size_t>(vertex_count(c.simplex) - 1)]), 1e-9);
    });
}

TEST(Families, RangeFamiliesLieWhereTheySay) {
    for_each_case("subnormal", [](const Case& c) { EXPECT_LT(std::fabs(c.vertices[0]), 0x1p-1022); });
    for_each_case("tiny", [](const Case& c) { EXPECT_LE(std::fabs(c.vertices[0]), 0x1p-540); });
    double largest = 0;
    for_each_case("huge", [&](const Case& c) { largest = std::max(largest, std::fabs(c.vertices[0])); });
    EXPECT_GT(largest, 0x1.8p1023);
}

TEST(Families, SliversHaveTheHeightTheySay) {
    for_each_case("sliver.1e-12", [](const Case& c) {
        // All weights of the apex moved by its height: one unit of weight is 1e-12 of length, so a unit step is 1e12.
        if (c.simplex != Simplex::triangle) return;
        const double ax = c.vertices[2] - c.vertices[0], ay = c.vertices[3] - c.vertices[1];
        const double bx = c.vertices[4] - c.vertices[0], by = c.vertices[5] - c.vertices[1];
        EXPECT_LT(std::fabs(ax * by - ay * bx) / std::hypot(ax, ay), 2e-12);
    });
}

TEST(Families, UlpGridVisitsEveryPointOnce) {
    std::set<std::pair<double, double>> seen;
    const Family& f = family_named("ulp-grid.1");
    for (std::uint64_t i = 0; i < 65536; ++i) {
        const Case c = make_case(f, Simplex::triangle, 1, i, {});
        seen.emplace(c.point[0], c.point[1]);
    }
    EXPECT_EQ(seen.size(), 65536U);
}

}  // namespace
}  // namespace barycert::audit

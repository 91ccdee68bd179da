// Each built family does what its line says: checked with the oracle on a few hundred of its cases.

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"
#include "core/base/random.hpp"

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
    const OracleAnswer a = ask_oracle(c);
    return a.region != Region::degenerate && std::popcount(a.support) < vertex_count(c.simplex);
}

bool degenerate(const Case& c) {
    return ask_oracle(c).region == Region::degenerate;
}

TEST(Families, NamesAreUniqueAndExplained) {
    std::set<std::string> names;
    for (const Family& f : all_families()) {
        EXPECT_TRUE(names.insert(f.name).second) << f.name;
        EXPECT_FALSE(f.tests.empty()) << f.name;
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

bool of_rasters(const Family& f) {
    return f.name.starts_with("triangle.") || f.perspective;
}

/// A hash of the first cases of the families for which `chosen` holds.
template <class Chosen>
std::uint64_t hash_of_families(Chosen chosen) {
    std::uint64_t hash = 0;
    for (const Family& f : all_families()) {
        if (!chosen(f)) continue;
        for (const Simplex s : f.simplices) {
            for (std::uint64_t i = 0; i < 64; ++i) {
                const Case c = make_case(f, s, 1, i, own_meshes());
                for (const double x : c.vertices) hash = base::mix64(hash ^ std::bit_cast<std::uint64_t>(x));
                for (const double x : c.point) hash = base::mix64(hash ^ std::bit_cast<std::uint64_t>(x));
                for (const double x : c.values) hash = base::mix64(hash ^ std::bit_cast<std::uint64_t>(x));
            }
        }
    }
    return hash;
}

// The same seed gives the same cases on every machine: hashes of them, pinned.
TEST(Families, BitsArePinned) {
    EXPECT_EQ(hash_of_families([](const Family& f) { return !of_rasters(f); }), 0xea5214d83467161eULL);
    EXPECT_EQ(hash_of_families(of_rasters), 0x20dfdbecc09e1dbeULL);
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
    for_each_case("degenerate.point", [](const Case& c) { EXPECT_EQ(affine_dimension(c), 0); });
    for_each_case("degenerate.line", [](const Case& c) { EXPECT_LE(affine_dimension(c), 1); });
    for_each_case("degenerate.plane", [](const Case& c) { EXPECT_LE(affine_dimension(c), 2); });
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
        const OracleAnswer a = ask_oracle(c);
        EXPECT_LT(std::fabs(a.weights[static_cast<std::size_t>(vertex_count(c.simplex) - 1)]), 1e-9);
    });
}

TEST(Families, RangeFamiliesLieWhereTheySay) {
    for_each_case("subnormal", [](const Case& c) { EXPECT_LT(std::fabs(c.vertices[0]), 0x1p-1022); });
    double max = 0;
    for_each_case("tiny", [&](const Case& c) { max = std::max(max, std::fabs(c.vertices[0])); });
    EXPECT_LE(max, 0x1p-540);
    EXPECT_GT(max, 0x1p-541);
    for_each_case("huge", [&](const Case& c) { max = std::max(max, std::fabs(c.vertices[0])); });
    EXPECT_GT(max, 0x1.8p1023);
}

// Six times the volume over twice the area of the facet of the others, or the area over the length: the height of the
// last vertex.
double height(const Case& c) {
    using V = std::array<double, 3>;
    const auto edge = [&](int i) {
        V e{};
        for (int axis = 0; axis < space_dimension(c.simplex); ++axis)
            e[static_cast<std::size_t>(axis)] = c.vertex(i, axis) - c.vertex(0, axis);
        return e;
    };
    const auto cross = [](const V& a, const V& b) {
        return V{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto length = [](const V& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); };
    if (c.simplex != Simplex::tetrahedron) return length(cross(edge(1), edge(2))) / length(edge(1));
    const V n = cross(edge(1), edge(2)), e = edge(3);
    return std::fabs(n[0] * e[0] + n[1] * e[1] + n[2] * e[2]) / length(n);
}

// The vertex is rounded to the grid of doubles below 1, so its height is off by up to a few 2^-53: 1e-12 and 1e-13 are
// met to one in a hundred and one in ten, 1e-14 to a factor; needle-like facets, where double arithmetic cannot tell
// the height either, are left out.
TEST(Families, SliversHaveTheHeightTheySay) {
    const auto check = [](const char* family, double low, double high) {
        int seen = 0, off = 0;
        for_each_case(family, [&](const Case& c) {
            const double h = height(c);
            ++seen;
            off += h < low || h > high ? 1 : 0;
        });
        EXPECT_LT(off, seen / 50) << family;
    };
    check("sliver.1e-12", 0.99e-12, 1.01e-12);
    check("sliver.1e-13", 0.9e-13, 1.1e-13);
    check("sliver.1e-14", 0.5e-14, 1.5e-14);
}

TEST(Families, CapsAreFlatAndNeedlesThin) {
    for_each_case("cap", [](const Case& c) {
        EXPECT_GT(height(c), 0x1p-43);
        EXPECT_LT(height(c), 0x1p-9);
    });
    for_each_case("needle", [](const Case& c) {
        double square = 0;
        for (int axis = 0; axis < space_dimension(c.simplex); ++axis)
            square += std::pow(c.vertex(1, axis) - c.vertex(0, axis), 2);
        EXPECT_LT(square, 3 * 0x1p-20);
        EXPECT_GT(square, 0.0);
    });
}

TEST(Families, OffsetsAndMixedScalesLieWhereTheySay) {
    for_each_case("offset.2^17",
                  [](const Case& c) { EXPECT_TRUE(c.vertices[0] >= 0x1p17 && c.vertices[0] <= 0x1p17 + 1); });
    for_each_case("offset.2^20", [](const Case& c) { EXPECT_TRUE(c.point[1] >= 0x1p20 && c.point[1] <= 0x1p20 + 1); });
    double first = 0, second = 0;
    for_each_case("mixed-scale", [&](const Case& c) {
        first = std::max(first, std::fabs(c.vertex(0, 0)));
        second = std::max(second, std::fabs(c.vertex(0, 1)));
    });
    EXPECT_GT(first, 0x1p511);
    EXPECT_LE(first, 0x1p512);
    EXPECT_GT(second, 0x1p-513);
    EXPECT_LE(second, 0x1p-512);
}

// One weight is the small one: that of the vertex that the facet leaves out. Its size is the height of the point over
// that of the vertex.
TEST(Families, PointsNearFacetsAreNear) {
    const Family& f = family_named("near-facet.1e-13");
    for (std::uint64_t i = 0; i < cases; ++i) {
        const Case c = make_case(f, Simplex::tetrahedron, 1, i, {});
        const double h = ask_oracle(c).weights[3] * height(c);
        EXPECT_NEAR(std::fabs(h), 1e-13, 2e-15) << i;
    }
}

// An ulp is an ulp of the mesh's coordinates, never a step to the smallest subnormal.
TEST(Families, NoNudgeIsSubnormal) {
    for (const char* name : {"mesh.vertices.ulp", "mesh.edges.ulp", "mesh.faces.ulp", "nearly-degenerate"}) {
        for_each_case(name, [&](const Case& c) {
            for (const double x : c.point) EXPECT_TRUE(x == 0 || std::fabs(x) > 1e-30) << name;
            for (const double x : c.vertices) EXPECT_TRUE(x == 0 || std::fabs(x) > 1e-30) << name;
        });
    }
}

TEST(Families, PixelsAreCentresInTrianglesAndOnEdges) {
    int inside = 0, on_edge = 0, outside = 0;
    double widest = 0, narrowest = 1e9;
    for_each_case("triangle.pixels", [&](const Case& c) {
        double width = 0;
        for (int k = 0; k < 2; ++k) {
            const double p = c.point[static_cast<std::size_t>(k)];
            EXPECT_EQ(p - std::floor(p), 0.5);
            double low = c.vertex(0, k), high = low;
            for (int i = 0; i < 3; ++i) {
                EXPECT_EQ(std::floor(256 * c.vertex(i, k)), 256 * c.vertex(i, k));
                low = std::min(low, c.vertex(i, k));
                high = std::max(high, c.vertex(i, k));
            }
            width = std::max(width, high - low);
        }
        widest = std::max(widest, width);
        narrowest = std::min(narrowest, width);
        const Region r = ask_oracle(c).region;
        inside += r == Region::interior ? 1 : 0;
        on_edge += r == Region::boundary ? 1 : 0;
        outside += r == Region::outside ? 1 : 0;
    });
    EXPECT_GT(inside, 170);
    EXPECT_GT(on_edge, 170);
    EXPECT_LT(outside, 10);  // small triangles without a pixel centre
    EXPECT_GT(widest, 2048);
    EXPECT_LT(widest, 3 * 4096);
    EXPECT_LE(narrowest, 4);
}

TEST(Families, PerspectiveHasDepths) {
    int seen = 0;
    double ratio = 1;
    for (const Family& f : all_families()) {
        if (!f.perspective) continue;
        EXPECT_EQ(f.simplices, std::vector<Simplex>{Simplex::triangle});
        ++seen;
        for_each_case(f.name, [&](const Case& c) {
            EXPECT_TRUE(c.perspective);
            double low = c.depth(0), high = low;
            for (int i = 0; i < 3; ++i) {
                EXPECT_GE(c.depth(i), 1);
                EXPECT_LE(c.depth(i), f.name == "perspective.depth-ratio" ? 0x1p20 : 10.0);
                low = std::min(low, c.depth(i));
                high = std::max(high, c.depth(i));
            }
            ratio = std::max(ratio, high / low);
        });
    }
    EXPECT_EQ(seen, 5);
    EXPECT_GT(ratio, 1e5);
    EXPECT_EQ(share_of("perspective.pixel-edges", zero_weight), 1 - share_of("perspective.pixel-edges", degenerate));
    EXPECT_LT(share_of("perspective.pixel-edges", degenerate), 0.01);
    EXPECT_EQ(share_of("perspective.outside", degenerate), 0);
    // Behind the eye: the signs of the weights are those of the window turned round.
    EXPECT_GT(share_of("perspective.outside",
                       [](const Case& c) {
                           const OracleAnswer a = ask_oracle(c);
                           return std::count(a.signs.begin(), a.signs.end(), 1) == 1 && a.region == Region::outside;
                       }),
              0.1);
}

TEST(Families, EdgeOnIsFlatInTheWindow) {
    for_each_case("perspective.edge-on", [](const Case& c) {
        EXPECT_GT(height(c), 1024 * 0x1p-43);
        EXPECT_LT(height(c), 1024 * 0x1p-9);
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

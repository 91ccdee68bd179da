// Rules on triangles in space: those in use fail where their words say, and barycert's own never do.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
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

namespace barycert {
namespace {

SurfaceAudit audited(std::uint64_t count, std::uint64_t seed, int threads = 0) {
    SurfaceAudit audit{.seed = seed, .count = count, .threads = threads};
    audit_surfaces(audit);
    return audit;
}

const SurfaceTally& tally(const SurfaceAudit& audit, const std::string& rule, const std::string& family) {
    for (const auto& r : audit.results) {
        for (const SurfaceTally& t : r.families) {
            if (r.rule.name == rule && surface_families()[t.family].name == family) return t;
        }
    }
    ADD_FAILURE() << "no " << rule << " on " << family;
    return audit.results.front().total;
}

// barycert's locator and check stand on signs of its own and on integers, the oracle on CGAL's kernel: two programs.
TEST(Surfaces, OwnRulesAgreeWithTheOracleToTheLastBit) {
    const SurfaceAudit audit = audited(400, 7);
    int exact = 0;
    for (const auto& r : audit.results) {
        if (!r.rule.name.ends_with(".exact")) continue;
        ++exact;
        EXPECT_EQ(r.total.wrong_cases(), 0) << r.rule.name;
        EXPECT_LE(r.total.worst.value, 0) << r.rule.name;
        EXPECT_GT(r.total.yes, 0) << r.rule.name;
        EXPECT_GT(r.total.cases, r.total.yes) << r.rule.name;
        for (const SurfaceTally& t : r.families) EXPECT_GT(t.cases, 100) << surface_families()[t.family].name;
    }
    EXPECT_EQ(exact, 3);
}

TEST(Surfaces, OthersFailWhereTheirWordsSay) {
    const SurfaceAudit audit = audited(400, 1);
    const auto wrong = [&](const char* rule, const char* family) { return tally(audit, rule, family).wrong_cases(); };
    // The point it takes is on the triangle, but not the nearest one.
    EXPECT_GT(tally(audit, "distance.clamped-weights", "distance.needle").worst.value, 1e12);
    EXPECT_GT(tally(audit, "distance.clamped-weights", "distance.random").worst.value, 1e12);
    EXPECT_LT(tally(audit, "distance.voronoi-regions", "distance.random").worst.value, 1e6);
    EXPECT_GT(wrong("distance.edges-or-plane", "distance.beside"), 0);
    EXPECT_GT(wrong("distance.quadratic-form", "distance.beside"), 100);
    EXPECT_GT(wrong("distance.voronoi-regions", "distance.scaled"), 0);
    EXPECT_GT(wrong("inside.ray-along-x", "inside.lattice"), 20);
    EXPECT_GT(wrong("inside.ray-along-x", "inside.level"), 20);
    EXPECT_EQ(wrong("inside.ray-half-open", "inside.lattice"), 0) << "what half-open edges are for";
    EXPECT_GT(wrong("inside.ray-half-open", "inside.beside"), 0);
    EXPECT_GT(wrong("inside.ray-aslant", "inside.beside"), 0);
    EXPECT_GT(wrong("inside.solid-angles", "inside.beside"), 0);
    EXPECT_EQ(wrong("inside.solid-angles", "inside.random"), 0);
    EXPECT_GT(wrong("inside.nearest-normal", "inside.corner"), 0);
    EXPECT_GT(tally(audit, "meet.intervals", "meet.scaled").false_yes, 20) << "small ones are all in one plane";
    EXPECT_GT(tally(audit, "meet.intervals-no-tolerance", "meet.touching").false_no, 0);
    EXPECT_GT(tally(audit, "meet.edges-through", "meet.one-plane").false_no, 100);
    EXPECT_GT(wrong("meet.separating-axes", "meet.touching"), 20);
    EXPECT_EQ(wrong("meet.separating-axes", "meet.lattice"), 0) << "small integers: no rounding";
    for (const auto& r : audit.results) {
        if (r.rule.name.ends_with(".exact")) continue;
        EXPECT_GT(r.total.wrong_cases(), 0) << r.rule.name;
    }
}

// D1: the same text of figures, whatever the threads; other seeds make other cases.
TEST(Surfaces, ThreadsChangeNothing) {
    SurfaceAudit one = audited(300, 3, 1), many = audited(300, 3, 5);
    many.threads = one.threads;
    EXPECT_EQ(surfaces_json(one), surfaces_json(many));
    EXPECT_NE(surfaces_json(one), surfaces_json(audited(300, 4, 1)));
}

// A case that a report names can be made again, and shows the fault.
TEST(Surfaces, WrongCasesAreMadeAgain) {
    const SurfaceAudit audit = audited(300, 1);
    int shown = 0;
    for (const auto& r : audit.results) {
        for (const SurfaceTally& t : r.families) {
            if (t.wrong.value < 0) continue;
            const SurfaceFamily& family = surface_families()[t.family];
            const SurfaceCase c = make_surface_case(family, audit.seed, t.wrong.index);
            const double answer = r.rule.answer(c);
            if (family.question == SurfaceQuestion::meet) {
                EXPECT_NE(answer != 0, oracle_meet(c.triangles[0], c.triangles[1])) << r.rule.name;
            } else if (family.question == SurfaceQuestion::inside) {
                EXPECT_EQ(oracle_side(c.triangles, c.point.data()), answer != 0 ? -1 : 1) << r.rule.name;
            } else if (std::isfinite(answer)) {
                EXPECT_NE(answer == 0, oracle_distance(c.triangles[0], c.point.data()) == 0) << r.rule.name;
            }
            ++shown;
        }
    }
    EXPECT_GT(shown, 20);
}

// The oracle on what is known without it.
TEST(Surfaces, OracleOfDistances) {
    const std::array<double, 9> t{0, 0, 0, 4, 0, 0, 0, 4, 0};
    const auto distance = [&](std::array<double, 3> p) { return oracle_distance(t, p.data()); };
    EXPECT_EQ(distance({1, 1, 0}), 0);
    EXPECT_EQ(distance({1, 1, -7}), 7);
    EXPECT_EQ(distance({-3, -4, 12}), 13);
    EXPECT_EQ(distance({2, -3, 4}), 5);
    EXPECT_EQ(distance({4, 4, 0}), std::sqrt(8.0)) << "sqrt rounds correctly, and 8 is exact";
    EXPECT_EQ(distance({1, 1, 0x1p-1074}), 0x1p-1074);
    EXPECT_EQ(distance({-0x1p-1074, -0x1p-1074, 0}), 0x1p-1074) << "sqrt(2) of the smallest number: nearest is 1 of it";
    EXPECT_EQ(distance({1, 1, 1.7e308}), 1.7e308);
    // Over the middle of 0x1p53 + 1, which is no double: to even.
    EXPECT_EQ(oracle_distance(std::array<double, 9>{-1, 0, 0, -1, 4, 0, -1, 0, 4}, std::array{0x1p53, 1.0, 1.0}.data()),
              0x1p53);
    EXPECT_EQ(oracle_distance(std::array<double, 9>{-3, 0, 0, -3, 4, 0, -3, 0, 4}, std::array{0x1p53, 1.0, 1.0}.data()),
              0x1p53 + 4);
}

TEST(Surfaces, OracleOfTrianglesThatMeet) {
    const std::array<double, 9> t{0, 0, 0, 4, 0, 0, 0, 4, 0};
    const auto meet = [&](std::array<double, 9> other) {
        EXPECT_EQ(oracle_meet(t, other), oracle_meet(other, t));
        return oracle_meet(t, other);
    };
    EXPECT_TRUE(meet({1, 1, -1, 1, 1, 1, 9, 9, 1})) << "an edge goes through";
    EXPECT_TRUE(meet({1, 1, 0, 1, 1, 1, 9, 9, 1})) << "a corner touches the face";
    EXPECT_FALSE(meet({1, 1, 0x1p-1074, 1, 1, 1, 9, 9, 1}));
    EXPECT_TRUE(meet({4, 0, 0, 9, 9, 1, 9, 9, 2})) << "a corner in common";
    EXPECT_TRUE(meet({2, 2, 0, 5, 5, 0, 5, 6, 0})) << "in one plane, touching";
    EXPECT_FALSE(meet({2, 0x1.0000000000001p1, 0, 5, 5, 0, 5, 6, 0}));
    EXPECT_TRUE(meet({1, 1, 0, 1.5, 1, 0, 1, 1.5, 0})) << "one within the other";
}

TEST(Surfaces, OracleOfSides) {
    std::vector<TriangleInSpace> box;
    for (const SurfaceFamily& f : surface_families()) {
        if (f.name == "inside.lattice") box = make_surface_case(f, 1, 0).triangles;
    }
    for (double x = -0.5; x <= 3.5; x += 0.5) {
        for (double y = -0.5; y <= 3.5; y += 0.5) {
            for (double z = -0.5; z <= 3.5; z += 0.5) {
                const auto in = [](double v) { return v > 0 && v < 3 ? 1 : v == 0 || v == 3 ? 0 : -1; };
                EXPECT_EQ(oracle_side(box, std::array{x, y, z}.data()), std::min({in(x), in(y), in(z)}));
            }
        }
    }
}

}  // namespace
}  // namespace barycert

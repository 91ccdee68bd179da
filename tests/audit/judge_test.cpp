// Who decides: the core never on itself, and a disagreement ends the audit.

#include "audit/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "audit_helpers.hpp"

namespace barycert::audit {
namespace {

OracleAnswer lies(const Case& c) {
    OracleAnswer a = ask_oracle(c);
    if (a.region == Region::interior && c.point[0] > 0) a.weights[0] = std::nextafter(a.weights[0], 2);
    return a;
}

Result<AuditReport> audit_by(OracleChoice choice, std::vector<Kernel> kernels, std::vector<Family> families,
                             std::uint64_t count, OracleAnswer (*cgal)(const Case&) = ask_cgal) {
    AuditOptions options;
    options.kernels = std::move(kernels);
    options.families = std::move(families);
    options.count = count;
    options.threads = 2;
    options.oracle = choice;
    options.cgal = cgal;
    return run_audit(options, own_meshes());
}

TEST(Judge, TheCoreSaysWhatTheIntegersSayOrNothing) {
    std::uint64_t said = 0, asked = 0;
    for (const Family& family : all_families()) {
        for (const Simplex s : family.simplices) {
            if (family.needs_mesh && !own_meshes().supplies(s)) continue;
            for (std::uint64_t i = 0; i < 200; ++i) {
                const Case c = make_case(family, s, 3, i, own_meshes());
                ++asked;
                if (const auto answer = ask_core(c)) {
                    ++said;
                    EXPECT_TRUE(same_answer(*answer, ask_oracle(c))) << family.name << ' ' << i;
                }
            }
        }
    }
    EXPECT_GT(said, asked / 8);
    EXPECT_LT(said, asked);
}

TEST(Judge, EveryChoiceGivesTheSameReport) {
    const std::vector<Family> families{family_named("mesh.faces"), family_named("huge"),
                                       family_named("lattice.tenths")};
    const auto report = [&](OracleChoice choice) {
        return audit_by(choice, {kernel_named("tetrahedron.signed-volume"), kernel_named("triangle.full-lu")}, families,
                        400)
            .value();
    };
    const AuditReport usual = report(OracleChoice::automatic);
    EXPECT_GT(usual.oracles.core, 0U);
    EXPECT_GT(usual.oracles.integers, 0U);
    EXPECT_GT(usual.oracles.wide, 0U);
    EXPECT_GT(usual.oracles.also_integers, 0U);
    EXPECT_GE(usual.oracles.also_cgal, usual.oracles.wide);
    EXPECT_EQ(usual.oracles.core + usual.oracles.integers, usual.cases);
    for (const OracleChoice choice : {OracleChoice::integers, OracleChoice::cgal, OracleChoice::both}) {
        const AuditReport other = report(choice);
        EXPECT_EQ(other.regions, usual.regions);
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(other.kernels[k].total.counts, usual.kernels[k].total.counts);
            EXPECT_EQ(other.kernels[k].total.weight_ulp.value, usual.kernels[k].total.weight_ulp.value);
        }
        EXPECT_EQ(other.oracles.core, 0U);
        EXPECT_EQ(other.oracles.also_cgal, choice == OracleChoice::both ? other.cases : 0);
        EXPECT_EQ(other.oracles.cgal, choice == OracleChoice::cgal ? other.cases : 0);
    }
}

TEST(Judge, TheCoreIsNoJudgeOfItself) {
    Kernel promises = kernel_named("tetrahedron.inverse");
    promises.certifies = true;
    for (const Kernel& k : {kernel_named("tetrahedron.exact"), promises}) {
        const AuditReport report = audit_by(OracleChoice::automatic, {k, kernel_named("tetrahedron.signed-volume")},
                                            {family_named("mesh.inside")}, 400)
                                       .value();
        EXPECT_EQ(report.oracles.core, 0U);
        EXPECT_EQ(report.oracles.integers, 400U);
    }
    for (const Kernel& k : catalogue()) EXPECT_EQ(k.core, k.certifies) << k.name;
}

TEST(Judge, TheFirstDisagreementIsToldAndWhoTheyAre) {
    const Family family = family_named("mesh.inside");
    std::uint64_t first = 0;
    const auto agree = [&] {
        const Case c = make_case(family, Simplex::tetrahedron, AuditOptions{}.seed, first, own_meshes());
        return same_answer(lies(c), ask_oracle(c));
    };
    while (agree()) ++first;
    const auto both = audit_by(OracleChoice::both, {kernel_named("tetrahedron.inverse")}, {family}, 2000, lies);
    ASSERT_FALSE(both.has_value());
    EXPECT_NE(both.error().message().find(", case " + std::to_string(first) + ","), std::string::npos);
    EXPECT_TRUE(both.error().expected.starts_with("integers: ")) << both.error().expected;
    EXPECT_TRUE(both.error().found.starts_with("CGAL: ")) << both.error().found;
    // The core answers first where no kernel is made of it.
    const auto by_core = audit_by(OracleChoice::automatic, {kernel_named("tetrahedron.inverse")}, {family}, 2000, lies);
    ASSERT_FALSE(by_core.has_value());
    EXPECT_TRUE(by_core.error().expected.starts_with("the core: ")) << by_core.error().expected;
}

TEST(Judge, ADisagreementIsAnErrorWithTheCase) {
    for (const OracleChoice choice : {OracleChoice::automatic, OracleChoice::both}) {
        for (const char* kernel : {"tetrahedron.signed-volume", "tetrahedron.exact"}) {
            const auto report = audit_by(choice, {kernel_named(kernel)}, {family_named("mesh.inside")}, 2000, lies);
            ASSERT_FALSE(report.has_value());
            const std::string message = report.error().message();
            EXPECT_NE(message.find("two oracles disagree"), std::string::npos) << message;
            EXPECT_NE(message.find("family mesh.inside, case "), std::string::npos) << message;
            for (const char* numbers : {", vertices 0x", ", point 0x", ", values 0x"})
                EXPECT_NE(message.find(numbers), std::string::npos) << message;
            EXPECT_NE(message.find("CGAL: interior, weights 0x"), std::string::npos) << message;
        }
    }
    EXPECT_TRUE(
        audit_by(OracleChoice::integers, {kernel_named("tetrahedron.exact")}, {family_named("mesh.inside")}, 2000, lies)
            .has_value());
}

}  // namespace
}  // namespace barycert::audit

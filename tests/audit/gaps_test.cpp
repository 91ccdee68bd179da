// Gaps and overlaps: what exact weights do at shared faces is known, and kernels with a known fault are found out.

#include "barycert/gaps.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/mutants.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "audit/gap_points.hpp"
#include "audit_helpers.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/weights.hpp"

namespace barycert::audit {
namespace {

Mesh own_mesh(const std::string& name) {
    return read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + name).value();
}

GapsReport gaps_of(std::vector<Kernel> kernels, const Mesh& mesh, int threads = 2) {
    GapsOptions options;
    options.kernels = std::move(kernels);
    options.count = 1500;
    options.threads = threads;
    return find_gaps(options, mesh, "mesh", Verdict::not_checked).value();
}

const ClaimResult& result_of(const GapsReport& report, const std::string& kernel, ClaimRule rule) {
    for (const ClaimResult& r : report.results) {
        if (r.kernel == kernel && r.rule == rule) return r;
    }
    ADD_FAILURE() << kernel;
    return report.results.front();
}

TEST(Gaps, ExactArithmeticLosesNothingAndSoDoesTheExactKernel) {
    for (const char* mesh : {"bracket", "plate", "lattice-box"}) {
        SCOPED_TRACE(mesh);
        const Mesh m = own_mesh(mesh);
        const std::string kernel = m.dimension == 2 ? "triangle.exact" : "tetrahedron.exact";
        const GapsReport report = gaps_of({kernel_named(kernel)}, m);
        const std::uint64_t points = (m.dimension == 2 ? 2 : 3) * std::uint64_t{1500};
        for (const std::string& who : {std::string(), kernel}) {
            const ClaimCounts closed = result_of(report, who, ClaimRule::exact).total();
            EXPECT_EQ(closed.inside + closed.outside, points);
            EXPECT_GT(closed.inside, points / 2);
            EXPECT_EQ(closed.of(ClaimFault::gap), 0U);
            EXPECT_EQ(closed.of(ClaimFault::wrong), 0U);
            EXPECT_EQ(closed.of(ClaimFault::outside_claimed), 0U);
            // A point on what cells share lies in several.
            EXPECT_GT(closed.of(ClaimFault::several), 100U);
            const ClaimCounts open = result_of(report, who, ClaimRule::strict).total();
            // Open cells lose what closed ones share, and what lies on the hull.
            EXPECT_GE(open.of(ClaimFault::gap), closed.of(ClaimFault::several));
            EXPECT_EQ(open.of(ClaimFault::several), 0U);
            EXPECT_EQ(open.of(ClaimFault::wrong), 0U);
        }
        EXPECT_EQ(report.oracles.core, 0U) << "the core judges itself";
    }
}

/// Exact weights, moved.
template <int shift>
int moved(const double* v, const double* p, double* w) {
    const Weights exact = barycentric_weights(Simplex::tetrahedron, v, p).value();
    for (std::size_t i = 0; i < 4; ++i) w[i] = exact.weights[i] + shift * 1e-6;
    return exact.degenerate ? 1 : 0;
}

TEST(Gaps, ShrunkenAndSwollenCellsAreFound) {
    const Mesh mesh = own_mesh("bracket");
    Kernel shrunken = kernel_named("tetrahedron.signed-volume"), swollen = shrunken, own = shrunken;
    shrunken.name = "shrunken";
    shrunken.weights = moved<-1>;
    shrunken.core = true;
    swollen.name = "swollen";
    swollen.weights = moved<1>;
    swollen.core = true;
    const GapsReport report = gaps_of({shrunken, swollen, kernel_named("tetrahedron.vtk-tolerance")}, mesh);
    const ClaimCounts small = result_of(report, "shrunken", ClaimRule::exact).total(),
                      large = result_of(report, "swollen", ClaimRule::exact).total();
    EXPECT_EQ(small.of(ClaimFault::gap), small.inside);
    EXPECT_EQ(small.of(ClaimFault::several), 0U);
    EXPECT_EQ(large.of(ClaimFault::gap), 0U);
    EXPECT_GT(large.of(ClaimFault::several), large.inside * 9 / 10);
    EXPECT_GT(large.of(ClaimFault::wrong), large.inside / 4);
    EXPECT_EQ(large.of(ClaimFault::outside_claimed), large.outside);
    EXPECT_GT(large.outside, 0U);
    // 1e-10 is less than the swelling, and a rule of its own has more slack still.
    EXPECT_EQ(result_of(report, "shrunken", ClaimRule::tolerant).total().of(ClaimFault::gap), small.inside);
    const ClaimCounts vtk = result_of(report, "tetrahedron.vtk-tolerance", ClaimRule::own).total();
    EXPECT_EQ(vtk.of(ClaimFault::gap), 0U);
    EXPECT_GT(vtk.of(ClaimFault::wrong), vtk.inside / 4);
    EXPECT_TRUE(std::none_of(report.results.begin(), report.results.end(),
                             [](const ClaimResult& r) { return r.kernel == "shrunken" && r.rule == ClaimRule::own; }));
}

TEST(Gaps, WitnessesNameCellsOfTheFile) {
    const Mesh mesh = own_mesh("bracket");
    const GapsReport report =
        gaps_of({kernel_named("tetrahedron.unsigned-volume"), kernel_named("tetrahedron.inverse")}, mesh);
    int seen = 0;
    const GapPoints points(mesh);
    for (const ClaimResult& r : report.results) {
        for (const auto& [fault, w] : r.witnesses) {
            ++seen;
            const GapPoint p = points.make(w.feature, report.seed, w.index);
            EXPECT_EQ(p.point, w.point);
            EXPECT_EQ(p.nodes, w.nodes);
            std::vector<Mesh::Index> holders;
            for (const Mesh::Index cell : p.cells) {
                const Region region = ask_oracle(points.case_of(cell, p.point)).region;
                if (region == Region::interior || region == Region::boundary) holders.push_back(cell);
            }
            EXPECT_EQ(holders, w.holders);
            EXPECT_EQ(w.claimants.empty(), fault == ClaimFault::gap);
            if (fault == ClaimFault::several) {
                EXPECT_GT(w.claimants.size(), 1U);
            }
            if (fault == ClaimFault::wrong_first) {
                EXPECT_EQ(std::count(holders.begin(), holders.end(), w.claimants.front()), 0);
            }
        }
    }
    EXPECT_GT(seen, 10);
}

TEST(Gaps, AReportDoesNotDependOnThreads) {
    const Mesh mesh = own_mesh("plate");
    const std::vector<Kernel> kernels = kernels_matching("triangle.*");
    const GapsReport one = gaps_of(kernels, mesh, 1), four = gaps_of(kernels, mesh, 4);
    ASSERT_EQ(one.results.size(), four.results.size());
    EXPECT_EQ(one.oracles, four.oracles);
    for (std::size_t k = 0; k < one.results.size(); ++k) {
        EXPECT_EQ(one.results[k].total().faults, four.results[k].total().faults);
        ASSERT_EQ(one.results[k].witnesses.size(), four.results[k].witnesses.size());
        for (const auto& [fault, w] : one.results[k].witnesses)
            EXPECT_EQ(w.point, four.results[k].witnesses.at(fault).point);
    }
}

TEST(Gaps, NeedsAKernelForTheCells) {
    GapsOptions options;
    options.kernels = kernels_matching("segment.*");
    const auto report = find_gaps(options, own_mesh("plate"), "plate", Verdict::not_checked);
    ASSERT_FALSE(report.has_value());
    EXPECT_EQ(report.error().expected, "a kernel for a triangle");
    EXPECT_FALSE(find_gaps(options, Mesh(), "empty", Verdict::not_checked).has_value());
}

TEST(Gaps, WhatAKernelDoesNotAnswerIsCounted) {
    const Kernel always = load_contained_kernel(std::string(BARYCERT_UNRULY_DIR) + "/unruly-always.so").value();
    const Mesh mesh = own_mesh("bracket");
    GapsOptions options;
    options.kernels = {always, kernel_named("tetrahedron.signed-volume")};
    options.count = 30;
    const GapsReport report = find_gaps(options, mesh, "mesh", Verdict::not_checked).value();
    const OracleCounts& o = report.oracles;
    for (const ClaimRule rule : {ClaimRule::strict, ClaimRule::exact, ClaimRule::tolerant}) {
        EXPECT_EQ(result_of(report, always.name, rule).unanswered, o.core + o.integers + o.cgal);
        EXPECT_EQ(result_of(report, "tetrahedron.signed-volume", rule).unanswered, 0U);
        EXPECT_EQ(result_of(report, "", rule).unanswered, 0U);
    }
    EXPECT_NE(gaps_text(report, {}).find("gave no answer to"), std::string::npos);
}

}  // namespace
}  // namespace barycert::audit

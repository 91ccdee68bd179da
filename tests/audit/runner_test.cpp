// The runner: independent of threads, bounded, honest about what it was given.

#include <gtest/gtest.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <atomic>
#include <chrono>
#include <cmath>

#include "audit/block.hpp"
#include "audit_helpers.hpp"
#include "barycert/audit_report.hpp"

namespace barycert::audit {
namespace {

std::string without_times(AuditReport r) {
    r.seconds = 0;
    r.threads = 0;
    std::stable_sort(r.kernels.begin(), r.kernels.end(),
                     [](const auto& a, const auto& b) { return a.kernel.name < b.kernel.name; });
    for (KernelResult& k : r.kernels) k.ns = 0;
    return audit_json(r);
}

TEST(Runner, ThreadsChangeNothing) {
    const auto kernels = kernels_matching("*.signed-*");
    const std::vector<Family> families{family_named("mesh.faces"), family_named("lattice.tenths"),
                                       family_named("huge")};
    const std::string one = without_times(audit_of(kernels, families, 3000, own_meshes(), 1));
    EXPECT_EQ(one, without_times(audit_of(kernels, families, 3000, own_meshes(), 2)));
    EXPECT_EQ(one, without_times(audit_of(kernels, families, 3000, own_meshes(), 7)));
}

TEST(Runner, CountsAreWhatWasAskedFor) {
    for (const std::uint64_t count : {1U, 255U, 256U, 257U, 1000U}) {
        const AuditReport r = audit_of(kernels_matching("tetrahedron.c*"), {family_named("random")}, count);
        EXPECT_EQ(r.cases, count);
        for (const KernelResult& k : r.kernels) EXPECT_EQ(k.total.cases, count);
    }
}

TEST(Runner, ConfusionHoldsEveryCase) {
    const AuditReport r = audit_of(kernels_matching("triangle.*"), {family_named("lattice.integers")}, 1000);
    for (const KernelResult& k : r.kernels) {
        std::uint64_t sum = 0;
        for (const auto& row : k.total.confusion) {
            for (const auto n : row) sum += n;
        }
        EXPECT_EQ(sum, k.total.cases) << k.kernel.name;
    }
}

TEST(Runner, AllKernelsMeetTheSameCases) {
    const AuditReport r = audit_of(kernels_matching("tetrahedron.*"), {family_named("lattice.tenths")}, 1000);
    for (const KernelResult& k : r.kernels) {
        for (std::size_t exact = 0; exact < 4; ++exact) {
            std::uint64_t sum = 0, first = 0;
            for (std::size_t claimed = 0; claimed < 4; ++claimed) {
                sum += k.total.confusion[exact][claimed];
                first += r.kernels.front().total.confusion[exact][claimed];
            }
            EXPECT_EQ(sum, first) << k.kernel.name;
        }
    }
}

TEST(Runner, NothingToAuditIsAnError) {
    AuditOptions options;
    options.kernels = kernels_matching("triangle.*");
    options.families = {family_named("degenerate.plane")};  // tetrahedra only
    const auto r = run_audit(options, {});
    ASSERT_FALSE(r);
    EXPECT_FALSE(r.error().remedy.empty());
}

TEST(Runner, MeshFamiliesAreLeftOutWithoutAMesh) {
    const AuditReport r =
        audit_of(kernels_matching("tetrahedron.kahan"), {family_named("mesh.inside"), family_named("random")}, 100);
    ASSERT_EQ(r.kernels.size(), 1U);
    EXPECT_EQ(r.kernels[0].families.size(), 1U);
    EXPECT_EQ(r.cases, 100U);
}

TEST(Runner, TellsProgressToTheEnd) {
    AuditOptions options;
    options.kernels = kernels_matching("tetrahedron.kahan");
    options.families = {family_named("random"), family_named("tiny")};
    options.count = 2000;
    options.threads = 1;
    std::vector<std::uint64_t> told;
    options.progress = [&](const AuditProgress& p) {
        EXPECT_EQ(p.cases_total, 4000U);
        told.push_back(p.cases_done);
    };
    ASSERT_TRUE(run_audit(options, {}));
    ASSERT_FALSE(told.empty());
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 4000U);
}

// Kernels meet the cases that they are for.
TEST(Runner, PerspectiveKernelsMeetPerspectiveCasesAlone) {
    const AuditReport r =
        audit_of(kernels_matching("triangle.*"), {family_named("random"), family_named("perspective.ordinary")}, 50);
    ASSERT_EQ(r.kernels.size(), kernels_matching("triangle.*").size());
    for (const KernelResult& k : r.kernels) {
        ASSERT_EQ(k.families.size(), 1U) << k.kernel.name;
        EXPECT_EQ(k.families[0].family, k.kernel.perspective ? 1U : 0U) << k.kernel.name;
        if (k.kernel.perspective) {
            EXPECT_EQ(k.prediction.cases(), 0U) << k.kernel.name;
        }
    }
    EXPECT_EQ(r.cases, 100U);
    AuditOptions options;
    options.kernels = kernels_matching("triangle.signed-area");
    options.families = {family_named("perspective.ordinary")};
    EXPECT_FALSE(run_audit(options, {}));
}

/// A kernel with tasks of its own: while it waits for them, its thread looks for other work.
int with_tasks(const double* v, const double* p, double* w) {
    std::atomic<int> sum{0};
    tbb::parallel_for(
        tbb::blocked_range<int>(0, 8, 1),
        [&](const auto& range) {
            const auto until = std::chrono::steady_clock::now() + std::chrono::microseconds(5);
            while (std::chrono::steady_clock::now() < until) {
            }
            sum += range.begin();
        },
        tbb::simple_partitioner());
    const int status = kernel_named("tetrahedron.signed-volume").weights(v, p, w);
    return sum == 28 ? status : 1;
}

TEST(Runner, KernelsMayHaveTasksOfTheirOwn) {
    Kernel k = kernel_named("tetrahedron.signed-volume");
    const auto figures = [&] {
        return without_times(audit_of({k}, {family_named("mesh.faces")}, 2000, own_meshes(), 4));
    };
    const std::string alone = figures();
    k.weights = with_tasks;
    EXPECT_EQ(figures(), alone);
}

/// Finite weights so far off that sums over them overflow, in either direction.
int wild_triangle3d(const double*, const double* p, double* w) {
    w[0] = p[0] > 0 ? 1e200 : 1;
    w[1] = -1e200;
    w[2] = 1;
    return 0;
}
int wild_tetrahedron(const double*, const double* p, double* w) {
    for (int i = 0; i < 4; ++i) w[i] = p[0] > 0 ? 0x1p1023 : 3;
    return 0;
}

Kernel wild(const std::string& like, WeightsFunction weights) {
    Kernel k = kernel_named(like);
    k.weights = weights;
    return k;
}

// The residuals kept are the worst of all cases although most are never computed, and of the first such case in
// whatever order blocks come: compared with computing them all.
TEST(Runner, SkippingResidualsLosesNothing) {
    std::vector<Kernel> kernels{wild("triangle3d.gram", wild_triangle3d),
                                wild("tetrahedron.signed-volume", wild_tetrahedron)};
    for (const char* name : {"tetrahedron.homogeneous", "triangle.beta-gamma", "triangle3d.gram", "segment.projection",
                             "tetrahedron.trilinear"})
        kernels.push_back(kernel_named(name));
    constexpr std::uint64_t count = block_size + 44;
    for (const Kernel& kernel : kernels) {
        for (const char* family :
             {"random", "needle", "lattice.tenths", "subnormal", "mixed-scale", "offset.2^20", "huge"}) {
            const Family& f = family_named(family);
            if (!f.applies_to(kernel.simplex)) continue;
            const MeshSource none;
            const std::vector<Kernel> one{kernel};
            const Job job{f, kernel.simplex, 1, none, one, Judge(OracleChoice::integers, false)};
            JobResult result(1);
            run_block(job, block_size, count, result);
            run_block(job, 0, block_size, result);
            const KernelStatistics& s = result.kernels[0].statistics;
            WorstCase partition, reproduction;
            for (std::uint64_t i = 0; i < count; ++i) {
                const Case c = make_case(f, kernel.simplex, 1, i, {});
                std::array<double, 4> w{};
                if (kernel.weights(c.vertices.data(), c.point.data(), w.data()) != 0 ||
                    ask_oracle(c).region == Region::degenerate)
                    continue;
                const std::span<const double> weights(w.data(), static_cast<std::size_t>(vertex_count(c.simplex)));
                if (!std::all_of(weights.begin(), weights.end(), [](double x) { return std::isfinite(x); })) continue;
                partition.include(std::fabs(partition_residual(weights)), i);
                reproduction.include(reproduction_residual(c, weights), i);
            }
            for (const auto& [kept, exact] :
                 {std::pair(s.partition_residual, partition), std::pair(s.reproduction_residual, reproduction)}) {
                EXPECT_EQ(kept.value, exact.value) << kernel.name << " " << family;
                EXPECT_EQ(kept.index, exact.index) << kernel.name << " " << family;
            }
        }
    }
}

}  // namespace
}  // namespace barycert::audit

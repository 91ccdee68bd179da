// Kernels in a process of their own: each accident is told with the case that did it, and the audit goes on.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <new>

#include "audit/asking.hpp"
#include "audit/kernels/channel.hpp"
#include "audit_helpers.hpp"
#include "tests/processes.hpp"
#include "tests/sanitized.hpp"

namespace barycert::audit {
namespace {

constexpr std::uint64_t some = 2000;

std::string library(const std::string& name) {
    return std::string(BARYCERT_UNRULY_DIR) + "/unruly-" + name + ".so";
}

Kernel contained(const std::string& name, double seconds = 1) {
    return load_contained_kernel(library(name), seconds).value();
}

/// As in unruly_kernel.c.
bool unruly(const Case& c) {
    const auto bits = std::bit_cast<std::uint64_t>(c.point[0]);
    return (bits ^ (bits >> 11) ^ (bits >> 23)) % 32 == 0;
}

std::uint64_t unruly_cases(const std::string& family, std::uint64_t count) {
    std::uint64_t n = 0;
    for (std::uint64_t i = 0; i < count; ++i)
        n += unruly(make_case(family_named(family), Simplex::tetrahedron, 1, i, own_meshes())) ? 1 : 0;
    return n;
}

void expect_same_figures(const KernelStatistics& a, const KernelStatistics& b) {
    EXPECT_EQ(a.cases, b.cases);
    EXPECT_EQ(a.wrong_cases, b.wrong_cases);
    EXPECT_EQ(a.counts, b.counts);
    EXPECT_EQ(a.confusion, b.confusion);
    EXPECT_EQ(a.weight_ulp.value, b.weight_ulp.value);
    EXPECT_EQ(a.value_ulp.value, b.value_ulp.value);
    EXPECT_EQ(a.partition_residual.value, b.partition_residual.value);
}

TEST(Contained, AKernelThatBehavesHasTheSameFiguresAsInThisProcess) {
    const Kernel inside = load_kernel_library(library("quiet")).value(), apart = contained("quiet");
    EXPECT_EQ(inside.name, apart.name);
    EXPECT_EQ(apart.weights, nullptr);
    for (const char* family : {"mesh.faces", "huge", "degenerate.plane"})
        expect_same_figures(statistics_of(inside, family, some, own_meshes()),
                            statistics_of(apart, family, some, own_meshes()));
    const AuditReport report = audit_of({apart}, {family_named("mesh.inside")}, some, own_meshes());
    EXPECT_GT(report.kernels[0].ns, 1);
    EXPECT_LT(report.kernels[0].ns, 10000);
}

TEST(Contained, EveryAccidentIsToldWithItsCase) {
    struct Accident {
        const char* name;
        Finding finding;
        const char* says;
        bool answers;
    };
    const std::uint64_t expected = unruly_cases("mesh.inside", some);
    ASSERT_GT(expected, some / 64);
    for (const Accident& a : {
             Accident{"crash", Finding::crashed, "SIGFPE", false},
                 Accident{"exit", Finding::crashed, "it called exit, status ", false},
                 Accident{"after", Finding::out_of_bounds, "beside its arrays", false},
                 Accident{"before", Finding::out_of_bounds, "in front of the weights", true},
                 Accident{"input", Finding::out_of_bounds, "wrote to its input", false},
                 Accident{"read-after", Finding::out_of_bounds, "beside its arrays", false},
                 Accident{"stack", Finding::crashed, "SIGSEGV", false},
                 Accident{"raise", Finding::crashed, "SIGSEGV", false},
                 Accident{"close", Finding::crashed, "closed descriptors that it had not opened", false},
                 Accident{"hoard", Finding::crashed, "SIGSEGV", false},
                 Accident{"group", Finding::crashed, "SIGKILL", false},
                 Accident{"called-daemon", Finding::crashed, "it called exit, status 0", false},
                 Accident{"forks", Finding::forked, "left a process behind", true},
                 Accident{"clones", Finding::forked, "left a process behind", true},
                 Accident{"spinner", Finding::forked, "left a process behind", true},
                 Accident{"daemon", Finding::forked, "left a process behind", true},
                 Accident{"spawn", Finding::forked, "left a process behind", true},
                 Accident{"round", Finding::changed_environment, "rounding upward", true},
#if defined(__x86_64__)
                 Accident{"flush", Finding::changed_environment, "flushed to zero", true},
#endif
                 Accident {
                 "print", Finding::printed, "wrote \"point ", true
             }
         }) {
        SCOPED_TRACE(a.name);
        if (testing::sanitized && a.name == std::string("hoard")) continue;  // its allocator ends the process itself
        const test::Orphanage orphanage;
        {
            const AuditReport report = audit_of({contained(a.name)}, {family_named("mesh.inside")}, some, own_meshes());
            const KernelResult& k = report.kernels.at(0);
            EXPECT_EQ(k.total.cases, some);
            EXPECT_EQ(k.total.not_run, 0U);
            EXPECT_EQ(count_of(k.total, a.finding), expected);
            EXPECT_EQ(k.total.wrong_cases, expected);
            ASSERT_FALSE(k.witnesses.empty());
            const Witness& w = k.witnesses.front();
            EXPECT_EQ(w.reason, name(a.finding));
            EXPECT_TRUE(unruly(w.c));
            EXPECT_NE(w.detail.find(a.says), std::string::npos) << w.detail;
            const Replay replay = replay_witness(w, {k.kernel});
            EXPECT_EQ(replay.not_reproduced, "");
            EXPECT_EQ(replay.answers.at(0).answered, a.answers);
            // The kernel's answers in those cases are right, or not there at all.
            EXPECT_EQ(k.total.confusion[0][0], a.answers ? some : some - expected);
        }
        EXPECT_EQ(orphanage.left_behind(), 0U);
    }
}

TEST(Contained, AProcessThatAKernelForksHasNoPartInItsAnswers) {
    const Kernel quiet = contained("quiet");
    for (const char* name : {"fork", "forks", "clones"}) {
        SCOPED_TRACE(name);
        KernelStatistics s = statistics_of(contained(name), "mesh.inside", some, own_meshes());
        std::uint64_t& forked = s.counts[static_cast<std::size_t>(Finding::forked)];
        EXPECT_GT(forked, 0U);
        s.wrong_cases -= forked;
        forked = 0;
        expect_same_figures(s, statistics_of(quiet, "mesh.inside", some, own_meshes()));
    }
    // A process that goes on after the kernel's crash does not hide the crash.
    const std::uint64_t expected = unruly_cases("mesh.inside", 200);
    const KernelStatistics s = statistics_of(contained("orphan"), "mesh.inside", 200, own_meshes());
    EXPECT_EQ(count_of(s, Finding::crashed), expected);
    EXPECT_EQ(count_of(s, Finding::hung), 0U);
    EXPECT_EQ(s.cases, 200U);
}

TEST(Contained, AHangCostsTheTimeLimitAndNoMore) {
    const std::uint64_t expected = unruly_cases("mesh.inside", 200);
    ASSERT_GT(expected, 0U);
    ASSERT_LT(expected, 14U);
    const KernelStatistics s = statistics_of(contained("hang", 0.05), "mesh.inside", 200, own_meshes());
    EXPECT_EQ(count_of(s, Finding::hung), expected);
    EXPECT_EQ(s.wrong_cases, expected);
    EXPECT_EQ(s.cases, 200U);
}

TEST(Contained, TheTimeLimitIsForACaseAndNotForAll) {
    ASSERT_GT(unruly_cases("mesh.inside", 256), 5U);  // in one batch, 0.15 s each
    const KernelStatistics s = statistics_of(contained("slow", 0.5), "mesh.inside", 256, own_meshes());
    EXPECT_EQ(s.wrong_cases, 0U);
    EXPECT_EQ(s.cases, 256U);
}

Case case_that_is(bool unruly_one) {
    for (std::uint64_t i = 0;; ++i) {
        Case c = make_case(family_named("mesh.inside"), Simplex::tetrahedron, 1, i, own_meshes());
        if (unruly(c) == unruly_one) return c;
    }
}

TEST(Contained, ACaseThatIsRunAgainHasItsTimeAgain) {
    const Kernel k = contained("slow-print", 0.4);
    const Case quiet = case_that_is(false), loud = case_that_is(true);
    Statement said;
    ask_kernel(k, std::span(&quiet, 1), std::span(&said, 1), false);
    EXPECT_EQ(said.incidents, 0);
    // 0.3 s; then again, to see whether it is this case that prints; then again, against the clock.
    ask_kernel(k, std::span(&loud, 1), std::span(&said, 1), true);
    EXPECT_TRUE(said.answered);
    EXPECT_EQ(said.incidents, kernels::incident_printed);
}

TEST(Contained, LoadingCountsInNoCase) {
    // Each thread's process loads the library anew, and so does one that takes a crashed one's place.
    const KernelStatistics s = statistics_of(contained("slow-loading", 0.1), "mesh.inside", some, own_meshes());
    EXPECT_EQ(s.wrong_cases, 0U);
    EXPECT_EQ(s.cases, some);
}

TEST(Contained, OutputIsToldThoughItComesButOnce) {
    for (const std::size_t before : {0, 3}) {  // in the first batch of a process each case is watched
        const Kernel k = contained("once");
        const Case quiet = case_that_is(false), loud = case_that_is(true);
        std::vector<Statement> said(3);
        for (std::size_t i = 0; i < before; ++i) {
            ask_kernel(k, std::span(&quiet, 1), std::span(said).first(1), false);
            EXPECT_EQ(said[0].incidents, 0);
        }
        const std::vector<Case> cases{quiet, loud, quiet};
        const Asked asked = ask_kernel(k, cases, said, false);
        EXPECT_EQ(said[0].incidents + said[1].incidents + said[2].incidents, kernels::incident_printed);
        EXPECT_EQ(said[before == 0 ? 1 : 0].incidents, kernels::incident_printed);
        EXPECT_EQ(asked.detail, "wrote \"once\\n\"");
    }
}

/// Shared by this process and those that it forks.
std::atomic<bool>* ended_here = nullptr;

TEST(Contained, WhatTheProgramDoesAtItsEndIsNotDoneByAKernelSExit) {
    void* const shared =
        mmap(nullptr, sizeof(std::atomic<bool>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(shared, MAP_FAILED);
    ended_here = new (shared) std::atomic<bool>(false);
    ASSERT_EQ(std::atexit([] { *ended_here = true; }), 0);
    const Kernel k = contained("exit");
    const Case loud = case_that_is(true);
    Statement said;
    EXPECT_EQ(ask_kernel(k, std::span(&loud, 1), std::span(&said, 1), false).detail, "it called exit, status 3");
    EXPECT_EQ(said.incidents, kernels::incident_crashed);
    EXPECT_FALSE(*ended_here);
}

TEST(Contained, OneThatForksAtEveryCallIsGivenUp) {
    const auto begun = std::chrono::steady_clock::now();
    const test::Orphanage orphanage;
    for (const char* name : {"forks-always", "deaf"}) {
        SCOPED_TRACE(name);
        const KernelStatistics s = statistics_of(contained(name, 0.05), "mesh.inside", 5000, own_meshes());
        // 1024, if each cost its patience once; a case that hangs costs it again where it is run against the clock.
        EXPECT_GE(count_of(s, Finding::forked) + 2 * 64 * count_of(s, Finding::hung), 1024U);
        EXPECT_LE(count_of(s, Finding::forked) + 64 * count_of(s, Finding::hung), 1024U + 2 * 256);
        EXPECT_GT(s.not_run, 0U);
        EXPECT_EQ(s.cases + s.not_run, 5000U);
        EXPECT_EQ(s.wrong_cases, count_of(s, Finding::forked) + count_of(s, Finding::hung));
    }
    EXPECT_EQ(orphanage.left_behind(), 0U);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(60));
}

TEST(Contained, LimitsThatAKernelLowersAreItsOwn) {
    expect_same_figures(statistics_of(contained("limits"), "mesh.inside", some, own_meshes()),
                        statistics_of(contained("quiet"), "mesh.inside", some, own_meshes()));
}

TEST(Contained, TheEndOfTheServerIsNoFaultOfTheKernel) {
    const std::vector<pid_t> before = test::children();
    const Kernel k = contained("quiet");
    std::vector<pid_t> after = test::children();
    std::erase_if(after, [&](pid_t p) { return std::find(before.begin(), before.end(), p) != before.end(); });
    if (after.empty()) GTEST_SKIP() << "this system does not list child processes";
    ASSERT_EQ(after.size(), 1U);
    const Case c = case_that_is(false);
    Statement said;
    ask_kernel(k, std::span(&c, 1), std::span(&said, 1), false);
    EXPECT_TRUE(said.answered);
    const std::string keeper = std::to_string(after[0]);
    pid_t server = 0;
    ASSERT_TRUE(std::ifstream("/proc/" + keeper + "/task/" + keeper + "/children") >> server);
    kill(server, SIGKILL);
    siginfo_t ended{};  // its keeper, after all workers; it is left for the Host to wait for
    ASSERT_EQ(waitid(P_PID, static_cast<id_t>(after[0]), &ended, WEXITED | WNOWAIT), 0);
    EXPECT_EQ(ask_kernel(k, std::span(&c, 1), std::span(&said, 1), false).detail, "");
    EXPECT_FALSE(said.ran);
    EXPECT_EQ(said.incidents, 0);
}

TEST(Contained, OneThatKillsTheServerLeavesNothingBehind) {
    const test::Orphanage orphanage;
    const KernelStatistics s = statistics_of(contained("escape"), "mesh.inside", some, own_meshes());
    EXPECT_GT(s.not_run, 0U);
    EXPECT_EQ(s.cases + s.not_run, some);
    EXPECT_EQ(orphanage.left_behind(), 0U);
}

TEST(Contained, FiguresDoNotDependOnThreads) {
    for (const char* name : {"crash", "print", "round"}) {
        const auto figures = [&](int threads) {
            return audit_of({contained(name)}, {family_named("mesh.faces")}, some, own_meshes(), threads)
                .kernels.at(0)
                .total;
        };
        expect_same_figures(figures(1), figures(4));
    }
}

TEST(Contained, WhatNeverAnswersIsGivenUpAndSaidToBe) {
    const AuditReport report = audit_of({contained("always")}, {family_named("mesh.inside")}, 5000, own_meshes());
    const KernelStatistics& s = report.kernels.at(0).total;
    EXPECT_GE(count_of(s, Finding::crashed), 1024U);
    EXPECT_LT(count_of(s, Finding::crashed), 1100U);
    EXPECT_EQ(s.cases, count_of(s, Finding::crashed));
    EXPECT_EQ(s.cases + s.not_run, 5000U);
    EXPECT_EQ(report.cases, 5000U);
    // The witness says how it failed, for which the kernel is asked once more.
    ASSERT_FALSE(report.kernels[0].witnesses.empty());
    EXPECT_NE(report.kernels[0].witnesses[0].detail.find("SIGABRT"), std::string::npos);
    EXPECT_EQ(report.regions[0] + report.regions[1] + report.regions[2], 5000U);
}

TEST(Contained, FewOpenFilesAreEnough) {
    rlimit usual{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &usual), 0);
    rlimit few = usual;
    few.rlim_cur = 100;
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);
    const Result<Kernel> kernel = load_contained_kernel(library("quiet"));
    setrlimit(RLIMIT_NOFILE, &usual);
    ASSERT_TRUE(kernel.has_value()) << kernel.error().message();
    EXPECT_EQ(statistics_of(*kernel, "mesh.inside", some, own_meshes()).wrong_cases, 0U);
}

TEST(Contained, WhatDoesNotLoadIsRefused) {
    const Result<Kernel> loading = load_contained_kernel(library("loading"));
    ASSERT_FALSE(loading.has_value());
    EXPECT_NE(loading.error().found.find("SIGABRT"), std::string::npos) << loading.error().message();
    const Result<Kernel> none = load_contained_kernel(library("none"));
    ASSERT_FALSE(none.has_value());
    EXPECT_EQ(none.error().what, "cannot load the kernel library");
}

TEST(Contained, AKernelSOwnRuleAndValuesAreWhatIsJudged) {
    const Kernel inside = load_kernel_library(library("rule")).value(), apart = contained("rule");
    EXPECT_EQ(inside.rule, RegionRule::own);
    EXPECT_EQ(apart.rule, RegionRule::own);
    EXPECT_TRUE(apart.host != nullptr);
    const char* const family = "random";
    const KernelStatistics own = statistics_of(apart, family, some, own_meshes());
    expect_same_figures(own, statistics_of(inside, family, some, own_meshes()));
    // By signs it is right; by its rule, points up to a quarter outside are inside.
    const KernelStatistics plain = statistics_of(contained("quiet"), family, some, own_meshes());
    EXPECT_EQ(count_of(plain, Finding::false_inside), 0U);
    EXPECT_GT(count_of(own, Finding::false_inside), 10U);
    EXPECT_EQ(count_of(own, Finding::false_outside), 0U);
    EXPECT_EQ(count_of(own, Finding::opposite_sign), 0U);
    // Its values are off by one, those of the sum are not.
    EXPECT_GT(own.value_ulp.value, 0x1p51);
    EXPECT_LT(plain.p999_value_ulp(), 0x1p40);
}

TEST(Contained, AClassificationOfDegenerateOrNonsenseIsAFalseDeclaration) {
    Kernel k = load_kernel_library(library("rule")).value();
    for (const ClassifyFunction f :
         {ClassifyFunction([](const double*, const double*, const double*) { return 3; }),
          ClassifyFunction([](const double*, const double*, const double*) { return 77; })}) {
        k.classify = f;
        const KernelStatistics s = statistics_of(k, "mesh.inside", 100, own_meshes());
        EXPECT_EQ(count_of(s, Finding::false_declaration), 100U);
    }
}

}  // namespace
}  // namespace barycert::audit

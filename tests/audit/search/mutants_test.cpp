// The mutation score of the families: sound kernels are sound, mutants differ from them, and every one is caught.

#include "barycert/mutants.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/gaps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/audit/audit_helpers.hpp"

namespace barycert::audit {
namespace {

MutantReport audited(const std::vector<Mutant>& mutants, std::uint64_t count, const std::string& families = "*") {
    AuditOptions options;
    options.families = families_matching(families);
    options.count = count;
    options.threads = 2;
    return audit_mutants(options, own_meshes(), mutants).value();
}

/// All of them in all families, once for all tests.
const MutantReport& score() {
    static const MutantReport r = audited(all_mutants(), 2000);
    return r;
}

TEST(Mutants, EveryOneIsCaught) {
    const MutantReport& r = score();
    for (const MutantResult& m : r.mutants) EXPECT_FALSE(m.catches.empty()) << m.mutant.kernel.name;
    EXPECT_EQ(r.caught(), r.mutants.size());
    EXPECT_GE(r.mutants.size(), 38U);
}

TEST(Mutants, AllKindsOfFaultsAreThere) {
    std::set<std::string> faults, names;
    for (const Mutant& m : all_mutants()) {
        faults.insert(m.fault);
        EXPECT_TRUE(names.insert(m.kernel.name).second) << m.kernel.name;
        EXPECT_EQ(m.kernel.name, m.sound.name + "!" + m.fault);
        EXPECT_FALSE(m.change.empty());
    }
    for (const char* fault : {"wrong-constant", "no-underflow-guard", "swapped-vertices", "tolerance-times-ten",
                              "tie-outside", "dropped-term"})
        EXPECT_TRUE(faults.contains(fault)) << fault;
}

// A mutant that is its sound kernel under another name must not count as caught: then the score would say nothing.
TEST(Mutants, ASoundKernelIsNotCaught) {
    std::vector<Mutant> same;
    for (Mutant m : all_mutants()) {
        m.kernel = m.sound;
        m.kernel.name += "!same";
        const auto there = [&](const Mutant& x) { return x.kernel.name == m.kernel.name; };
        if (std::none_of(same.begin(), same.end(), there)) same.push_back(m);
    }
    for (const MutantResult& m : audited(same, 300).mutants) {
        EXPECT_GE(m.families, 5U) << m.mutant.kernel.name;
        EXPECT_TRUE(m.catches.empty()) << m.mutant.kernel.name << " by " << m.catches.front().family;
    }
}

// The filter's sound kernels promise every sign: what its mutants get wrong is the fault's doing.
TEST(Mutants, TheSoundFilterHasNoFinding) {
    std::vector<Kernel> filters;
    for (const Mutant& m : all_mutants()) {
        if (m.fault == "wrong-constant") filters.push_back(m.sound);
    }
    ASSERT_EQ(filters.size(), 2U);
    for (const KernelResult& k : audit_of(filters, all_families(), 2000, own_meshes()).kernels)
        EXPECT_EQ(k.total.wrong_cases, 0U) << k.kernel.name;
}

TEST(Mutants, WhoCatchesWhat) {
    const MutantReport& r = score();
    const auto caught_by = [&](const std::string& mutant, const std::string& family) {
        for (const MutantResult& m : r.mutants) {
            if (m.mutant.kernel.name != mutant) continue;
            return std::any_of(m.catches.begin(), m.catches.end(),
                               [&](const MutantCatch& c) { return c.family == family; });
        }
        ADD_FAILURE() << "no mutant " << mutant;
        return false;
    };
    EXPECT_TRUE(caught_by("tetrahedron.filtered!no-underflow-guard", "filter-underflow"));
    EXPECT_FALSE(caught_by("tetrahedron.filtered!no-underflow-guard", "random"));
    EXPECT_TRUE(caught_by("tetrahedron.signed-volume!swapped-vertices", "random.inside"));
    EXPECT_TRUE(caught_by("tetrahedron.signed-volume!even-weights", "degenerate.plane"));
    EXPECT_FALSE(caught_by("tetrahedron.signed-volume!even-weights", "random.inside"));
    EXPECT_TRUE(caught_by("triangle.exact!ties-away", "midpoints"));
    EXPECT_FALSE(caught_by("triangle.exact!ties-away", "random.inside"));
    EXPECT_TRUE(caught_by("triangle.signed-area!absolute-tolerance", "sliver.1e-13"));
}

}  // namespace
}  // namespace barycert::audit

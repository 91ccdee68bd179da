// The named cases under tests/audit/cases: each still shows what it was kept for, and barycert's own kernels answer it
// right.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "barycert/audit_search.hpp"
#include "barycert/gaps.hpp"
#include "barycert/mutants.hpp"
#include "tests/audit/audit_helpers.hpp"

namespace barycert::audit {
namespace {

std::vector<std::string> named_cases() {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(BARYCERT_CASES_DIR)) {
        if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

TEST(NamedCases, ShowWhatTheyWereKeptFor) {
    std::size_t shown = 0;
    for (const std::string& path : named_cases()) {
        const std::vector<Witness> witnesses = read_witnesses(path).value();
        EXPECT_FALSE(witnesses.empty()) << path;
        for (const Witness& w : witnesses) {
            EXPECT_EQ(replay_witness(w, catalogue()).not_reproduced, "") << path << ": " << w.reason;
            ++shown;
        }
    }
    EXPECT_GT(shown, 20U);
}

TEST(NamedCases, AreAnsweredRightByExactKernels) {
    for (const std::string& path : named_cases()) {
        const std::vector<Witness> witnesses = read_witnesses(path).value();
        for (const Witness& w : witnesses) {
            std::size_t exact = 0;
            for (const KernelAnswer& a : replay_witness(w, catalogue()).answers) {
                if (!a.kernel.ends_with("exact")) continue;
                ++exact;
                EXPECT_FALSE(a.comparison.wrong()) << path << ": " << w.reason << ", " << a.kernel;
                EXPECT_LE(a.comparison.worst_weight_ulp(), 0) << path << ": " << w.reason << ", " << a.kernel;
            }
            EXPECT_EQ(exact, 1U) << path;
        }
    }
}

// The oracle by its two ways.
TEST(NamedCases, TheWideOracleAgrees) {
    for (const std::string& path : named_cases()) {
        const std::vector<Witness> witnesses = read_witnesses(path).value();
        for (const Witness& w : witnesses) {
            const OracleAnswer narrow = ask_oracle(w.c), wide = exact::ask_wide(w.c);
            EXPECT_EQ(narrow.region, wide.region) << path;
            EXPECT_EQ(narrow.signs, wide.signs) << path;
            if (narrow.region != Region::degenerate) {
                EXPECT_EQ(narrow.weights, wide.weights) << path;
            }
        }
    }
}

}  // namespace
}  // namespace barycert::audit

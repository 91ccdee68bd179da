// The name meant by a mistyped word: against distances counted by hand and a slow twin that tries all edits.

#include "core/base/nearest_name.hpp"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace barycert::base {
namespace {

TEST(NearestName, DistancesCountedByHand) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("sample", "sample"), 0U);
    EXPECT_EQ(edit_distance("SAMPLE", "sample"), 0U);
    EXPECT_EQ(edit_distance("smaple", "sample"), 1U);
    EXPECT_EQ(edit_distance("sampel", "sample"), 1U);
    EXPECT_EQ(edit_distance("ampl", "sample"), 2U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("ca", "abc"), 3U);  // a swapped pair is not changed again
}

/// All words one edit away over a few letters.
std::set<std::string> neighbours_of(const std::string& word) {
    std::set<std::string> all;
    for (std::size_t i = 0; i <= word.size(); ++i) {
        for (const char c : {'a', 'b', 'c'}) {
            all.insert(word.substr(0, i) + c + word.substr(i));
            if (i < word.size()) all.insert(word.substr(0, i) + c + word.substr(i + 1));
        }
        if (i < word.size()) all.insert(word.substr(0, i) + word.substr(i + 1));
        if (i + 1 < word.size()) all.insert(word.substr(0, i) + word[i + 1] + word[i] + word.substr(i + 2));
    }
    all.erase(word);
    return all;
}

TEST(NearestName, OneEditIsADistanceOfOneAndNoOtherIs) {
    std::vector<std::string> words{""};
    for (std::size_t i = 0; words[i].size() < 4; ++i) {
        for (const char c : {'a', 'b', 'c'}) words.push_back(words[i] + c);
    }
    ASSERT_EQ(words.size(), 1U + 3 + 9 + 27 + 81);
    for (const std::string& a : words) {
        const std::set<std::string> near = neighbours_of(a);
        for (const std::string& b : words)
            ASSERT_EQ(edit_distance(a, b) == 1, near.count(b) == 1) << '"' << a << "\" and \"" << b << '"';
    }
}

TEST(NearestName, TheNearestIsFoundAndOnlyIfItIsNear) {
    const std::vector<std::string> names{"sample", "resample", "replay", "render", "tetrahedron.cramer", "T"};
    EXPECT_EQ(nearest_name("smaple", names), "sample");
    EXPECT_EQ(nearest_name("resmaple", names), "resample");
    EXPECT_EQ(nearest_name("rendr", names), "render");
    EXPECT_EQ(nearest_name("tetrahedron.cramr", names), "tetrahedron.cramer");
    EXPECT_EQ(nearest_name("cramer", names), "tetrahedron.cramer");
    EXPECT_EQ(nearest_name("t", names), "T");
    EXPECT_EQ(nearest_name("X", names), "");
    EXPECT_EQ(nearest_name("zzz", names), "");
    EXPECT_EQ(nearest_name("", names), "");
    EXPECT_EQ(nearest_name("sam", names), "");
    EXPECT_EQ(nearest_name("sample", {}), "");
    EXPECT_EQ(nearest_name(std::string(101, 'a'), {std::string(101, 'a')}), "");
    // The first of several at the same distance, whole names before parts.
    EXPECT_EQ(nearest_name("ab1", {"x.ab1", "ab2", "ab3", "ab1"}), "ab1");
    EXPECT_EQ(nearest_name("ab1", {"ab2", "ab3"}), "ab2");
}

TEST(NearestName, ARemedySaysItBeforeTheRest) {
    const std::vector<std::string> names{"sample"};
    EXPECT_EQ(did_you_mean("smaple", names), "did you mean \"sample\"?");
    EXPECT_EQ(did_you_mean("smaple", names, "`barycert --help` lists them"),
              "did you mean \"sample\"? `barycert --help` lists them");
    EXPECT_EQ(did_you_mean("zzz", names, "rest"), "rest");
    EXPECT_EQ(did_you_mean("zzz", names), "");
}

}  // namespace
}  // namespace barycert::base

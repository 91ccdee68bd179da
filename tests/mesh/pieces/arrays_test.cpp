// Arrays that all ranks have: those of the lowest rank that has cells.

#include <gtest/gtest.h>

#include "mesh/pieces/distribution.hpp"
#include "tests/mesh/pieces/threads.hpp"

namespace barycert::testing {
namespace {

using pieces::ArrayKind;

struct Rank {
    bool has_cells = true;
    std::vector<ArrayKind> kinds;
};

/// The message that all end with, and the kinds that all have then.
std::string agreed(const std::vector<Rank>& ranks, std::vector<ArrayKind>& kinds) {
    std::vector<std::string> errors(ranks.size());
    std::vector<std::vector<ArrayKind>> of(ranks.size());
    Threads(static_cast<int>(ranks.size())).run([&](pieces::Communicator& all) {
        pieces::Exchange exchange(all);
        const auto at = static_cast<std::size_t>(all.rank());
        of[at] = ranks[at].kinds;
        const Status done = agree_on_arrays(exchange, ranks[at].has_cells, of[at]);
        errors[at] = done ? "" : done.error().message();
    });
    for (std::size_t r = 0; r < ranks.size(); ++r) {
        EXPECT_EQ(errors[r], errors.front());
        if (!errors[r].empty()) continue;
        EXPECT_EQ(of[r].size(), of.front().size());
        for (std::size_t i = 0; i < of[r].size(); ++i) {
            EXPECT_EQ(of[r][i].text(), of.front()[i].text());
            EXPECT_EQ(of[r][i].type, of.front()[i].type);
            EXPECT_EQ(of[r][i].role, of.front()[i].role);
            EXPECT_EQ(of[r][i].component_names, of.front()[i].component_names);
        }
    }
    kinds = of.front();
    return errors.front();
}

const ArrayKind speed{.name = "v", .type = 11, .type_name = "double", .components = 2, .component_names = {"east", ""}};
const ArrayKind nameless{.name = "", .named = false, .type = 6, .type_name = "int", .role = 3};

TEST(Arrays, AreThoseOfTheLowestRankWithCells) {
    for (const std::size_t size : {std::size_t{1}, std::size_t{3}}) {
        std::vector<Rank> ranks(size, {true, {speed, nameless}});
        // In any order; and without cells others do not matter.
        if (size > 1) ranks = {{false, {}}, {true, {speed, nameless}}, {true, {nameless, speed}}};
        std::vector<ArrayKind> kinds;
        EXPECT_EQ(agreed(ranks, kinds), "");
        ASSERT_EQ(kinds.size(), 2U);
        EXPECT_EQ(kinds[0].text(), "the array v of 2 times double");
        EXPECT_EQ(kinds[0].component_names, speed.component_names);
        EXPECT_EQ(kinds[1].text(), "an array without a name of 1 int");
        EXPECT_EQ(kinds[1].role, 3);
    }
    std::vector<ArrayKind> kinds;
    EXPECT_EQ(agreed({{false, {}}, {false, {speed}}}, kinds), "");
    EXPECT_TRUE(kinds.empty());
}

TEST(Arrays, ThatDifferAreAnErrorOnAllRanks) {
    const std::string begin = "rank 1: the source has other arrays than that of rank 0: ";
    ArrayKind other = speed;
    other.type = 10;
    other.type_name = "float";
    std::vector<ArrayKind> kinds;
    EXPECT_EQ(agreed({{true, {speed}}, {true, {}}, {true, {}}}, kinds),
              begin + "the array v of 2 times double is missing here");
    EXPECT_EQ(agreed({{true, {speed}}, {true, {other}}}, kinds),
              begin + "the array v of 2 times double is here the array v of 2 times float");
    EXPECT_EQ(agreed({{true, {speed}}, {true, {speed, nameless}}}, kinds),
              begin + "an array without a name of 1 int is here only");
}

}  // namespace
}  // namespace barycert::testing

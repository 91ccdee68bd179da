// The core against its judges over every family and simplex: signs, weights and values (see judge.hpp).

#include <gtest/gtest.h>

#include <cctype>
#include <ostream>

#include "judge.hpp"

namespace barycert::laws {

void PrintTo(const Subject& s, std::ostream* out) {
    *out << s.title();
}

namespace {

constexpr std::uint64_t seed = 20240607;
constexpr std::uint64_t signs_per_family = 1000000;
constexpr std::uint64_t values_in_all = 1000000;

class Laws : public testing::TestWithParam<Subject> {};

void expect_agreement(const Tally& tally, std::uint64_t cases) {
    EXPECT_GE(tally.cases, cases);
    EXPECT_EQ(tally.tiers.cases(), tally.cases);
    EXPECT_EQ(tally.disagreements, 0U);
    for (const std::string& text : tally.first) ADD_FAILURE() << text;
}

TEST_P(Laws, Signs) {
    const std::uint64_t cases = (signs_per_family - 1) / GetParam().simplices() + 1;
    expect_agreement(judge_signs(GetParam(), seed, 0, cases), cases);
}

TEST_P(Laws, WeightsAndValues) {
    const std::uint64_t cases = (values_in_all - 1) / all_subjects().size() + 1;
    expect_agreement(judge_values(GetParam(), seed, 0, cases, true), cases);
}

INSTANTIATE_TEST_SUITE_P(AllFamilies, Laws, testing::ValuesIn(all_subjects()), [](const auto& param_info) {
    std::string title = param_info.param.title();
    for (char& c : title) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    return title;
});

}  // namespace
}  // namespace barycert::laws

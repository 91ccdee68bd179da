// Figures that JSON cannot say, and text that is no UTF-8.

#include "app/report/common/json.hpp"

#include <gtest/gtest.h>

#include "files/json_text.hpp"

namespace barycert::report {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double max = std::numeric_limits<double>::max();

TEST(JsonFigure, NoFigureIsNullAndInfinityIsNot) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(figure(nan).is_null());
    EXPECT_EQ(figure(infinity), max);
    EXPECT_EQ(figure(-infinity), -max);
    EXPECT_EQ(figure(-1), -1.0);
    EXPECT_TRUE(magnitude(nan).is_null());
    EXPECT_TRUE(magnitude(-1).is_null());
    EXPECT_TRUE(magnitude(-infinity).is_null());
    EXPECT_EQ(magnitude(0), 0.0);
    EXPECT_EQ(magnitude(infinity), max);
}

TEST(JsonRecord, KeysAndValuesInTurn) {
    const std::optional<int> some = 3, none;
    EXPECT_EQ(record("b", 1, "a", infinity, "c", some, "d", none, "e", "text").dump(),
              R"({"b":1,"a":1.7976931348623157e+308,"c":3,"d":null,"e":"text"})");
}

TEST(JsonText, IsUtf8AndEndsWithALineBreak) {
    const nlohmann::ordered_json j{{"name", "a\xff"}};
    EXPECT_EQ(base::json_text(j, 1), "{\n \"name\": \"a\xef\xbf\xbd\"\n}\n");
    EXPECT_EQ(base::json_text(j, 2).substr(0, 5), "{\n  \"");
}

}  // namespace
}  // namespace barycert::report

#include "core/base/text.hpp"

#include <gtest/gtest.h>

namespace barycert::base {
namespace {

TEST(NamedLimit, IsANameAndPerhapsANumber) {
    EXPECT_EQ(named_limit("any").name, "any");
    EXPECT_EQ(named_limit("any").most, 0.0);
    EXPECT_EQ(named_limit("worst>1e9").name, "worst");
    EXPECT_EQ(named_limit("worst>1e9").most, 1e9);
    EXPECT_EQ(named_limit("a>0").most, 0.0);
    for (const char* bad : {"a>", "a>-1", "a>nan", "a>1x", "a>>1", "a>=1"}) {
        EXPECT_EQ(named_limit(bad).name, "a");
        EXPECT_FALSE(named_limit(bad).most) << bad;
    }
}

}  // namespace
}  // namespace barycert::base

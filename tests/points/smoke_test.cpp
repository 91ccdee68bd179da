#include "barycert/points/source.hpp"
#include <gtest/gtest.h>
TEST(Smoke, smoke) { EXPECT_TRUE(barycert::points::format_of("a.csv")); }

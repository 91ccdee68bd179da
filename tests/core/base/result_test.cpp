#include "barycert/result.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace barycert {
namespace {

TEST(Error, MessageHasEveryPartInOrder) {
    const Error full{.what = "cannot read the vertex",
                     .file = "a.node",
                     .line = 7,
                     .expected = "3 coordinates",
                     .found = "2",
                     .remedy = "add one"};
    EXPECT_EQ(full.message(), "a.node:7: cannot read the vertex: expected 3 coordinates, found 2; add one");
}

TEST(Error, EmptyPartsLeaveNoTrace) {
    EXPECT_EQ(Error{.what = "no"}.message(), "no");
    EXPECT_EQ((Error{.what = "no", .file = "f"}.message()), "f: no");
    EXPECT_EQ((Error{.what = "no", .line = 3}.message()), "no");  // a line without a file says nothing
    EXPECT_EQ((Error{.what = "no", .expected = "x"}.message()), "no: expected x");
    EXPECT_EQ((Error{.what = "no", .found = "y"}.message()), "no: found y");
    EXPECT_EQ((Error{.what = "no", .remedy = "z"}.message()), "no; z");
}

TEST(Result, HoldsAValueOrAnError) {
    Result<int> good(5);
    ASSERT_TRUE(good);
    EXPECT_EQ(*good, 5);
    EXPECT_EQ(good.value(), 5);
    *good = 6;
    EXPECT_EQ(good.value(), 6);

    Result<int> bad(Error{.what = "no"});
    ASSERT_FALSE(bad);
    EXPECT_FALSE(bad.has_value());
    EXPECT_EQ(bad.error().what, "no");
}

TEST(Result, ThrowsForCallersWhoThrow) {
    Result<int> bad(Error{.what = "no", .file = "f", .line = 2});
    try {
        static_cast<void>(bad.value());
        FAIL() << "nothing thrown";
    } catch (const Exception& e) {
        EXPECT_STREQ(e.what(), "f:2: no");
        EXPECT_EQ(e.error().line, 2U);
    }
    EXPECT_THROW(static_cast<void>(Result<int>(Error{.what = "no"}).value()), Exception);
}

TEST(Result, MovesValuesThatCannotBeCopied) {
    Result<std::unique_ptr<int>> r(std::make_unique<int>(5));
    EXPECT_EQ(**r, 5);
    const std::unique_ptr<int> taken = std::move(r).value();
    EXPECT_EQ(*taken, 5);
}

TEST(Result, StatusCarriesNothingButSuccess) {
    const Status fine = Done{};
    EXPECT_TRUE(fine);
    const Status failed = Error{.what = "no"};
    EXPECT_FALSE(failed);
}

}  // namespace
}  // namespace barycert

#include "barycert/result.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include <gtest/gtest.h>

namespace barycert {
namespace {

TEST(Error, MessageHasEveryPartInOrder) {
    const Error full{.code = "file.syntax",
                     .what = "cannot read the vertex",
                     .file = "a.node",
                     .line = 7,
                     .expected = "3 coordinates",
                     .found = "2",
                     .remedy = "add one"};
    EXPECT_EQ(full.message(), "a.node:7: cannot read the vertex: expected 3 coordinates, found 2; add one");
}

TEST(Error, EmptyPartsLeaveNoTrace) {
    EXPECT_EQ((Error{.code = "file.syntax", .what = "no"}.message()), "no");
    EXPECT_EQ((Error{.code = "file.syntax", .what = "no", .file = "f"}.message()), "f: no");
    EXPECT_EQ((Error{.code = "file.syntax", .what = "no", .line = 3}.message()),
              "no");  // a line without a file says nothing
    EXPECT_EQ((Error{.code = "file.syntax", .what = "no", .expected = "x"}.message()), "no: expected x");
    EXPECT_EQ((Error{.code = "file.syntax", .what = "no", .found = "y"}.message()), "no: found y");
    EXPECT_EQ((Error{.code = "file.syntax", .what = "no", .remedy = "z"}.message()), "no; z");
}

TEST(Result, HoldsAValueOrAnError) {
    Result<int> good(5);
    ASSERT_TRUE(good);
    EXPECT_EQ(*good, 5);
    EXPECT_EQ(good.value(), 5);
    *good = 6;
    EXPECT_EQ(good.value(), 6);

    Result<int> bad(Error{.code = "file.syntax", .what = "no"});
    ASSERT_FALSE(bad);
    EXPECT_FALSE(bad.has_value());
    EXPECT_EQ(bad.error().what, "no");
    EXPECT_TRUE(bad.error().code == "file.syntax");
}

template <class T>
concept needs_no_code = requires {
    T{.what = "no"};
};

TEST(ErrorCode, EachErrorHasOne) {
    static_assert(!needs_no_code<Error>);
    static_assert(!std::is_default_constructible_v<ErrorCode>);
    static_assert(!std::is_constructible_v<ErrorCode, std::string>);  // nothing but a listed name
}

TEST(ErrorCode, IsFoundByItsName) {
    for (const std::string_view name : error_codes) {
        const auto code = ErrorCode::named(name);
        ASSERT_TRUE(code) << name;
        EXPECT_EQ(code->name(), name);
        EXPECT_EQ(std::ranges::count(error_codes, name), 1) << name;
    }
    EXPECT_FALSE(ErrorCode::named("file"));
    EXPECT_FALSE(ErrorCode::named(""));
    EXPECT_TRUE(ErrorCode::named("file.missing") == ErrorCode("file.missing"));
    EXPECT_FALSE(ErrorCode("file.empty") == ErrorCode("file.missing"));
}

TEST(Error, IsAboutASubject) {
    const Error error = about("job.points", file_error("option.missing", "a.csv", "no points"));
    EXPECT_EQ(error.subject, "job.points");
    EXPECT_EQ(error.message(), "a.csv: no points");  // the texts say it, if it is to be said
}

TEST(Result, ThrowsForCallersWhoThrow) {
    Result<int> bad(Error{.code = "file.syntax", .what = "no", .file = "f", .line = 2});
    try {
        static_cast<void>(bad.value());
        FAIL() << "nothing thrown";
    } catch (const Exception& e) {
        EXPECT_STREQ(e.what(), "f:2: no");
        EXPECT_EQ(e.error().line, 2U);
    }
    EXPECT_THROW(static_cast<void>(Result<int>(Error{.code = "file.syntax", .what = "no"}).value()), Exception);
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
    const Status failed = Error{.code = "file.syntax", .what = "no"};
    EXPECT_FALSE(failed);
}

}  // namespace
}  // namespace barycert

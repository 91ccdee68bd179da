// barycert check --html: a page in a file or on stdout, whatever the verdict.

#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

bool is_page(const std::string& text) {
    return text.starts_with("<!DOCTYPE html>\n") && text.ends_with("</body></html>\n");
}

TEST(CheckHtml, APageBesideTheTable) {
    const Scratch scratch;
    for (const std::string name : {"flange", "plate"}) {
        const Ended r = run({"check", mesh(name), "--html", scratch.path(name)});
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_TRUE(contains(r.out, ": certified: "));
        const std::string page = read_file(scratch.path(name));
        EXPECT_TRUE(is_page(page));
        EXPECT_TRUE(contains(page, "<b>Certified</b>"));
        EXPECT_TRUE(contains(page, name));
        EXPECT_LT(page.size(), 2000000U);
    }
}

TEST(CheckHtml, OfAMeshThatIsNotCertified) {
    const Scratch scratch;
    scratch.put("a<b.node", "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 0\n");
    scratch.put("a<b.ele", "2 4 0\n0 0 1 2 3\n1 0 1 2 4\n");
    const Ended r = run({"check", scratch.path("a<b"), "--quiet", "--html", scratch.path("page")});
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_EQ(r.out, "");
    const std::string page = read_file(scratch.path("page"));
    EXPECT_TRUE(is_page(page));
    EXPECT_TRUE(contains(page, "<b>NOT certified</b>"));
    EXPECT_TRUE(contains(page, "degenerate cell (coplanar)"));
    EXPECT_TRUE(contains(page, "a&lt;b"));
    EXPECT_FALSE(contains(page, "a<b"));
}

TEST(CheckHtml, OnStdoutInPlaceOfTheTable) {
    const Ended r = run({"check", mesh("plate"), "--html", "-"});
    EXPECT_EQ(r.code, 0);
    EXPECT_TRUE(is_page(r.out));
    EXPECT_EQ(run({"check", mesh("plate"), "--html", "-", "--json", "-"}).code, 2);
}

TEST(CheckHtml, ThePictureDoesNotDependOnThreads) {
    const auto pictures = [](const std::string& threads) {
        const std::string page = run({"check", mesh("flange"), "--html", "-", "--threads", threads}).out;
        return page.substr(0, page.find("<footer>"));
    };
    EXPECT_EQ(pictures("1"), pictures("2"));
}

TEST(CheckHtml, AFileThatCannotBeWrittenIsToldBeforeTheWork) {
    const Ended r = run({"check", mesh("plate"), "--html", "/nowhere/page.html"});
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, "/nowhere/page.html"));
}

}  // namespace
}  // namespace barycert::cli_test

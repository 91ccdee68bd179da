/// HTML pages as text: whether they are well-formed.
#pragma once

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace barycert::report_test {

inline bool has(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

/// Tags balance, attributes are quoted, nothing is bare that needs escaping; the page asks for nothing from elsewhere.
/// With `script` it has one script besides. Pictures are in the page itself.
inline void expect_well_formed(std::string page, bool script = false) {
    ASSERT_TRUE(page.starts_with("<!DOCTYPE html>\n"));
    ASSERT_TRUE(page.ends_with("</body></html>\n"));
    // A mesh that turns has its data and the viewer, packed, and a script of its own.
    const std::size_t scripts = (script ? 1U : 0U) + (has(page, "<figure class=\"turning\">") ? 3U : 0U);
    for (std::size_t i = 0; i < scripts; ++i) {
        const std::size_t start = page.find("<script"), first = page.find('>', start) + 1,
                          last = page.find("</script>");
        ASSERT_LT(first, last);
        ASSERT_EQ(page.find_first_of("<&", first), last) << "not well-formed XML";
        page.erase(start, last + 9 - start);
    }
    for (const std::string begin : {" src=\"data:image/png;base64,", " href=\"data:image/png;base64,"})
        for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos;)
            page.erase(at, page.find('"', at + begin.size()) + 1 - at);
    static const std::regex tag("^(/?)([a-z][a-z0-9]*)((?: [A-Za-z-]+=\"[^\"<]*\")*)(/?)$", std::regex::ECMAScript);
    std::vector<std::string> open;
    for (std::size_t at = page.find('\n') + 1; at < page.size();) {
        const std::size_t start = page.find('<', at);
        for (std::size_t i = at; i < std::min(start, page.size()); ++i) {
            if (page[i] == '&') {
                const std::string entity = page.substr(i, page.find(';', i) + 1 - i);
                ASSERT_TRUE(entity == "&amp;" || entity == "&lt;" || entity == "&gt;" || entity == "&quot;") << entity;
            }
        }
        if (start == std::string::npos) break;
        const std::size_t end = page.find('>', start);
        ASSERT_NE(end, std::string::npos);
        const std::string inside = page.substr(start + 1, end - start - 1);
        at = end + 1;
        // A path of many marks is too long for the standard library's regular expressions.
        std::smatch m;
        const std::string head = inside.size() < 400 ? inside : inside.substr(0, inside.find(" d=")) + "/";
        ASSERT_TRUE(std::regex_match(head, m, tag)) << inside.substr(0, 200);
        if (m[1] == "/") {
            ASSERT_FALSE(open.empty());
            ASSERT_EQ(open.back(), m[2]) << page.substr(start > 200 ? start - 200 : 0, 220);
            open.pop_back();
        } else if (m[4] != "/") {
            open.push_back(m[2]);
        }
    }
    EXPECT_TRUE(open.empty());
    for (const char* alien : {"<script", "href", "src=", "url(", "@import"}) EXPECT_FALSE(has(page, alien)) << alien;
    EXPECT_TRUE(has(page, "Content-Security-Policy\" content=\"default-src 'none'; "));
    // Numbers that no drawing can have.
    EXPECT_FALSE(std::regex_search(page, std::regex("(x|y|r|width|height|cx|cy)=\"-?(nan|inf)")));
    EXPECT_FALSE(has(page, "Mnan") || has(page, "Minf") || has(page, "M-nan") || has(page, "M-inf"));
    EXPECT_FALSE(has(page, " nan") || has(page, "Lnan"));
}

}  // namespace barycert::report_test

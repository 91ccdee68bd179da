#include "io/vtk/out_file.hpp"

#include <gtest/gtest.h>

namespace barycert::detail {
namespace {

TEST(XmlName, WhatNeedsAnEscapeGetsOne) {
    EXPECT_EQ(io::xml_attribute(""), "");
    EXPECT_EQ(io::xml_attribute(" von Mises stress [MPa] "), " von Mises stress [MPa] ");
    EXPECT_EQ(io::xml_attribute("a<b>&\"'"), "a&#60;b&#62;&#38;&#34;&#39;");
    EXPECT_EQ(io::xml_attribute("\t\n\r"), "&#9;&#10;&#13;");
    EXPECT_EQ(io::xml_attribute("&lt;"), "&#38;lt;");
    EXPECT_EQ(io::xml_attribute("\x7f"), "\x7f");
}

TEST(XmlName, CharactersAtTheEndsOfTheirRanges) {
    for (const char* text : {"\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80", "\xEF\xBF\xBD",
                             "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"}) {
        EXPECT_EQ(io::xml_attribute(text), text);
        EXPECT_EQ(io::xml_attribute(std::string("a") + text + "b"), std::string("a") + text + "b");
    }
}

TEST(XmlName, WhatIsNoTextIsRefused) {
    using namespace std::string_literals;
    for (const std::string& text : {
             "\0"s,
             "\x01"s,
             "\x08"s,
             "\x0B"s,
             "\x0C"s,
             "\x0E"s,
             "\x1F"s,  // control characters
             "\x80"s,
             "\xBF"s,
             "\xC2"s,
             "\xC2 "s,
             "\xE2\x82"s,
             "\xE2\x82 "s,  // loose, cut off
             "\xC0\x80"s,
             "\xC1\xBF"s,
             "\xE0\x9F\xBF"s,
             "\xF0\x8F\xBF\xBF"s,  // longer than need be
             "\xED\xA0\x80"s,
             "\xED\xBF\xBF"s,  // surrogates
             "\xEF\xBF\xBE"s,
             "\xEF\xBF\xBF"s,  // excluded by XML
             "\xF4\x90\x80\x80"s,
             "\xF8\x88\x80\x80\x80"s,
             "\xFF"s  // beyond Unicode
         }) {
        EXPECT_FALSE(io::xml_attribute(text)) << ::testing::PrintToString(text);
        EXPECT_FALSE(io::xml_attribute("a" + text)) << ::testing::PrintToString(text);
    }
}

}  // namespace
}  // namespace barycert::detail

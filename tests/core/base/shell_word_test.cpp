#include "core/base/text.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace barycert::base {
namespace {

/// The words that a shell makes of a line.
std::string through_shell(const std::string& word) {
    std::FILE* pipe = ::popen(("printf '[%s]' " + word).c_str(), "r");
    std::string out;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) out += static_cast<char>(c);
    ::pclose(pipe);
    return out;
}

TEST(ShellWord, OneWordToAShellWhateverItHolds) {
    EXPECT_EQ(shell_word("data/meshes/a-1.node"), "data/meshes/a-1.node");
    EXPECT_EQ(shell_word(""), "''");
    EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
    EXPECT_EQ(shell_word("\033[1m it's 5%\n"), "\"$(printf '\\033[1m it\\047s 5%%')\"'\n'");
    for (const std::string& text :
         {std::string("plain"),     std::string(""),      std::string("two words"),
          std::string("it's"),      std::string("'"),     std::string("''"),
          std::string("$HOME"),     std::string("`id`"),  std::string("a\"b"),
          std::string("a\\b"),      std::string("*"),     std::string("~"),
          std::string("~root"),     std::string("#x"),    std::string("a;b|c&d>e<f"),
          std::string("(x)"),       std::string("{a,b}"), std::string("!x"),
          std::string("new\nline"), std::string("tab\t"), std::string("na\xc3\xafve"),
          std::string("a=b"),       std::string("?[x]"),  std::string("\033[1m it's 5 % \\ \xff\""),
          std::string("ends\n\n"),  std::string("-\0337")})
        EXPECT_EQ(through_shell(shell_word(text)), "[" + text + "]");
}

}  // namespace
}  // namespace barycert::base

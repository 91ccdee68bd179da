// barycert help, and the manual pages: they say what --help says, of every command and option.

#include <filesystem>

#include <gtest/gtest.h>

#include "process.hpp"
#include "program_table.hpp"

namespace barycert::cli_test {
namespace {

namespace fs = std::filesystem;

std::string joined(const Words& words, const std::string& separator) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
    return text;
}

std::string page_of(const Words& command) {
    return "barycert" + (command.empty() ? "" : "-" + joined(command, "-")) + ".1";
}

/// The text of a page without the escapes of roff.
std::string plain(const std::string& page) {
    std::string text;
    for (std::size_t i = 0; i < page.size(); ++i) {
        if (page[i] != '\\') {
            text += page[i];
        } else if (page[i + 1] == 'f') {
            i += 2;
        } else if (page[i + 1] == '(') {
            text += page.compare(i, 4, "\\(aq") == 0 ? '\'' : page.compare(i, 4, "\\(ga") == 0 ? '`' : '?';
            i += 3;
        } else {
            text += page[++i] == '-' ? "-" : page[i] == 'e' ? "\\" : "";
        }
    }
    return text;
}

TEST(Help, OfASubcommandIsWhatItsOptionHelpSays) {
    const auto commands = listed_commands();
    ASSERT_GT(commands.size(), 20U);
    for (const ListedCommand& command : commands) {
        Words option = command.words, help = command.words;
        option.emplace_back("--help");
        help.insert(help.begin(), "help");
        const Ended by_option = run(option), by_help = run(help);
        EXPECT_EQ(by_help.code, 0) << by_help.err;
        EXPECT_EQ(by_help.out, by_option.out) << joined(help, " ");
        // The parser's own words for the numbers that it takes: "N:INT in [0 - 4096]".
        for (const std::string words : {" in [", ":POSITIVE"})
            EXPECT_FALSE(contains(by_help.out, words)) << by_help.out;
        // The notes of a command are not those of the commands below it.
        EXPECT_EQ(contains(by_help.out, "`barycert help SUBCOMMAND` explains"), command.words.empty());
        EXPECT_EQ(contains(by_help.out, "`barycert help render PICTURE` explains"), command.words == Words{"render"});
    }
    EXPECT_TRUE(contains(run({"help", "mesh"}).out, "--max-volume"));
#ifdef BARYCERT_TETGEN_PROGRAM
    // The same options as the program that it runs.
    const std::string options = run({"help", "mesh"}).out;
    const std::string own = run({"--help"}, {.program = BARYCERT_TETGEN_PROGRAM}).out;
    EXPECT_EQ(options.substr(options.find("Positionals:")), own.substr(own.find("Positionals:")));
#endif
}

TEST(Help, WhatIsNotUnderstoodIsRefused) {
    for (const auto& [words, says] : std::vector<std::pair<Words, std::string>>{
             {{"help", "nonsense"}, "no such subcommand: found \"nonsense\""},
             {{"help", "render", "nonsense"}, "no such subcommand: found \"nonsense\""},
             {{"help", "sample", "--man", "x"}, "expected --man DIR, --completion SHELL or subcommands"},
             {{"help", "sample", "--completion", "bash"}, "expected --man DIR, --completion SHELL or subcommands"},
             {{"help", "--completion", "bash", "--man", "x"}, "expected --man DIR, --completion SHELL or subcommands"},
             {{"help", "--completion", "tcsh"}, "expected bash, zsh or fish, found \"tcsh\""},
             {{"help", "--man", ""}, "expected the name of a file"},
             {{"help", "--man", "/dev/null/pages"}, "cannot make the folder"}}) {
        const Ended r = run(words);
        EXPECT_EQ(r.code, 2) << joined(words, " ");
        EXPECT_EQ(r.out, "");
        EXPECT_TRUE(contains(r.err, says)) << r.err;
    }
    for (const Words& words : std::vector<Words>{{"help"}, {"help", "sample"}, {"help", "--completion", "bash"}}) {
        const Ended full = run(words, {.stdout_path = "/dev/full"});
        EXPECT_EQ(full.code, 2);
        EXPECT_TRUE(contains(full.err, "error: cannot write to stdout")) << full.err;
    }
}

TEST(Help, ManualPagesHaveEveryCommandAndOption) {
    const Scratch scratch;
    const std::string folder = scratch.path("new/pages");
    const Ended made = run({"help", "--man", folder});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(made.out + made.err, "");
    std::size_t pages = 0;
    for (const auto& entry : fs::directory_iterator(folder)) pages += entry.is_regular_file() ? 1 : 0;
    const auto commands = listed_commands();
    EXPECT_EQ(pages, commands.size() + 2);  // and those of mesh and of the program that it runs
    for (const ListedCommand& command : commands) {
        const std::string page = plain(read_file(folder + "/" + page_of(command.words)));
        EXPECT_TRUE(
            contains(page, ".SH NAME\n" + page_of(command.words).substr(0, page_of(command.words).size() - 2) + " - "));
        EXPECT_TRUE(contains(page, ".SH EXIT STATUS\n")) << page_of(command.words);
        EXPECT_FALSE(command.options.empty());
        for (const std::string& option : command.options) {
            EXPECT_TRUE(contains(page, ".TP\n" + option + "\n") || contains(page, ".TP\n" + option + " ") ||
                        contains(page, ".TP\n-h, " + option + "\n"))
                << page_of(command.words) << " lacks " << option;
        }
    }
    EXPECT_TRUE(contains(plain(read_file(folder + "/barycert-audit.1")), "Number of threads; 0: all. Default: 0."));
    EXPECT_TRUE(contains(plain(read_file(folder + "/barycert.1")), "\nNO_COLOR\n"));
    EXPECT_TRUE(contains(plain(read_file(folder + "/barycert-tetgen.1")), "\n--max-volume V\n"));
}

TEST(Help, ManualPagesBearTheDayOfTheSourceAlone) {
    const Scratch scratch;
    EXPECT_EQ(run({"help", "--man", scratch.path("a")}, {.environment = {"SOURCE_DATE_EPOCH"}}).code, 0);
    EXPECT_EQ(run({"help", "--man", scratch.path("b")}, {.environment = {"SOURCE_DATE_EPOCH=1700000000"}}).code, 0);
    EXPECT_TRUE(read_file(scratch.path("a") + "/barycert.1").starts_with(".TH BARYCERT 1 \"\" "));
    EXPECT_TRUE(read_file(scratch.path("b") + "/barycert.1").starts_with(".TH BARYCERT 1 \"2023-11-14\" "));
}

TEST(Help, ProgramsThatCheckManualPagesFindNothing) {
    const Scratch scratch;
    const std::string folder = scratch.path("pages");
    ASSERT_EQ(run({"help", "--man", folder}, {.environment = {"SOURCE_DATE_EPOCH=1700000000"}}).code, 0);
    bool checked = false;
    if (is_there("mandoc")) {
        checked = true;
        const Ended lint = run_shell("mandoc -T lint -W warning " + folder + "/*.1");
        EXPECT_EQ(lint.out + lint.err, "");
        EXPECT_EQ(lint.code, 0);
    }
    if (is_there("man") && is_there("groff")) {
        checked = true;
        const Ended lint =
            run_shell("for page in " + folder +
                      "/*.1; do LC_ALL=C.UTF-8 MANROFFSEQ= MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 "
                      "-Z $page >/dev/null; done");
        EXPECT_EQ(lint.out + lint.err, "");
    }
    if (!checked) GTEST_SKIP() << "neither mandoc nor man and groff are installed";
}

}  // namespace
}  // namespace barycert::cli_test

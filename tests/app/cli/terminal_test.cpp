// Colour and progress: on a terminal only, and not where they are unwanted.

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

const Words small{"audit", "--count", "20", "--kernel", "triangle.*"};
const std::string bold = "\033[1m", rewrite = "\r\033[K";

Words plus(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Text as it stands without colours, progress and a terminal's line ends.
std::string bare(const std::string& shown) {
    std::string out;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (shown.compare(i, rewrite.size(), rewrite) == 0) {
            out.erase(out.rfind('\n') == std::string::npos ? 0 : out.rfind('\n') + 1);
            i += rewrite.size() - 1;
        } else if (shown[i] == '\033') {
            i = shown.find('m', i);
        } else if (shown[i] != '\r') {
            out += shown[i];
        }
    }
    return out;
}

/// Without the line that tells the time, the times of the table's last column, and the command lines' difference.
std::string timeless(const std::string& table) {
    std::string out;
    for (const std::string& line : lines_of(table)) {
        if (contains(line, " s") && line.rfind("seed ", 0) == 0) continue;
        const bool of_table = line.rfind("triangle.", 0) == 0 && !contains(line, ": ");
        const std::string kept = of_table ? line.substr(0, line.find_last_of(' ')) : line;
        out += kept.substr(0, kept.find_last_not_of(' ') + 1) + '\n';
    }
    return out;
}

TEST(Terminal, AScriptGetsPlainText) {
    for (const Words& environment : std::vector<Words>{{"NO_COLOR"}, {"NO_COLOR=1"}, {"TERM=xterm-256color"}}) {
        const Ended r = run(small, {.environment = environment});
        EXPECT_EQ(r.code, 0);
        EXPECT_EQ(r.err, "");
        EXPECT_FALSE(contains(r.out, "\033"));
        EXPECT_FALSE(contains(r.out, "\r"));
    }
    EXPECT_FALSE(contains(run({"replay", "--family", "huge", "--case", "1", "--simplex", "triangle"}).out, "\033"));
}

TEST(Terminal, ATerminalGetsColourAndProgress) {
    const Ended r = run(small, {.environment = {"NO_COLOR"}, .terminal = true});
    EXPECT_EQ(r.code, 0);
    EXPECT_TRUE(contains(r.out, bold));
    EXPECT_TRUE(contains(r.out, rewrite));
    EXPECT_TRUE(contains(r.out, " cases, "));
    // Colours and the progress line aside, it is the text that a script gets.
    EXPECT_EQ(timeless(bare(r.out)), timeless(run(small).out));
    const Ended replay = run({"replay", "--family", "huge", "--case", "1", "--simplex", "triangle"},
                             {.environment = {"NO_COLOR"}, .terminal = true});
    EXPECT_TRUE(contains(replay.out, bold));
}

TEST(Terminal, NoColorTakesTheColourAndLeavesTheProgress) {
    const Ended r = run(small, {.environment = {"NO_COLOR=1"}, .terminal = true});
    EXPECT_FALSE(contains(r.out, bold));
    EXPECT_TRUE(contains(r.out, rewrite));
    EXPECT_FALSE(contains(run({"replay", "--family", "huge", "--case", "1", "--simplex", "triangle"},
                              {.environment = {"NO_COLOR=1"}, .terminal = true})
                              .out,
                          "\033"));
    // By its definition an empty NO_COLOR counts as not set.
    EXPECT_TRUE(contains(run(small, {.environment = {"NO_COLOR="}, .terminal = true}).out, bold));
}

TEST(Terminal, QuietIsQuietThereToo) {
    const Ended r = run(plus(small, {"--quiet"}), {.terminal = true});
    EXPECT_EQ(r.code, 0);
    EXPECT_EQ(r.out, "");
}

TEST(Terminal, ColourStaysOutOfFilesAndPipes) {
    const Scratch scratch;
    const Ended r = run(plus(small, {"--json", scratch.path("r.json")}),
                        {.environment = {"NO_COLOR"}, .stdout_path = scratch.path("table"), .terminal = true});
    EXPECT_EQ(r.code, 0);
    EXPECT_TRUE(contains(r.out, rewrite)) << "stderr is still the terminal";
    EXPECT_FALSE(contains(read_file(scratch.path("table")), "\033"));
    EXPECT_FALSE(contains(read_file(scratch.path("r.json")), "\033"));
}

}  // namespace
}  // namespace barycert::cli_test

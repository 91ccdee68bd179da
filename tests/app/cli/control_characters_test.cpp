// Texts from files, names and arguments cannot act on a terminal: they are shown escaped.

#include <cctype>
#include <filesystem>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

namespace fs = std::filesystem;

/// Colours the screen, rings, sets the title, and makes a line of its own.
const std::string evil = "\033[31m\a\033]0;x\033\\\nerror: \xc2\x9b\xff";
const std::string shown = "\\x1b[31m\\x07\\x1b]0;x\\x1b\\\\nerror: \\xc2\\x9b\\xff";

/// All that a user may see: stdout and stderr, on a terminal and not.
void expect_harmless(const Words& arguments, const How& how, const std::string& part = shown) {
    for (const bool terminal : {false, true}) {
        How ways = how;
        ways.terminal = terminal;
        const Ended r = run(arguments, ways);
        std::string text = r.out + r.err;
        EXPECT_TRUE(contains(text, part)) << ::testing::PrintToString(arguments) << text;
        // The program's own colours and its line of progress.
        for (const std::string own : {"\033[K", "\033[0m", "\033[1m", "\033[2m", "\033[31m", "\033[32m"}) {
            for (std::size_t at = 0; terminal && (at = text.find(own, at)) != std::string::npos;)
                text.erase(at, own.size());
        }
        for (const char c : text) {
            const bool allowed =
                c == '\n' || (terminal && c == '\r') || std::iscntrl(static_cast<unsigned char>(c)) == 0;
            EXPECT_TRUE(allowed) << ::testing::PrintToString(arguments) << static_cast<int>(c);
            if (!allowed) return;
        }
        EXPECT_FALSE(contains(text, "\xc2\x9b") || contains(text, "\xff"));
    }
}

TEST(ControlCharacters, InNamesOfFiles) {
    const Scratch scratch;
    const std::string stem = scratch.path("m" + evil);
    for (const std::string suffix : {".node", ".ele"})
        fs::copy_file(fs::path(mesh("bracket")).replace_extension(suffix), stem + suffix);
    const std::string points = scratch.put("p" + evil + ".csv", "0,0,0\n0,0,x\n");
    const How here{.folder = scratch.folder()};
    expect_harmless({"check", stem}, here);
    expect_harmless({"check", stem + "2"}, here);
    expect_harmless({"audit", stem, "--count", "5", "--kernel", "tetrahedron.cramer"}, here);
    expect_harmless({"sample", stem, "--points", points, "--output", "-"}, here);
    expect_harmless({"sample", mesh("bracket"), "--points", scratch.path(evil), "--output", "-"}, here);
    expect_harmless({"resample", stem + "2", "--grid", "2x2x2", "--output", "r.csv"}, here);
    expect_harmless({"replay", scratch.path("w" + evil)}, here);
    expect_harmless({"render", "mesh", stem + "2", "--output", "r.png"}, here);
    expect_harmless({"render", "mesh", stem, "--field", evil, "--output", "r.png"}, here);
    expect_harmless({"render", scratch.path(evil + ".json"), "--output", "r.png"}, here);
    expect_harmless({"render", "texture", "--image", scratch.path(evil), "--output", "r.png"}, here);
    expect_harmless({"audit", "--kernel-library", scratch.path("k" + evil)}, here);
#ifdef BARYCERT_TETGEN_PROGRAM
    expect_harmless({scratch.path(evil + ".poly")}, {.program = BARYCERT_TETGEN_PROGRAM});
#endif
}

TEST(ControlCharacters, InArguments) {
    for (const Words& arguments :
         std::vector<Words>{{evil},
                            {"audit", "--" + evil},
                            {"audit", "--count", evil},
                            {"audit", "--kernel", evil},
                            {"audit", "--family", evil},
                            {"audit", "--fail-on", evil},
                            {"kernels", evil},
                            {"sample", "m", "--points", "p", "--output", evil},
                            {"sample", "m", "--points", "p", "--output", "r", "--outside", evil},
                            {"resample", "m", "--output", "r", "--grid", evil},
                            {"replay", "--family", evil, "--case", "1"}})
        expect_harmless(arguments, {});
    expect_harmless({"replay", "--family", "huge", "--case", "1", "--simplex", evil}, {});
#ifdef BARYCERT_TETGEN_PROGRAM
    expect_harmless({"x.poly", "--switches", evil}, {.program = BARYCERT_TETGEN_PROGRAM}, "x1b");
#endif
}

TEST(ControlCharacters, InFiles) {
    const Scratch scratch;
    const How here{.folder = scratch.folder()};
    scratch.put("bad.node", "3 2 0 0\n0 0 0\n1 " + evil + " 0\n2 0 1\n");
    scratch.put("bad.ele", "1 3 0\n0 0 1 2\n");
    const std::string first_line = "\\x1b[31m\\x07\\x1b]0;x\\x1b\\";
    expect_harmless({"check", "bad"}, here, first_line);
    scratch.put("p.csv", "x,y,z\n0,0," + evil + "\n");
    expect_harmless({"sample", mesh("bracket"), "--points", "p.csv", "--output", "-"}, here, first_line);
    scratch.put("f.txt", "1\n" + evil + "\n");
    expect_harmless(
        {"sample", mesh("bracket"), "--points", scratch.put("q.csv", "0,0,0\n"), "--output", "-", "--field", "t=f.txt"},
        here, "x1b[31m");
    scratch.put("bad.poly", "4 3 0 0\n0 0 0 0\n1 " + evil + "\n");
#ifdef BARYCERT_TETGEN_PROGRAM
    expect_harmless({"bad.poly"}, {.folder = scratch.folder(), .program = BARYCERT_TETGEN_PROGRAM}, "x1b[31m");
#endif
    // A witness file may be from anybody.
    const Ended made = run({"audit", "--quiet", "--count", "20", "--family", "sliver.*", "--kernel",
                            "tetrahedron.cramer", "--witnesses", scratch.path("w.json")});
    ASSERT_EQ(made.code, 0) << made.err;
    auto witnesses = parse(read_file(scratch.path("w.json")));
    for (auto& w : witnesses["witnesses"]) {
        for (const char* word : {"kernel", "family", "reason"}) w[word] = "\033[31m\a\n\u009b";
    }
    scratch.put("w.json", witnesses.dump());
    expect_harmless({"replay", "w.json"}, here, "\\x1b[31m\\x07\\n\\xc2\\x9b");
}

TEST(ControlCharacters, InNamesOfFields) {
    const Scratch scratch;
    const std::string name = "t\033[31m\a";
    scratch.put("p.csv", "0,0,0\n");
    const Words line{"sample", mesh("cube-hole"), "--points", "p.csv", "--field", name + "=f.txt", "--output", "-"};
    const Ended count = run({"check", mesh("cube-hole"), "--json", "-"});
    std::string rows;
    for (std::size_t i = 0; i < parse(count.out)["nodes"].get<std::size_t>(); ++i) rows += "1\n";
    scratch.put("f.txt", rows);
    // A program that reads the rows gets the name as it is, a terminal does not.
    const Ended piped = run(line, {.folder = scratch.folder()});
    EXPECT_EQ(piped.code, 0) << piped.err;
    EXPECT_TRUE(contains(piped.out, name));
    EXPECT_FALSE(contains(piped.err, name));
    const Ended terminal = run(line, {.folder = scratch.folder(), .terminal = true});
    EXPECT_FALSE(contains(terminal.out, name));
    EXPECT_TRUE(contains(terminal.out, "t\\x1b[31m\\x07"));
}

}  // namespace
}  // namespace barycert::cli_test

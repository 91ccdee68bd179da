// Places that cannot be written: told before the work where that can be known, always exit 2, and never a half file.

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

namespace fs = std::filesystem;

/// So many cases that a run which starts to work meets the test's time limit.
const std::string endless = "1000000000000";

void expect_told_before_the_work(const Words& more, const std::string& says, const How& how = {}) {
    Words arguments{"audit", "--count", endless, "--kernel", "segment.*"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended r = run(arguments, how);
    EXPECT_EQ(r.code, 2) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_TRUE(contains(r.err, says)) << r.err;
}

TEST(Output, MissingFoldersAndFoldersAreToldBeforeTheWork) {
    const Scratch scratch;
    for (const std::string option : {"--json", "--witnesses", "--plot"}) {
        const std::string missing = scratch.path("none/r.json");
        expect_told_before_the_work({option, missing}, "error: " + missing + ": cannot make a file beside the target");
        expect_told_before_the_work({option, missing}, "make the folder first");
        expect_told_before_the_work({option, scratch.folder()}, "error: " + scratch.folder() + ": cannot write");
    }
    EXPECT_EQ(scratch.names(), Words{});
}

TEST(Output, OnePlaceForTwoOutputsIsRefused) {
    const Scratch scratch;
    expect_told_before_the_work({"--json", "-", "--witnesses", "-"}, "--json and --witnesses name the same output");
    const std::string file = scratch.path("r.json");
    expect_told_before_the_work({"--json", file, "--witnesses", scratch.folder() + "/./r.json"}, "the same output");
    fs::create_symlink(file, scratch.path("link"));
    scratch.put("r.json", "old");
    expect_told_before_the_work({"--json", file, "--witnesses", scratch.path("link")}, "the same output");
    EXPECT_EQ(read_file(file), "old");
    for (const std::string option : {"--json", "--witnesses"}) {
        expect_told_before_the_work({option, "-", "--plot", "-"}, option + " and --plot name the same output");
        expect_told_before_the_work({option, file, "--plot", scratch.path("link")}, "name the same output");
    }
    EXPECT_EQ(read_file(file), "old");
}

TEST(Output, WithoutTheRightToWriteItIsToldBeforeTheWork) {
    const How nobody{.as_nobody = true};
    if (run({"--version"}, nobody).code != 0) GTEST_SKIP() << "the program's folder is closed to other users";
    const Scratch scratch;
    ASSERT_EQ(::chmod(scratch.folder().c_str(), 0555), 0);
    const std::string file = scratch.path("r.json");
    expect_told_before_the_work({"--json", file}, "Permission denied; choose a folder", nobody);
    ASSERT_EQ(::chmod(scratch.folder().c_str(), 0777), 0);
    scratch.put("r.json", "old");
    ASSERT_EQ(::chmod(file.c_str(), 0444), 0);
    expect_told_before_the_work({"--json", file}, "Permission denied; choose a folder", nobody);
    EXPECT_EQ(read_file(file), "old");
    EXPECT_EQ(scratch.names(), Words{"r.json"});
    // A device may be written even though nobody may make files beside it.
    const Ended null =
        run({"audit", "--quiet", "--count", "1", "--kernel", "segment.*", "--json", "/dev/null"}, nobody);
    EXPECT_EQ(null.code, 0) << null.err;
}

TEST(Output, APipeGetsTheWholeReport) {
    const Scratch scratch;
    ASSERT_EQ(::mkfifo(scratch.path("pipe").c_str(), 0666), 0);
    const Ended r =
        run_shell("cat pipe > copy & barycert audit --quiet --count 5 --kernel 'segment.*' --json pipe; wait",
                  {.folder = scratch.folder()});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(parse(read_file(scratch.path("copy")))["schema"], 1);
}

TEST(Output, AFullDiskIsAnErrorThatDoesNotCostTheTable) {
    for (const std::string option : {"--json", "--witnesses"}) {
        const Ended r = run({"audit", "--count", "5", "--kernel", "segment.*", option, "/dev/full"});
        EXPECT_EQ(r.code, 2);
        EXPECT_TRUE(contains(r.err, "error: /dev/full: cannot write the file: found No space left on device; free"));
        EXPECT_TRUE(contains(r.out, "segment.projection"));
    }
    for (const Words& arguments : std::vector<Words>{{"audit", "--count", "5", "--kernel", "segment.*"},
                                                     {"audit", "--count", "5", "--kernel", "segment.*", "--json", "-"},
                                                     {"kernels"},
                                                     {"families", "--json", "-"},
                                                     {"replay", "--family", "mesh.faces", "--case", "1"}}) {
        const Ended r = run(arguments, {.stdout_path = "/dev/full"});
        EXPECT_EQ(r.code, 2) << ::testing::PrintToString(arguments);
        EXPECT_EQ(r.err, "error: cannot write to stdout: found No space left on device\n");
    }
}

TEST(Output, ThePictureAppearsWholeAndAloneOnStdout) {
    const Scratch scratch;
    const Words some{"audit", "--count", "200", "--family", "sliver.*", "--kernel", "tetrahedron.cramer"};
    const auto with = [&](const Words& more, const How& how = {}) {
        Words arguments = some;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments, how);
    };
    const std::string file = scratch.put("plot.picture", "old");
    const Ended r = with({"--plot", file});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "tetrahedron.cramer")) << "the table";
    const std::string picture = read_file(file);
    EXPECT_TRUE(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"));
    EXPECT_TRUE(contains(picture, ">cramer</text>"));
    EXPECT_EQ(scratch.names(), Words{"plot.picture"});
    for (const std::string threads : {"1", "2"}) EXPECT_EQ(with({"--plot", "-", "--threads", threads}).out, picture);
    const Ended cut = with({"--quiet", "--plot", file}, {.max_file = 4096});
    EXPECT_EQ(cut.code, 2);
    EXPECT_EQ(read_file(file), picture);
    EXPECT_EQ(scratch.names(), Words{"plot.picture"});
}

TEST(Output, AFileThatMayNotGrowLeavesTheOldOne) {
    const Scratch scratch;
    const std::string file = scratch.put("r.json", "old");
    const Ended r = run({"audit", "--quiet", "--count", "5", "--json", file}, {.max_file = 4096});
    EXPECT_EQ(r.code, 2) << "signal " << r.signal;
    EXPECT_TRUE(contains(r.err, "cannot write the file: found File too large")) << r.err;
    EXPECT_EQ(read_file(file), "old");
    EXPECT_EQ(scratch.names(), Words{"r.json"});
}

#ifdef BARYCERT_TETGEN_PROGRAM
TEST(Output, AMeshThatMayNotGrowIsNoCrashOfTheMesher) {
    const Scratch scratch;
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the sanitizer's own files may not grow, either";
#endif
    const Ended r = run({std::string(BARYCERT_DATA_DIR) + "/plc/cube-hole.poly", "--output", scratch.path("m")},
                        {.max_file = 600, .program = BARYCERT_TETGEN_PROGRAM});
    EXPECT_EQ(r.code, 2) << "signal " << r.signal;
    EXPECT_TRUE(contains(r.err, "cannot write the file: found File too large")) << r.err;
    EXPECT_FALSE(contains(r.err, "crashed")) << r.err;
    EXPECT_EQ(scratch.names(), Words{});
}
#endif

TEST(Output, ClosedStreamsAreNoCrash) {
    const Words small{"audit", "--count", "5", "--kernel", "segment.*"};
    expect_told_before_the_work({}, "cannot write to stdout", {.close_stdout = true});
    expect_told_before_the_work({"--json", "-"}, "cannot write to stdout", {.close_stdout = true});
    const Ended listed = run({"kernels"}, {.close_stdout = true});
    EXPECT_EQ(listed.code, 2);
    EXPECT_TRUE(contains(listed.err, "cannot write to stdout"));
    // With nothing to print, a closed stdout is no trouble; and no file may end up in its place.
    const Scratch scratch;
    const Ended quiet = run({"audit", "--quiet", "--count", "5", "--kernel", "segment.*", "--json", scratch.path("r"),
                             "--witnesses", scratch.path("w")},
                            {.close_stdout = true, .close_stderr = true});
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(parse(read_file(scratch.path("r")))["schema"], 1);
    EXPECT_EQ(parse(read_file(scratch.path("w")))["schema"], 1);
    // An error that cannot be told is still an error.
    for (const How& how : {How{.close_stderr = true}, How{.stderr_path = "/dev/full"}}) {
        EXPECT_EQ(run({"audit", "--kernel", "zzz"}, how).code, 2);
        EXPECT_EQ(run({"audit", "--count", "5", "--kernel", "segment.*", "--fail-on", "any"}, how).code, 1);
    }
}

TEST(Output, AReaderThatStopsReadingDoesNotCostTheFiles) {
    const Scratch scratch;
    const Ended r =
        run_shell("(barycert audit --count 5 --json r.json; echo $? > code) | head -n 1", {.folder = scratch.folder()});
    EXPECT_EQ(r.code, 0);
    EXPECT_EQ(lines_of(r.out).size(), 1U);
    EXPECT_EQ(parse(read_file(scratch.path("r.json")))["schema"], 1);
    // Ended by SIGPIPE as any filter, or finished before `head` did; nothing else.
    const std::string code = read_file(scratch.path("code"));
    EXPECT_TRUE(code == "141\n" || code == "0\n" || code == "2\n") << code;
    EXPECT_TRUE(r.err.empty() || contains(r.err, "cannot write to stdout: found Broken pipe")) << r.err;
}

}  // namespace
}  // namespace barycert::cli_test

// barycert sample: maps, files that cannot be, streams of any length, and runs that are ended.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

/// So many points of a lattice in and around the unit cube, as a line of shell writes them.
std::string lattice(int count) {
    return "awk 'BEGIN { for (i = 0; i < " + std::to_string(count) +
           "; ++i) print (i % 97) / 90, (i % 89) / 88, (i % 83) / 82 }'";
}

TEST(SampleMap, GivesTheSameBytesAsThePoints) {
    const Scratch scratch;
    const std::string points = scratch.path("p.csv"), map = scratch.path("p.map");
    ASSERT_EQ(run_shell(lattice(3000) + " > p.csv", {.folder = scratch.folder()}).code, 0);
    const std::string bracket = mesh("bracket");
    for (const std::string all : {"lowest", "all"}) {
        for (const std::string policy : {"nan", "fill=2", "nearest", "nearest=0.1", "extrapolate"}) {
            const Words line{"sample", bracket, "--outside", policy, "--json", scratch.path("j"), "--output", "-"};
            const Ended made = run(plus(line, {"--points", points, "--save-map", map, "--on-boundary", all}));
            EXPECT_EQ(made.code, 0) << made.err;
            const auto first = parse(read_file(scratch.path("j")));
            EXPECT_GT(first["outside"]["count"], 0);
            const Ended used = run(plus(line, {"--map", map}));
            EXPECT_EQ(used.code, 0) << used.err;
            EXPECT_TRUE(used.out == made.out) << all << ' ' << policy;
            const auto second = parse(read_file(scratch.path("j")));
            EXPECT_EQ(second["method"], "map");
            EXPECT_EQ(second["file"], map);
            for (const std::string same : {"points", "rows", "on_boundary", "inside", "outside", "values"})
                EXPECT_EQ(second[same], first[same]) << all << ' ' << policy << ' ' << same;
        }
    }
    expect_error({"sample", bracket, "--map", map, "--output", "-", "--on-boundary", "lowest"},
                 "--on-boundary differs from the map: expected all, found lowest");
    expect_error({"sample", bracket, "--map", map, "--output", "-", "--outside", "error"}, "is outside the mesh");
    expect_error({"sample", mesh("cube-hole"), "--map", map, "--output", "-"}, "error: " + map + ":");
    expect_error({"sample", bracket, "--map", map, "--points", points, "--output", "-"}, "--points, --map and --line");
    expect_error({"sample", bracket, "--map", map, "--save-map", map, "--output", "-"},
                 "--save-map cannot be combined with --map");
    expect_error({"sample", bracket, "--map", "-", "--output", "-"}, "a map cannot come from stdin");
    std::string damaged = read_file(map);
    damaged[damaged.size() / 2] ^= 1;
    scratch.put("r.csv", "old");
    expect_error({"sample", bracket, "--map", scratch.put("bad.map", damaged), "--output", scratch.path("r.csv")},
                 "error: " + scratch.path("bad.map") + ":");
    EXPECT_EQ(read_file(scratch.path("r.csv")), "old");
}

TEST(SampleFiles, WhatIsNotUnderstoodIsRefused) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    const Words in{"sample", two, "--points", points}, line = plus(in, {"--output", "-"});
    const std::vector<std::pair<Words, std::string>> refusals{
        {{"sample"}, "MESH is required"},
        {{"sample", two, "--points", points},
         "no output: expected --output FILE, --weights FILE or --plot FILE, found none"},
        {{"sample", two, "--output", "-"},
         "no points: expected one of --points FILE, --map FILE and --line A:B, found none"},
        {plus(in, {"--output", ""}), "--output"},
        {{"sample", two, "--points", "", "--output", "-"}, "--points"},
        {plus(line, {"--json", ""}), "--json"},
        {plus(line, {"--save-map", ""}), "--save-map"},
        {plus(line, {"--threads", "-1"}), "--threads"},
        {plus(line, {"--threads", "two"}), "--threads"},
        {plus(line, {"--threads", "4097"}), "--threads"},
        {plus(line, {"--rounding", "wrong"}), "--rounding"},
        {plus(line, {"--certify", "auto"}), "--certify"},  // dropped: the index always proves
        {plus(line, {"--on-boundary", "some"}), "--on-boundary"},
        {plus(line, {"--outside", "far"}), "--outside"},
        {plus(line, {"--outside", "fill"}), "--outside"},
        {plus(line, {"--outside", "fill=x"}), "--outside"},
        {plus(line, {"--outside", "nearest=-1"}), "--outside"},
        {plus(line, {"--outside", "nearest=inf"}), "--outside"},
        {plus(line, {"--outside", "nearest="}), "--outside"},
        {plus(in, {"--output", scratch.path("r.xlsx")}),
         "expected .csv, .npy or .vtu, or - for CSV on stdout, found \".xlsx\""},
        {plus(in, {"--output", scratch.path("r")}), "found no suffix"},
        {{"sample", two, "--points", scratch.path("no.csv"), "--output", "-"},
         "error: " + scratch.path("no.csv") + ": cannot read the file"},
        {{"sample", scratch.path("no"), "--points", points, "--output", "-"}, "MESH is the stem of TetGen's files"},
        {{"sample", mesh("plate"), "--points", scratch.put("p.node", "1 3 0 0\n1 0 0 1\n"), "--output", "-"}, "p.node"},
        {{"sample", two, "--points", scratch.put("bad.csv", "x,y,z\n0,0,0\n0,zero,0\n"), "--output", "-"},
         "bad.csv:3: "},
        {{"sample", two, "--points", scratch.put("nan.csv", "0,0,0\n0,nan,0\n"), "--output", "-"}, "nan.csv:2: "}};
    for (const auto& [arguments, says] : refusals) {
        const Ended r = run(arguments);
        EXPECT_EQ(r.code, 2) << ::testing::PrintToString(arguments);
        EXPECT_TRUE(contains(r.err, says)) << ::testing::PrintToString(arguments) << r.err;
    }
    EXPECT_EQ(run({"sample", "--help"}).code, 0);
}

TEST(SampleFiles, NoOutputIsAnInputOrAnotherOutput) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    const std::string field = scratch.put("f.csv", "1\n1\n1\n1\n1\n"), out = scratch.path("r.csv");
    const Words line{"sample", two, "--points", points, "--field", "t=" + field};
    const std::vector<std::pair<Words, std::string>> refusals{
        {{"--output", points}, "--output would overwrite --points"},
        {{"--output", field}, "--output would overwrite field t"},
        {{"--output", out, "--json", two + ".node"}, "--json would overwrite the mesh"},
        {{"--output", out, "--save-map", two + ".ele"}, "--save-map would overwrite the mesh"},
        {{"--output", out, "--json", scratch.folder() + "/./r.csv"}, "--output and --json name the same output"},
        {{"--output", "-", "--json", "-"}, "--output and --json name the same output"},
        {{"--output", out, "--save-map", out}, "--output and --save-map name the same output"},
        {{"--output", scratch.path("none/r.csv")}, "make the folder first"}};
    for (const auto& [more, says] : refusals) expect_error(plus(line, more), says);
    EXPECT_EQ(read_file(points), six_points);
    EXPECT_EQ(scratch.names(), (Words{"f.csv", "p.csv", "two.ele", "two.node"}));
}

TEST(SampleFiles, AppearWholeOrNotAtAll) {
    const Scratch scratch;
    const std::string out = scratch.put("r.csv", "old"), map = scratch.put("r.map", "old");
    ASSERT_EQ(run_shell(lattice(20000) + " > p.csv", {.folder = scratch.folder()}).code, 0);
    const Words line{"sample", mesh("bracket"), "--points", scratch.path("p.csv"), "--save-map", map, "--output"};
    for (const std::string& target : {out, scratch.path("r.npy")})
        expect_error(plus(line, {target}), "File too large", {.max_file = 100000});
    EXPECT_EQ(read_file(out), "old");
    EXPECT_EQ(read_file(map), "old");
    EXPECT_EQ(scratch.names(), (Words{"p.csv", "r.csv", "r.map"}));
    const Ended full = run({"sample", mesh("bracket"), "--points", scratch.path("p.csv"), "--output", "-"},
                           {.stdout_path = "/dev/full"});
    EXPECT_EQ(full.code, 2);
    EXPECT_TRUE(contains(full.err, "No space left on device")) << full.err;
    // A fault in the points, found late: nothing of what stood before it.
    ASSERT_EQ(run_shell("echo 1,2 >> p.csv", {.folder = scratch.folder()}).code, 0);
    expect_error(plus(line, {out}), "p.csv:20001: ");
    EXPECT_EQ(read_file(out), "old");
    EXPECT_EQ(scratch.names(), (Words{"p.csv", "r.csv", "r.map"}));
    const How nobody{.as_nobody = true};
    if (run({"--version"}, nobody).code != 0) return;
    ASSERT_EQ(::chmod(scratch.folder().c_str(), 0777), 0);
    ASSERT_EQ(::chmod(scratch.path("p.csv").c_str(), 0), 0);
    expect_error(plus(line, {out}), "p.csv: cannot read the file: found Permission denied", nobody);
}

/// Memory of a run on so many times 100,000 points from a pipe, in KiB, when it has read all but the last of them.
std::size_t peak_memory(int times) {
    const Scratch scratch;
    for (const char* pipe : {"points", "rows"}) EXPECT_EQ(::mkfifo(scratch.path(pipe).c_str(), 0666), 0);
    const Ended r =
        run_shell(lattice(100000) + " > some; barycert sample " + mesh("cube-hole") +
                      " --points - --output - --fields attribute0 --quiet < points > rows & id=$!; wc -l < rows & { "
                      "for i in $(seq " +
                      std::to_string(times) +
                      "); do cat some; done; grep VmHWM /proc/$id/status | tr -dc 0-9 > peak; } > points; wait",
                  {.folder = scratch.folder()});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, std::to_string(100000 * times + 1) + "\n");
    return std::stoul("0" + read_file(scratch.path("peak")));
}

TEST(SampleStream, MemoryDoesNotGrowWithThePoints) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
    // Five blocks and eight: the first ones find what all of them use. Were only the coordinates kept, three million
    // points more would take 72 MB more.
    const std::size_t some = peak_memory(54), more = peak_memory(84);
    EXPECT_GT(some, 20000U);
    EXPECT_LT(more, some + 32 * 1024) << some;
    RecordProperty("KiB", std::to_string(more));
}

class SampleKilled : public ::testing::TestWithParam<int> {};

TEST_P(SampleKilled, WhileItWrites) {
    const Scratch scratch;
    const std::string out = scratch.put("r.csv", "old"), points = scratch.path("p.csv");
    ASSERT_EQ(::mkfifo(points.c_str(), 0666), 0);
    // Several blocks, so that some are written; then the pipe stays open and the run waits for more.
    ASSERT_EQ(::signal(SIGPIPE, SIG_IGN) == SIG_ERR, false);
    std::atomic<bool> over = false;
    std::thread writer([&] {
        const int pipe = ::open(points.c_str(), O_WRONLY);
        std::string text;
        for (int i = 0; i < 10000; ++i) text += "0 0 0\n";
        for (int i = 0; i < 400; ++i) {
            for (std::size_t at = 0; at < text.size();) {
                const ssize_t n = ::write(pipe, text.data() + at, text.size() - at);
                if (n <= 0) break;
                at += static_cast<std::size_t>(n);
            }
        }
        while (!over) ::usleep(1000);
        ::close(pipe);
    });
    const Ended r = run({"sample", mesh("cube-hole"), "--points", points, "--output", out},
                        {.terminal = true, .kill_on = "points: ", .kill_with = GetParam()});
    over = true;
    writer.join();
    EXPECT_EQ(r.signal, GetParam());
    EXPECT_EQ(read_file(out), "old");
    // SIGKILL may leave a file beside the target, never in its place.
    if (GetParam() != SIGKILL) {
        EXPECT_EQ(scratch.names(), (Words{"p.csv", "r.csv"}));
    }
}

INSTANTIATE_TEST_SUITE_P(signals, SampleKilled, ::testing::Values(SIGKILL, SIGINT, SIGTERM, SIGHUP),
                         [](const auto& signal) { return "signal_" + std::to_string(signal.param); });

}  // namespace
}  // namespace barycert::cli_test

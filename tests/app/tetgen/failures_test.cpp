/// Every failure: exit code 2, an `error:` line that names the file, nothing written.
#include "tests/app/tetgen/harness.hpp"

namespace barycert::test {
namespace {

class Failures : public ::testing::Test {
protected:
    /// Runs with the given words after the input's path and expects `message` in the error and no further files.
    void expect_failure(const std::string& input, const std::string& message, std::vector<std::string> more = {}) {
        const std::size_t before = folder_.names().size();
        more.insert(more.begin(), input);
        const Outcome run = run_tetgen(std::move(more));
        EXPECT_EQ(run.code, 2) << input;
        EXPECT_EQ(run.out, "");
        EXPECT_TRUE(run.err.starts_with("error: ")) << run.err;
        EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
        EXPECT_EQ(folder_.names().size(), before) << "files are left";
    }
    void expect_bad_file(const std::string& name, const std::string& text, const std::string& message) {
        const std::string path = folder_.put(name, text);
        expect_failure(path, path + message);
    }

    Scratch folder_;
};

TEST_F(Failures, BeforeReading) {
    expect_failure(folder_.path("none.poly"), "none.poly: no such file");
    expect_bad_file("cube.xyz", cube_off(), ": unknown kind of PLC: expected one of .poly .smesh .off .stl .ply .obj");
    expect_bad_file("cube", cube_off(), ": unknown kind of PLC");
    expect_bad_file("empty.poly", "", ": cannot read: expected a PLC, found an empty file");
    std::filesystem::create_directory(folder_.path("folder.poly"));
    expect_failure(folder_.path("folder.poly"), "folder.poly: cannot read: expected a file, found a directory");
}

// A file cut anywhere must be refused. In a .poly only what follows the facets may be missing, as in TetGen.
TEST_F(Failures, TruncatedAnywhere) {
    const std::string poly = cube_poly();
    const std::size_t needed = poly.rfind("\n0\n");
    for (std::size_t length = 0; length + 1 < needed; length += 3) {
        expect_bad_file("cut.poly", poly.substr(0, length), ":");
    }
    const std::string off = cube_off();
    for (std::size_t length = 0; length + 2 < off.size(); length += 5) {
        expect_bad_file("cut.off", off.substr(0, length), ":");
    }
    expect_bad_file("cut.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n",
                    ":5: the file is truncated: expected endsolid");
    expect_bad_file("cut.ply", "ply\nformat ascii 1.0\nelement vertex 8\n", ":3: the file is truncated");
}

// "2" may be the beginning of "25": it is taken, for the counts are right, and told.
TEST_F(Failures, NumbersThatTheEndOfTheFileMayHaveCut) {
    const std::string message = "guessed: the last line has no end: its last number is taken as whole";
    const auto expect_told = [&](const std::string& path, const std::string& file) {
        const Outcome run = run_tetgen({path});
        EXPECT_EQ(run.code, 0) << run.err;
        EXPECT_NE(run.err.find("note: " + file + ": " + message), std::string::npos) << run.err;
    };
    const std::string poly = cube_poly(), off = cube_off();
    const std::string cut_poly = folder_.put("cut.poly", poly.substr(0, poly.size() - 1));
    const std::string cut_off = folder_.put("cut.off", off.substr(0, off.size() - 1));
    expect_told(cut_poly, cut_poly);
    expect_told(cut_off, cut_off);
    const std::string apart = folder_.put("apart.poly", "0\n6 0\n" + side_rows(0, "1\n", "") + "0\n");
    const std::string rows = "8 3 0 0\n" + cube_rows(0, true);
    const std::string nodes = folder_.put("apart.node", rows.substr(0, rows.size() - 1));
    expect_told(apart, nodes);
    // Another end than a line end is one, too.
    EXPECT_EQ(run_tetgen({folder_.put("whole.off", off.substr(0, off.size() - 1) + " ")}).code, 0);
}

// A pipe without a writer is told at once; one that has been written to is a file.
TEST_F(Failures, Pipes) {
    ASSERT_EQ(mkfifo((folder_.path("pipe.off")).c_str(), 0600), 0);
    expect_failure(folder_.path("pipe.off"),
                   "pipe.off: cannot read the file: expected data, found nothing: a pipe that "
                   "nobody writes to");
    ASSERT_EQ(mkfifo((folder_.path("pipe.node")).c_str(), 0600), 0);
    const std::string apart = folder_.put("pipe.poly", "0\n6 0\n" + side_rows(0, "1\n", "") + "0\n");
    expect_failure(apart, "pipe.node: cannot read the file");
    // Bytes that are written stay in the pipe as long as somebody has it open for reading.
    const int reader = open((folder_.path("pipe.off")).c_str(), O_RDONLY | O_NONBLOCK);
    const int writer = open((folder_.path("pipe.off")).c_str(), O_WRONLY);
    const std::string off = cube_off();
    ASSERT_EQ(write(writer, off.data(), off.size()), static_cast<ssize_t>(off.size()));
    close(writer);
    const Outcome run = run_tetgen({folder_.path("pipe.off")});
    close(reader);
    EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(Failures, Contradictory) {
    std::string text = cube_poly();
    text.replace(text.find("4 0 1 5 4"), 9, "4 0 1 5 8");
    expect_bad_file("index.poly", text, ":14: no such node: expected 0 to 7, found 8");
    expect_bad_file("huge.poly", "2000000000 3 0 0\n0 0 0 0\n", ":1: the count is more than the file can hold");
    expect_bad_file("negative.poly", "-4 3 0 0\n", ":1: cannot read: expected the number of nodes, found -4");
    expect_bad_file("plane.poly", "4 2 0 0\n", ":1: cannot mesh: expected dimension 3, found 2");
    expect_bad_file("words.poly", "many\n", ":1: cannot read: expected the number of nodes, found many");
    expect_bad_file("facets.poly", "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n0 0\n", ": nothing to mesh");
    expect_bad_file("more.off", cube_off() + "3 0 1 2\n", ":17: more lines than the header announces");
    expect_bad_file("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ":6: no such node");
    expect_bad_file("binary.ply", "ply\nformat binary_little_endian 1.0\n", ":2: the file is truncated");
    expect_bad_file("other.ply", "ply\nformat xml 1.0\n", ":2: cannot read: expected ascii, binary_little_endian");
    expect_bad_file("words.obj", cube_off(), ": nothing to mesh: the PLC has no facets");
    const std::string big_endian("\0\0\0\1", 4);
    expect_bad_file("big.stl", std::string(80, ' ') + big_endian + std::string(50, '\0'),
                    ": neither a text nor a whole binary .stl");
    expect_bad_file("short.stl", std::string(90, 'x'), ": neither a text nor a whole binary .stl");
    const std::string apart = folder_.put("apart.poly", "0\n6 0\n" + side_rows(0, "1\n", "") + "0\n");
    expect_failure(apart, "apart.node: no such file");
}

TEST_F(Failures, SelfIntersecting) {
    const std::string path = folder_.put("crossed.off",
                                         "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n.2 .2 -.5\n.3 .2 .5\n.2 .3 .5\n"
                                         ".2 .2 2\n3 0 1 2\n3 0 1 3\n3 1 2 3\n3 0 2 3\n3 4 5 6\n3 4 5 7\n3 5 6 7\n"
                                         "3 4 6 7\n");
    expect_failure(path, " pairs of triangles intersect (TetGen ");
    expect_failure(path, "`barycert check " + path + "` says where");
}

TEST_F(Failures, NotWatertight) {
    std::string open = cube_off();
    open.replace(open.find("8 6"), 3, "8 5");
    open.resize(open.find("4 4 5 6 7"));
    expect_bad_file("open.off", open, ": no cell is left: the facets do not enclose a volume");
}

TEST_F(Failures, BadOptionValues) {
    const std::string cube = folder_.put("cube.off", cube_off());
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"--quality", "0.9"},     {"--quality", "nan"},  {"--quality", "1.2x"},  {"--min-dihedral", "-1"},
             {"--min-dihedral", "90"}, {"--max-volume", "0"}, {"--max-volume", "-1"}, {"--max-volume", "inf"},
             {"--order", "3"},         {"--index-base", "2"}, {"--timeout", "0"},     {"--timeout", "x"},
             {"--switches", "ph"},     {"--switches", "pr"},  {"--switches", "-pq"},  {"--switches", "p!"},
             {"--switches", ""},       {"--no-such-option"},  {"second.off"},         {"--max-volume"}}) {
        expect_failure(cube, words[0] == "second.off" ? "second.off" : words[0], words);
    }
    expect_failure(cube, "--switches", {"--switches", "pq", "--order", "2"});
    expect_failure("--quality", "put INPUT first", {cube, "--quiet"});
    expect_failure("--quiet", "expected INPUT");
}

TEST_F(Failures, UnwritableOutput) {
    const std::string cube = folder_.put("cube.off", cube_off());
    expect_failure(cube, folder_.path("none/cube"), {"--output", folder_.path("none/cube")});
    expect_failure(cube, cube + "/cube", {"--output", cube + "/cube"});
    // A folder stands where the nodes should go: found out by the writer, in the child.
    std::filesystem::create_directory(folder_.path("taken.node"));
    expect_failure(cube, folder_.path("taken.node"), {"--output", folder_.path("taken")});
}

TEST_F(Failures, Timeout) {
    const std::string cube = folder_.put("cube.off", cube_off());
    expect_failure(cube, cube + ": TetGen did not end within 0.2 s", {"--max-volume", "1e-9", "--timeout", "0.2"});
}

}  // namespace
}  // namespace barycert::test

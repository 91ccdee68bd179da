// Messages about what is not as it should be: short, in the order of the command, with a remedy that works.

#include <sys/stat.h>

#include <csignal>

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

TEST(Texts, WordsThatAreNotExpectedComeInTheirOrder) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    expect_error({"sample", two, "--point", "line.csv", "--output", "-"}, "error: not expected: --point line.csv");
    expect_error({"sample", two, "--points", "a.csv", "b c.csv", "d.csv", "--output", "-"},
                 "error: not expected: 'b c.csv' d.csv");
}

TEST(Texts, AValueThatIsNoNumberIsNamed) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    const Words line{"sample", two, "--points", points, "--output", "-", "--outside"};
    expect_error(plus(line, {"fill=zero"}), "\"zero\" is no such number: fill=0.5");
    expect_error(plus(line, {"fill"}), "say with what: fill=0.5");
    expect_error(plus(line, {"nearest=-1"}), "\"-1\" is no such number: nearest=0.5");
    expect_error(plus(line, {"fil=0"}), "did you mean \"fill\"?");
}

TEST(Texts, TheNearFileIsNamed) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("points.csv", six_points);
    ASSERT_EQ(run({"resample", two, "--onto", two, "--output", scratch.path("box.vtu")}).code, 0);
    expect_error({"check", scratch.path("box.vut")},
                 "box.vut: no such file; did you mean " + scratch.path("box.vtu") + "?");
    expect_error({"sample", two, "--points", scratch.path("point.csv"), "--output", "-"},
                 "did you mean " + scratch.path("points.csv") + "?");
}

TEST(Texts, CommandsToRepeatHaveTheNameOfTheWrapper) {
    const How wrapped{.environment = {"BARYCERT_COMMAND=./run barycert"}};
    for (const Words& line : std::vector<Words>{
             {"nothing"}, {"sample", "--nothing"}, {"render", "nothing"}, {"resample", "part", "--output", "x.vti"}}) {
        const Ended r = run(line, wrapped);
        EXPECT_EQ(r.code, 2);
        EXPECT_TRUE(contains(r.err, "`./run barycert ")) << r.err;
        EXPECT_FALSE(contains(r.err, "`barycert ")) << r.err;
    }
    for (const Words& line : std::vector<Words>{{"--help"}, {"resample", "--help"}, {"help", "search"}}) {
        const Ended r = run(line, wrapped);
        EXPECT_EQ(r.code, 0);
        EXPECT_TRUE(contains(r.out, "`./run barycert ")) << r.out;
        EXPECT_FALSE(contains(r.out, "`barycert ")) << r.out;
    }
}

TEST(Texts, ResultsWithoutRowsAreNotRight) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    const std::string empty = scratch.put("e.csv", "x,y,z,cell,feature,attribute0\n");
    expect_error({"verify", two, "--results", empty}, "e.csv: there are no results to verify");
}

TEST(Texts, VerifyNamesQuantitiesAsSampleDoes) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    const std::string v = "v=" + scratch.put("v.txt", "0 0 0\n3 4 0\n0 0 2\n0 0 0\n1 1 1\n"),
                      rows = scratch.path("r.csv");
    const Words which{"--field", v, "--fields", "|v|,v.x,grad(attribute0),mean(cell:attribute0)"};
    ASSERT_EQ(run(plus({"sample", two, "--points", points, "--output", rows}, which)).code, 0);
    const Ended r = run(plus({"verify", two, "--results", rows, "--exact", "--json", "-"}, which));
    EXPECT_EQ(r.code, 0) << r.err;
    const auto j = parse(r.out);
    EXPECT_EQ(j["right"], 6);
    ASSERT_EQ(j["values"].size(), 6U);
    for (const auto& value : j["values"]) {
        const std::string name = value["name"];
        EXPECT_TRUE(name != "|v|" || value["range"] == 5) << value["range"];
        EXPECT_TRUE(name != "v.x" || value["range"] == 3) << value["range"];
    }
    std::string wrong = read_file(rows);
    wrong.replace(wrong.rfind("1,0,0,0,vertex,"), 15, "1,0,0,0,vertex,1");
    EXPECT_EQ(run(plus({"verify", two, "--results", scratch.put("w.csv", wrong)}, which)).code, 1);
}

TEST(Texts, WhatAFileCannotHoldIsTold) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    const std::string points = scratch.put("p.csv", "x,y,z,tiny,small\n.25,.25,.25,1e-400,1e-300\n1,0,0,2,0e5\n");
    const Ended kept = run({"sample", two, "--points", points, "--keep", "all", "--output", scratch.path("r.npy")});
    EXPECT_EQ(kept.code, 0) << kept.err;
    EXPECT_TRUE(contains(kept.out, "numbers of column tiny that are too small for a double to 0")) << kept.out;
    EXPECT_FALSE(contains(kept.out, "column small")) << kept.out;
    const std::string fields = scratch.put("f.txt", "0 5\n1 6\n2 7\n3 8\n4 9\n");
    const Words line{"resample", two, "--onto", two, "--field", "v=" + fields, "--fields", "v", "--output"};
    const Ended nodes = run(plus(line, {scratch.path("n.node")}));
    EXPECT_EQ(nodes.code, 0) << nodes.err;
    EXPECT_TRUE(contains(nodes.out,
                         "the names of fields, which a .node file cannot hold: attribute0 is v.0, attribute1 "
                         "is v.1"))
        << nodes.out;
    EXPECT_FALSE(contains(run(plus(line, {scratch.path("n.vtu")})).out, "names of fields"));
    EXPECT_FALSE(contains(
        run({"resample", two, "--onto", two, "--fields", "point:attribute0", "--output", scratch.path("m.node")}).out,
        "names of fields"));
}

TEST(Texts, ImportantNotesOfMeshesAreToldWhereverTheyAreRead) {
    const Scratch scratch;
    const std::string mesh = scratch.put("apart.mesh",
                                         "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                                         "0 0 1 0\n2 2 2 0\nEdges 1\n4 5 0\nTetrahedra 1\n1 2 3 4 0\nEnd\n");
    const std::string note = "note: " + mesh + ": left out: elements of a lower dimension: 1 Edges; some have nodes";
    for (const Words& command :
         {Words{"check", mesh}, Words{"gaps", mesh, "--kernel", "tetrahedron.signed-volume", "--count", "10"},
          Words{"audit", mesh, "--family", "mesh.*", "--count", "10"}}) {
        EXPECT_TRUE(contains(run(command).err, note)) << run(command).err;
        EXPECT_EQ(run(plus(command, {"--quiet"})).err, "") << command[0];
    }
}

TEST(PointsOfAnyName, TextsWithBlanksPipesAndFilesWithoutASuffix) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    const std::string blanks = ".25 .25  .25\n.5 .5 .5\n.25 .25 .5\n.5 .5 0\n1 0 0\n2 2 2\n";
    const Words rest{"--output", "-", "--fields", "point:attribute0", "--quiet"};
    EXPECT_EQ(run(plus({"sample", two, "--points", scratch.put("p.txt", blanks)}, rest)).out, six_rows);
    EXPECT_EQ(run(plus({"sample", two, "--points", scratch.put("points", blanks)}, rest)).out, six_rows);
    ASSERT_EQ(run({"sample", two, "--points", points, "--output", scratch.path("again.npy")}).code, 0);
    EXPECT_EQ(
        run(plus({"sample", two, "--points", scratch.put("again", read_file(scratch.path("again.npy")))}, rest)).out,
        six_rows);
    const std::string to_stdout = " --output - --fields point:attribute0 --quiet";
    for (const std::string line :
         {"cat p.csv | barycert sample two --points /dev/stdin", "barycert sample two --points /dev/stdin < p.csv",
          "barycert sample two --points /dev/fd/7 7< p.txt", "cat p.txt | barycert sample two --points /dev/fd/0",
          "mkfifo q; cat p.csv > q & barycert sample two --points q"}) {
        const Ended r = run_shell(line + to_stdout, {.folder = scratch.folder()});
        EXPECT_EQ(r.out, six_rows) << line << r.err;
    }
    const Ended verified = run_shell(
        "barycert sample two --points p.csv --output - --quiet | barycert verify two "
        "--results /dev/stdin",
        {.folder = scratch.folder()});
    EXPECT_TRUE(contains(verified.out, "all 6 rows are right")) << verified.out << verified.err;
    const Ended binary =
        run_shell("cat again.npy | barycert sample two --points /dev/stdin" + to_stdout, {.folder = scratch.folder()});
    EXPECT_EQ(binary.code, 2);
    EXPECT_TRUE(contains(binary.err, "NPY")) << binary.err;
}

TEST(Interrupted, SaysSoAndLeavesNothing) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Scratch scratch;
        const Ended r = run({"audit", "--count", "1000000000", "--json", scratch.path("r.json")},
                            {.terminal = true, .kill_on = " %  ", .kill_with = signal});
        EXPECT_EQ(r.signal, signal) << "a shell gives 128 + signal for it";
        EXPECT_TRUE(contains(r.out, "error: interrupted: no file was left half-written")) << r.out;
        EXPECT_EQ(scratch.names(), Words{});
    }
}

}  // namespace
}  // namespace barycert::cli_test

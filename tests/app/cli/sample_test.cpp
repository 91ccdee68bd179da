// barycert sample: rows, formats, summaries.

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

TEST(Sample, ARowAPoint) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    const Words line{"sample", two, "--points", points, "--fields", "attribute0", "--output"};
    const Ended r = run(plus(line, {"-"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, six_rows);
    EXPECT_TRUE(contains(r.err, "points     6\n")) << r.err;
    EXPECT_TRUE(
        contains(r.err, "inside     5: 2 in the interior of a cell, 1 on a face, 1 on an edge, 1 at a vertex\n"))
        << r.err;
    EXPECT_TRUE(contains(r.err, "outside    1: 1 got NaN\n")) << r.err;
    EXPECT_TRUE(contains(r.err, "mesh       2 cells, 5 nodes\n")) << r.err;
    EXPECT_TRUE(contains(r.err, "method     walk: the mesh is certified\n")) << r.err;
    // In a file the same, and then the summary stands on stdout.
    const Ended file = run(plus(line, {scratch.path("r.csv")}));
    EXPECT_EQ(read_file(scratch.path("r.csv")), six_rows);
    EXPECT_EQ(file.err, "");
    EXPECT_TRUE(contains(file.out, "points     6\n"));
    const Ended quiet = run(plus(line, {scratch.path("r.csv"), "--quiet"}));
    EXPECT_EQ(quiet.out + quiet.err, "");
    EXPECT_EQ(quiet.code, 0);
}

TEST(Sample, NoRowDependsOnMethodThreadsOrWhatThePointsComeFrom) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    scratch.put("p.node", "6 3 0 0\n1 .25 .25 .25\n2 .5 .5 .5\n3 .25 .25 .5\n4 .5 .5 0\n5 1 0 0\n6 2 2 2\n");
    const auto rows = [&](const Words& more) {
        return run(plus({"sample", two, "--output", "-", "--fields", "attribute0", "--quiet"}, more)).out;
    };
    for (const std::string threads : {"0", "1", "2", "7"})
        EXPECT_EQ(rows({"--points", points, "--threads", threads}), six_rows);
    EXPECT_EQ(rows({"--points", points, "--rounding", "plain"}), six_rows) << "these are exact in double, too";
    EXPECT_EQ(rows({"--points", scratch.path("p.node")}), six_rows);
    const Ended piped = run_shell("cat p.csv | barycert sample two --points - --output - --fields attribute0 --quiet",
                                  {.folder = scratch.folder()});
    EXPECT_EQ(piped.out, six_rows);
}

TEST(Sample, EveryCellThatHoldsAPointIfAsked) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    const Ended r =
        run({"sample", two, "--points", points, "--on-boundary", "all", "--output", "-", "--json", scratch.path("j")});
    EXPECT_EQ(r.out,
              "x,y,z,cell,feature,attribute0,cell:attribute0\n0.25,0.25,0.25,0,interior,4.5,7\n"
              "0.5,0.5,0.5,1,interior,8,9\n0.25,0.25,0.5,0,face,6.5,7\n0.25,0.25,0.5,1,face,6.5,9\n"
              "0.5,0.5,0,0,edge,4,7\n0.5,0.5,0,1,edge,4,9\n1,0,0,0,vertex,3,7\n1,0,0,1,vertex,3,9\n"
              "2,2,2,-1,outside,nan,nan\n");
    EXPECT_TRUE(contains(r.err, "points     6, in 9 rows: one for each cell that holds a point\n")) << r.err;
    const auto j = parse(read_file(scratch.path("j")));
    EXPECT_EQ(j["points"], 6);
    EXPECT_EQ(j["rows"], 9);
    EXPECT_EQ(j["on_boundary"], "all");
    EXPECT_EQ(j["inside"].dump(), R"({"count":5,"edge":1,"face":1,"interior":2,"vertex":1})");
}

TEST(Sample, PointsOutsideGetWhatIsAskedFor) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", "-1 0 0\n.25 .25 .25\n-3 0 0\n");
    const auto with = [&](const std::string& policy) {
        return run({"sample", two, "--points", points, "--fields", "attribute0", "--output", "-", "--outside", policy});
    };
    const auto expect = [&](const std::string& policy, const std::string& rows, const std::string& says) {
        const Ended r = with(policy);
        EXPECT_EQ(r.out, rows) << policy;
        EXPECT_TRUE(contains(r.err, "outside    2: " + says)) << r.err;
    };
    const std::string head = "x,y,z,cell,feature,attribute0\n", inside = "\n0.25,0.25,0.25,0,interior,4.5";
    expect("nan", head + "-1,0,0,-1,outside,nan" + inside + "\n-3,0,0,-1,outside,nan\n", "2 got NaN\n");
    expect("fill=-1.5", head + "-1,0,0,-1,outside,-1.5" + inside + "\n-3,0,0,-1,outside,-1.5\n", "2 got -1.5\n");
    const std::string far = "x,y,z,cell,feature,attribute0,distance\n";
    expect("nearest", far + "-1,0,0,-1,outside,1,1" + inside + ",0\n-3,0,0,-1,outside,1,3\n",
           "2 snapped to the nearest point of the mesh, max distance 3\n");
    expect("nearest=1.5", far + "-1,0,0,-1,outside,1,1" + inside + ",0\n-3,0,0,-1,outside,nan,nan\n",
           "1 snapped to the nearest point of the mesh, max distance 1; 1 got NaN, farther than 1.5\n");
    expect("extrapolate", far + "-1,0,0,-1,outside,-1,1" + inside + ",0\n-3,0,0,-1,outside,-5,3\n",
           "2 extrapolated from the nearest cell, max distance 3\n");
    scratch.put("r.csv", "old");
    for (const std::string all : {"lowest", "all"})
        expect_error({"sample", two, "--points", points, "--output", scratch.path("r.csv"), "--outside", "error",
                      "--on-boundary", all},
                     "error: " + points + ": point 0, counted from 0, is outside the mesh: found (-1, 0, 0); choose");
    EXPECT_EQ(read_file(scratch.path("r.csv")), "old");
    EXPECT_EQ(scratch.names(), (Words{"p.csv", "r.csv", "two.ele", "two.node"}));
    scratch.put("in.csv", "0 0 0\n1 1 1\n");
    EXPECT_EQ(run({"sample", two, "--points", scratch.path("in.csv"), "--output", "-", "--outside", "error"}).code, 0);
}

TEST(Sample, TrianglesInThePlane) {
    const Scratch scratch;
    scratch.put("t.node", "4 2 2 0\n1 0 0 0 1\n2 1 0 2 1\n3 0 1 4 1\n4 1 1 nan 1\n");
    scratch.put("t.ele", "2 3 0\n1 1 2 3\n2 2 4 3\n");
    const std::string points = scratch.put("p.csv", "y,name,x\n.25,a,.25\n.5,b,.5\n");
    const Ended refused = run({"sample", scratch.path("t"), "--points", points, "--output", "-"});
    EXPECT_EQ(refused.code, 2) << "attributes of a .node file are finite";
    scratch.put("t.node", "4 2 2 0\n1 0 0 0 1\n2 1 0 2 1\n3 0 1 4 1\n4 1 1 6 1\n");
    const Ended r = run({"sample", scratch.path("t"), "--points", points, "--output", "-"});
    EXPECT_EQ(r.out, "x,y,cell,feature,attribute0,attribute1\n0.25,0.25,0,interior,1.5,1\n0.5,0.5,0,edge,3,1\n");
}

TEST(Sample, TheJsonTellsTheRun) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    const Words line{"sample", two, "--points", points, "--output", scratch.path("r.csv"), "--json"};
    const Ended r = run(plus(line, {"-", "--outside", "nearest=9", "--threads", "1"}));
    const auto j = parse(r.out);
    EXPECT_TRUE(contains(r.err, "points     6\n")) << "the summary makes room";
    EXPECT_EQ(j["schema"], 1);
    EXPECT_EQ(j["command"], "sample");
    EXPECT_EQ(j["mesh"], two);
    EXPECT_EQ(j["file"], points);
    EXPECT_EQ(j["from"], "points");
    EXPECT_EQ(j["columns"].dump(), R"(["attribute0","cell:attribute0"])");
    EXPECT_EQ(j["outside"]["policy"], "nearest=9");
    EXPECT_EQ(j["outside"]["snapped"], 1);
    EXPECT_EQ(j["method"], "walk");
    EXPECT_EQ(j["verdict"], "certified");
    EXPECT_EQ(j["threads"], 1);
    const auto& v = j["values"];
    EXPECT_EQ(v["rounding"], "correct");
    EXPECT_EQ(v["filter"].get<int>() + v["double_double"].get<int>() + v["exact"].get<int>(), 6) << v;
    EXPECT_EQ(parse(run(plus(line, {"-", "--rounding", "plain"})).out)["values"]["rounding"], "plain");
}

TEST(Sample, CellsThatOwnNothingAndValuesThatAreNoneAreTold) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    scratch.put("two.ele", "3 4 0\n0 0 1 1 3\n1 0 1 2 3\n2 1 2 3 4\n");
    const std::string field = scratch.put("f.txt", "0\n1\n1\n1\nnan\n");
    const Ended r = run({"sample", two, "--points", points, "--field", "t=" + field, "--fields", "t", "--output",
                         scratch.path("r.csv"), "--json", scratch.path("j")});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "mesh       3 cells, 5 nodes; 1 cell is degenerate and owns nothing\n")) << r.out;
    EXPECT_TRUE(contains(r.out, "NaN        1 value at points inside: ")) << r.out;
    EXPECT_TRUE(contains(r.out, "method     walk: cells meet in common faces; degenerate ones are left out")) << r.out;
    const auto j = parse(read_file(scratch.path("j")));
    EXPECT_EQ(j["degenerate_cells"], 1);
    EXPECT_EQ(j["verdict"], "not certified");
    const std::string rows = read_file(scratch.path("r.csv"));
    std::size_t nan = 0;
    for (const std::string& line : lines_of(rows))
        nan += line.ends_with(",nan") && !contains(line, "outside") ? 1U : 0U;
    EXPECT_EQ(nan, 1U) << rows;
    EXPECT_EQ(j["values"]["nan"], 1);
}

TEST(Sample, TheMeshIsProvedWhileItIsIndexed) {
    const Scratch scratch;
    const std::string points = scratch.put("p.csv", "0 0 0\n");
    const Ended good = run({"sample", mesh("bracket"), "--points", points, "--output", "-"});
    EXPECT_TRUE(contains(good.err, "method     walk: the mesh is certified\n")) << good.err;
}

TEST(Sample, HowPointsWereFoundIsCounted) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    // The second cell again, with a node of its own inside the first: they overlap.
    scratch.put("two.ele", "3 4 0\n0 0 1 2 3\n1 1 2 3 4\n2 0 1 2 4\n");
    const Ended r = run({"sample", two, "--points", points, "--output", "-", "--json", scratch.path("j")});
    EXPECT_EQ(r.code, 0) << r.err;
    const auto ways = parse(read_file(scratch.path("j")))["ways"];
    const auto number = [&](const char* way) { return ways[way].get<int>(); };
    EXPECT_EQ(number("no_cell_near") + number("walk") + number("contested") + number("candidates"), 6) << ways;
    EXPECT_GT(number("contested") + number("candidates"), 0) << ways;
    EXPECT_TRUE(contains(r.err, "found      ")) << r.err;
    const Ended good = run({"sample", mesh("bracket"), "--points", scratch.put("q.csv", "0 0 0\n"), "--output", "-"});
    EXPECT_TRUE(contains(good.err, "found      1 ")) << good.err;
}

TEST(Sample, NothingToSampleIsNoError) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), none = scratch.put("p.csv", "x,y,z\n");
    EXPECT_EQ(run({"sample", two, "--points", none, "--output", "-", "--quiet"}).out,
              "x,y,z,cell,feature,attribute0,cell:attribute0\n");
    scratch.put("bare.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    scratch.put("bare.ele", "1 4 0\n0 0 1 2 3\n");
    const std::string one = scratch.put("one.csv", "0 0 0\n");
    const Ended bare = run({"sample", scratch.path("bare"), "--points", one, "--output", "-"});
    EXPECT_EQ(bare.out, "x,y,z,cell,feature\n0,0,0,0,vertex\n");
    EXPECT_TRUE(contains(bare.err, "values     none: the mesh has no fields, and --field was not given\n")) << bare.err;
    scratch.put("bare.ele", "0 4 0\n");
    EXPECT_EQ(run({"sample", scratch.path("bare"), "--points", one, "--output", "-", "--quiet"}).out,
              "x,y,z,cell,feature\n0,0,0,-1,outside\n");
}

}  // namespace
}  // namespace barycert::cli_test

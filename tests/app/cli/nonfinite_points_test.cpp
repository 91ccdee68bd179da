// Points that are not finite: refused, or rows of NaN that are counted, whatever file they come from.

#include <gtest/gtest.h>

#include <cstring>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

const std::string strange_points = "x,y,z\n.25,.25,.25\nnan,0,0\n2,2,2\n0,-inf,.5\n,1,1\n1,0,0\n";

/// Rows of attribute0, with that for the point that is finite and outside.
std::string rows_with(const std::string& outside) {
    return "x,y,z,cell,feature,attribute0\n0.25,0.25,0.25,0,interior,4.5\nnan,0,0,-1,outside,nan\n2,2,2,-1,outside," +
           outside + "\n0,-inf,0.5,-1,outside,nan\nnan,1,1,-1,outside,nan\n1,0,0,0,vertex,3\n";
}

TEST(NonfinitePoints, AreRefusedUnlessTheyMayBeNan) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", strange_points);
    const Words line{"sample", two, "--points", points, "--output", "-", "--fields", "point:attribute0"};
    expect_error(line,
                 "p.csv:3: bad coordinate x: expected a finite number, found \"nan\"; remove the point, give it "
                 "coordinates, or take NaN for its values: --nonfinite-points nan");
    expect_error(plus(line, {"--nonfinite-points", "nil"}), "--nonfinite-points");
    expect_error({"sample", two, "--points", scratch.put("big.csv", "1e400,0,0\n"), "--output", "-",
                  "--nonfinite-points", "nan"},
                 "a number that a double can hold");
    const Words with = plus(line, {"--nonfinite-points", "nan"});
    const Ended r = run(with);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, rows_with("nan"));
    EXPECT_TRUE(contains(r.err, "outside    4: 3 not finite, got NaN; 1 got NaN\n")) << r.err;
}

TEST(NonfinitePoints, GetNanWhateverPointsOutsideGet) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", strange_points);
    const Words line{"sample",
                     two,
                     "--points",
                     points,
                     "--output",
                     "-",
                     "--json",
                     scratch.path("j"),
                     "--nonfinite-points",
                     "nan",
                     "--fields",
                     "point:attribute0"};
    for (const std::string threads : {"1", "2"}) {
        const Ended filled = run(plus(line, {"--outside", "fill=8", "--threads", threads}));
        EXPECT_EQ(filled.out, rows_with("8")) << filled.err;
        const auto j = parse(read_file(scratch.path("j")))["outside"];
        EXPECT_EQ(j["count"], 4);
        EXPECT_EQ(j["not_finite"], 3);
        EXPECT_EQ(j["without_value"], 4);
    }
    for (const std::string policy : {"nearest", "extrapolate"}) {
        const Ended near = run(plus(line, {"--outside", policy, "--on-boundary", "all"}));
        EXPECT_EQ(near.code, 0) << near.err;
        EXPECT_TRUE(contains(near.out, "\nnan,0,0,-1,outside,nan,nan\n2,2,2,-1,outside,")) << near.out;
        EXPECT_TRUE(contains(near.out, "\n0,-inf,0.5,-1,outside,nan,nan\n")) << near.out;
        const auto j = parse(read_file(scratch.path("j")))["outside"];
        EXPECT_EQ(j[policy == "nearest" ? "snapped" : "extrapolated"], 1);
        EXPECT_EQ(j["not_finite"], 3);
    }
    // The policy for points outside refuses the one that is.
    expect_error(plus(line, {"--outside", "error"}), "point 2, counted from 0, is outside the mesh");
    const std::string all_inside = scratch.put("in.csv", "x,y,z\n.25,.25,.25\nnan,nan,nan\n");
    EXPECT_EQ(
        run({"sample", two, "--points", all_inside, "--output", "-", "--nonfinite-points", "nan", "--outside", "error"})
            .code,
        0);
}

TEST(NonfinitePoints, ComeThroughMapsWeightsAndFurtherSteps) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", strange_points);
    const std::string map = scratch.path("p.map");
    const Words nan{"--nonfinite-points", "nan", "--output", "-"};
    const Ended made = run(plus({"sample", two, "--points", points, "--save-map", map, "--outside", "nearest",
                                 "--weights", scratch.path("w.npz")},
                                nan));
    EXPECT_EQ(made.code, 0) << made.err;
    const Ended used = run(plus({"sample", two, "--map", map, "--outside", "nearest"}, nan));
    EXPECT_EQ(used.out, made.out) << used.err;
    EXPECT_TRUE(contains(used.err, "outside    4: 1 snapped")) << used.err;
    EXPECT_TRUE(contains(used.err, "3 not finite, got NaN")) << used.err;
    // The map holds them since they were let in.
    EXPECT_EQ(run({"sample", two, "--map", map, "--outside", "nearest", "--output", "-"}).out, made.out);
    for (const std::string step : {"1", "2"}) scratch.put("f" + step + ".txt", "1\n2\n3\n4\n5\n");
    EXPECT_EQ(run({"sample", two, "--points", points, "--field", "f@" + scratch.path("f*.txt"), "--fields", "f",
                   "--output", scratch.path("s{step}.csv"), "--nonfinite-points", "nan"})
                  .code,
              0);
    EXPECT_EQ(read_file(scratch.path("s1.csv")), read_file(scratch.path("s2.csv")));
    EXPECT_TRUE(contains(read_file(scratch.path("s2.csv")), "\nnan,0,0,-1,outside,nan\n"));
}

TEST(NonfinitePoints, OfEveryKindOfFile) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", strange_points);
    const Words nan{"--nonfinite-points", "nan", "--output", "-", "--fields", "point:attribute0", "--quiet"};
    for (const std::string suffix : {".npy", ".vtu"}) {
        const std::string file = scratch.path("again" + suffix);
        ASSERT_EQ(run({"sample", two, "--points", points, "--output", file, "--nonfinite-points", "nan"}).code, 0);
        const Ended r = run(plus({"sample", two, "--points", file}, nan));
        EXPECT_EQ(r.out, rows_with("nan")) << suffix << r.err;
        expect_error({"sample", two, "--points", file, "--output", "-"}, "--nonfinite-points nan");
    }
    const std::string node = scratch.put("q.node", "2 3 0 0\n0 nan 0 0\n1 .25 .25 .25\n");
    const Ended r = run(plus({"sample", two, "--points", node}, nan));
    expect_error({"sample", two, "--points", node, "--output", "-"}, "--nonfinite-points nan");
    EXPECT_EQ(r.out, "x,y,z,cell,feature,attribute0\nnan,0,0,-1,outside,nan\n0.25,0.25,0.25,0,interior,4.5\n") << r.err;
    // In the plane a third coordinate must be 0 where the others are finite.
    const std::string flat = scratch.put("f.csv", "x,y,z\nnan,nan,nan\n1,1,0\n"),
                      high = scratch.put("h.csv", "1,1,nan\n");
    EXPECT_EQ(
        run(plus({"sample", mesh("plate"), "--points", flat}, {"--nonfinite-points", "nan", "--output", "-"})).code, 0);
    EXPECT_EQ(run({"sample", mesh("plate"), "--points", high, "--columns", "1,2", "--output", "-"}).code, 0);
    expect_error({"sample", mesh("plate"), "--points", scratch.put("i.csv", "x,y,z\n1,1,nan\n"), "--output", "-",
                  "--nonfinite-points", "nan"},
                 "a point off the plane z = 0");
}

TEST(NonfinitePoints, VerifyTakesThemForOutside) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), good = scratch.put("good.csv", rows_with("nan"));
    expect_error({"verify", two, "--results", good}, "--nonfinite-points nan");
    const Words line{"verify", two, "--nonfinite-points", "nan", "--json", "-", "--results"};
    const Ended r = run(plus(line, {good}));
    EXPECT_EQ(r.code, 0) << r.err;
    const auto j = parse(r.out);
    EXPECT_EQ(j["right"], 6);
    EXPECT_EQ(j["outside"], 4);
    EXPECT_EQ(j["not_finite"], 3);
    // A value where there can be none is invented.
    const Ended bad = run(plus(line, {scratch.put("bad.csv", "x,y,z,attribute0\nnan,0,0,5\n.25,.25,.25,4.5\n")}));
    EXPECT_EQ(bad.code, 1) << bad.err;
    const auto k = parse(bad.out);
    EXPECT_EQ(k["invented"], 1);
    EXPECT_TRUE(k["examples"][0]["distance"].is_null());
    EXPECT_TRUE(contains(k["examples"][0]["command"], "--nonfinite-points nan"));
}

}  // namespace
}  // namespace barycert::cli_test

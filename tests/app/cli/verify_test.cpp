// barycert verify: results as tools write them, verdicts, exit codes, reports.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "process.hpp"
#include "sample_meshes.hpp"
#include "tests/mesh/curved_mesh.hpp"

namespace barycert::cli_test {
namespace {

nlohmann::json report_of(const Words& arguments, int code) {
    const Ended r = run(plus(arguments, {"--json", "-"}));
    EXPECT_EQ(r.code, code) << r.err;
    return parse(r.out);
}

TEST(Verify, WhatSampleWroteIsRight) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
    for (const std::string suffix : {".csv", ".npy", ".vtu"}) {
        const std::string rows = scratch.path("rows" + suffix);
        ASSERT_EQ(run({"sample", two, "--points", points, "--output", rows, "--quiet"}).code, 0);
        const auto j = report_of({"verify", two, "--results", rows, "--exact"}, 0);
        EXPECT_EQ(j["right"], 6) << suffix;
        EXPECT_EQ(j["rows"], 6) << suffix;
        EXPECT_EQ(j["inside"], 5) << suffix;
        EXPECT_EQ(j["values"].size(), 2U) << suffix;
        EXPECT_EQ(j["values"][0]["identical"], 5) << suffix;
    }
    const Ended piped =
        run_shell("barycert sample two --points p.csv --output - --quiet | barycert verify two --results -",
                  {.folder = scratch.folder()});
    EXPECT_EQ(piped.code, 0) << piped.err;
    EXPECT_TRUE(contains(piped.out, "-: all 6 rows are right\n")) << piped.out;
}

TEST(Verify, EachKindOfErrorIsNamed) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    const std::string bad = scratch.put("bad.csv",
                                        "x,y,z,cell,attribute0\n"
                                        ".25,.25,.25,0,4.5\n"
                                        ".5,.5,.5,-1,nan\n"         // missed
                                        ".25,.25,.5,1,6.5\n"        // right: the face belongs to both
                                        ".5,.5,0,1,4.0000001\n"     // wrong value
                                        ".1,.1,.1,1,2.4\n"          // wrong cell
                                        "2,2,2,1,0\n"               // invented
                                        ".25,.25,-1e-12,0,3.2\n");  // invented, nearly inside
    const auto j = report_of({"verify", two, "--results", bad}, 1);
    EXPECT_EQ(j["right"], 2);
    EXPECT_EQ(j["missed"], 1);
    EXPECT_EQ(j["invented"], 2);
    EXPECT_EQ(j["invented_zero"], 1);
    EXPECT_EQ(j["invented_near"], 1);
    EXPECT_NEAR(j["invented_distance"].get<double>(), std::sqrt(3), 1e-15);
    EXPECT_EQ(j["wrong_cell"], 1);
    EXPECT_EQ(j["wrong_value"], 1);
    EXPECT_EQ(j["examples"].size(), 5U);
    const Ended text = run({"verify", two, "--results", bad});
    EXPECT_EQ(text.code, 1);
    EXPECT_TRUE(contains(text.out, "bad.csv: WRONG: 5 of 7 rows\n")) << text.out;
    // The commands that it shows run.
    for (const auto& example : j["examples"]) {
        const Ended shown = run_shell(example["command"].get<std::string>());
        EXPECT_EQ(shown.code, 0) << shown.err;
        EXPECT_TRUE(contains(shown.out, "x,y,z,cell,feature")) << shown.out;
    }
    // Thresholds.
    EXPECT_EQ(run({"verify", two, "--results", bad, "--fail-on", "missed>1"}).code, 0);
    EXPECT_EQ(run({"verify", two, "--results", bad, "--fail-on", "missed>1,wrong_value"}).code, 1);
    EXPECT_EQ(run({"verify", two, "--results", bad, "--fail-on", "wrong_value", "--tolerance", "1e-6"}).code, 0);
    expect_error({"verify", two, "--results", bad, "--fail-on", "bad"}, "expected missed, invented");
    // Nothing is compared that the user takes out.
    EXPECT_EQ(report_of({"verify", two, "--results", bad, "--cell-column", "none"}, 1)["wrong_cell"], 0);
}

/// Two cells with a field that has no range.
std::string put_constant(const Scratch& scratch, const std::string& value) {
    std::string nodes = "5 3 1 0\n";
    for (const char* const point : {"0 0 0 0", "1 1 0 0", "2 0 1 0", "3 0 0 1", "4 1 1 1"})
        nodes += std::string(point) + ' ' + value + '\n';
    scratch.put("same.node", nodes);
    scratch.put("same.ele", "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n");
    return scratch.path("same");
}

TEST(Verify, AFieldWithoutRangeIsComparedWithItsMagnitudeOrWithOne) {
    const Scratch scratch;
    struct Case {
        std::string value, near, far, to, sentence;
        double range;
    };
    for (const Case& c :
         {Case{"-300", "-300.00000029", "-300.00000031", "magnitude",
               "attribute0 is constant, its range is 0: its errors are in parts of its magnitude, 300", 300},
          Case{"0", "9e-10", "-11e-10", "one", "attribute0 is 0 throughout: its errors are absolute", 1}}) {
        const std::string same = put_constant(scratch, c.value), head = "x,y,z,attribute0\n.1,.1,.1,";
        const std::string good = scratch.put("good.csv", head + c.near + '\n');
        const std::string bad = scratch.put("bad.csv", head + c.far + '\n');
        EXPECT_EQ(report_of({"verify", same, "--results", good}, 0)["right"], 1) << c.value;
        const auto j = report_of({"verify", same, "--results", bad, "--html", scratch.path("v.html")}, 1);
        EXPECT_EQ(j["wrong_value"], 1) << c.value;
        EXPECT_EQ(j["values"][0]["relative_to"], c.to);
        EXPECT_EQ(j["values"][0]["range"], c.range);
        EXPECT_TRUE(contains(run({"verify", same, "--results", bad}).out, c.sentence + '\n'));
        EXPECT_TRUE(contains(read_file(scratch.path("v.html")), c.sentence));
    }
    const std::string two = put_two_cells(scratch);
    const std::string rows = scratch.put("rows.csv", "x,y,z,attribute0\n.25,.25,.25,4.5\n");
    EXPECT_EQ(report_of({"verify", two, "--results", rows}, 0)["values"][0]["relative_to"], "range");
}

/// Rows of t = x on the ball of testing::straight_ball, of which every `good`-th is exact (0: none) and the others are
/// off by 2e-9 to `most` of the range, spread evenly over the decades.
std::string put_iterated(const Scratch& scratch, double most, int good = 0) {
    std::string rows = "x,y,z,t\n";
    for (int i = 0; i < 200; ++i) {
        const double x = 0.0012 * i, error = most * std::pow(2e-9 / most, i / 199.0);
        rows += fmt::format("{},0.1,0.2,{:.17g}\n", x, x + (good != 0 && i % good == 0 ? 0 : 2 * error));
    }
    return scratch.put("rows.csv", rows);
}

TEST(Verify, ErrorsOfTheSizeOfAnIterationAreSaidToBe) {
    const Scratch scratch;
    const auto ball = [&](const std::string& name, Mesh mesh) {
        mesh.point_fields.push_back({"t", 1, {}});
        for (std::size_t i = 0; i < mesh.points.size(); i += 3) mesh.point_fields[0].data.push_back(mesh.points[i]);
        EXPECT_TRUE(write_mesh(mesh, scratch.path(name)));
        return scratch.path(name);
    };
    const std::string sentence = "the errors are of the size of an iterative solver's tolerance: the largest is";
    const auto said = [&](const std::string& mesh, const std::string& rows) {
        const auto j = report_of({"verify", mesh, "--results", rows, "--html", scratch.path("v.html")}, 1);
        EXPECT_GT(j["wrong_value"], 0);
        std::size_t notes = 0;
        for (const auto& note : j["notes"]) notes += contains(note["text"], sentence) ? 1 : 0;
        EXPECT_EQ(contains(run({"verify", mesh, "--results", rows}).out, sentence), notes == 1);
        EXPECT_EQ(contains(read_file(scratch.path("v.html")), "the errors are of the size of an iterative"),
                  notes == 1);
        return notes == 1;
    };
    const Mesh straight = testing::straight_ball(3);
    const std::string mesh = ball("ball.vtu", straight);
    EXPECT_TRUE(said(mesh, put_iterated(scratch, 3e-5)));
    EXPECT_TRUE(said(mesh, put_iterated(scratch, 3e-7)));
    // The remedy that it names works.
    EXPECT_EQ(run({"verify", mesh, "--results", put_iterated(scratch, 3e-5), "--tolerance", "1e-4"}).code, 0);
    // Larger ones, few among exact ones, linear cells, curved ones.
    EXPECT_FALSE(said(mesh, put_iterated(scratch, 3e-4)));
    EXPECT_FALSE(said(mesh, put_iterated(scratch, 3e-5, 5)));
    Mesh linear = straight;
    linear.mid_nodes.clear();
    linear.mid_edge_order = MidEdgeOrder::none;
    EXPECT_FALSE(said(ball("linear.vtu", linear), put_iterated(scratch, 3e-5)));
    EXPECT_FALSE(said(ball("curved.vtu", testing::curved_ball(3)), put_iterated(scratch, 3e-5)));
}

TEST(Verify, ColumnsByOtherNamesAndZeroForOutside) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    const std::string rows = scratch.put("rows.csv", "lon,lat,depth,Temperature,id\n.25,.25,.25,4.5,1\n2,2,2,0,\n");
    expect_error({"verify", two, "--results", rows, "--columns", "lon,lat,depth"}, "no column to compare");
    const Words line{
        "verify", two, "--results", rows, "--columns", "lon,lat,depth", "--value", "attribute0=Temperature"};
    EXPECT_EQ(report_of(line, 1)["invented"], 1);
    EXPECT_EQ(report_of(plus(line, {"--outside-value", "0"}), 0)["right"], 2);
    EXPECT_EQ(report_of(plus(line, {"--cell-column", "id", "--cell-base", "1"}), 0)["right"], 2);
    expect_error(plus(line, {"--cell-column", "ID"}), "\"ID\"");
    expect_error({"verify", two, "--results", rows, "--columns", "lon,lat,depth", "--value", "T=Temperature"}, "\"T\"");
}

TEST(Verify, TheMaskOfVtkSaysWhatIsOutside) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    const std::string rows =
        scratch.put("rows.csv",
                    "\"attribute0\",\"vtkValidPointMask\",\"Points:0\",\"Points:1\",\"Points:2\"\n4.5,1,.25,.25,.25\n"
                    "0,0,2,2,2\n0,0,.5,.5,.5\n");
    const auto j = report_of({"verify", two, "--results", rows}, 1);
    EXPECT_EQ(j["mask_column"], "vtkValidPointMask");
    EXPECT_EQ(j["right"], 2);
    EXPECT_EQ(j["missed"], 1);
    // vtkDelimitedTextWriter writes the mask as bytes.
    const std::string bytes = scratch.put("bytes.csv", std::string("\"attribute0\",\"vtkValidPointMask\",\"Points:0\","
                                                                   "\"Points:1\",\"Points:2\"\n4.5,\1,.25,.25,.25\n"
                                                                   "0,") +
                                                           '\0' + ",2,2,2\n0," + '\0' + ",.5,.5,.5\n");
    const auto same = report_of({"verify", two, "--results", bytes}, 1);
    EXPECT_EQ(same["right"], 2);
    EXPECT_EQ(same["missed"], 1);
}

TEST(Verify, SixDigitsAreTold) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    const auto told = [&](const std::string& value) {
        const std::string rows =
            scratch.put("digits.csv", "x,y,z,attribute0\n.25,.25,.25,4.5\n.3,.2,.1," + value + "\n");
        return contains(run({"verify", two, "--results", rows}).err, "values have six digits");
    };
    EXPECT_TRUE(told("3.12346"));
    EXPECT_FALSE(told("3.123456")) << "more";
    EXPECT_FALSE(told("3.125")) << "they may be exact";
}

TEST(Verify, SinglePrecisionIsTold) {
    const Scratch scratch;
    scratch.put("one.node", "4 3 1 0\n0 0 0 0 0\n1 1 0 0 1\n2 0 1 0 0\n3 0 0 1 0\n");
    scratch.put("one.ele", "1 4 0\n0 0 1 2 3\n");
    // 0.1 and 0.3 as float32, in double.
    const std::string rows =
        scratch.put("rows.csv", "x,y,z,attribute0\n.1,.1,.1,0.10000000149011612\n.3,.1,.1,0.30000001192092896\n");
    const Ended r = run({"verify", scratch.path("one"), "--results", rows});
    EXPECT_EQ(r.code, 0) << r.out;
    EXPECT_TRUE(contains(r.err, "note: ")) << r.err;
    EXPECT_TRUE(contains(r.err, "single precision")) << r.err;
    EXPECT_EQ(run({"verify", scratch.path("one"), "--results", rows, "--tolerance", "1e-9", "--quiet"}).code, 1);
}

TEST(Verify, ThePageHoldsWhatTheJsonHolds) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    const std::string bad = scratch.put("<b>.csv", "x,y,z,attribute0\n.25,.25,.25,4.5\n.5,.5,.5,1\n");
    const std::string page = scratch.path("page.html");
    EXPECT_EQ(run({"verify", two, "--results", bad, "--html", page, "--quiet"}).code, 1);
    const std::string html = read_file(page);
    EXPECT_TRUE(contains(html, "WRONG: 1 of 2 rows"));
    EXPECT_TRUE(contains(html, "&lt;b&gt;.csv"));
    EXPECT_FALSE(contains(html, "<b>.csv"));
    EXPECT_FALSE(contains(html, "<script"));
    for (const char* alien : {"href", "src=", "url(", "@import"}) EXPECT_FALSE(contains(html, alien)) << alien;
}

TEST(Verify, HistogramsAreFilesBySuffix) {
    const Scratch scratch;
    const std::string mesh = BARYCERT_DATA_DIR "/meshes/bracket", results = scratch.path("r.csv");
    ASSERT_EQ(run_shell("printf '1,1,0.1,5\\n2,1,0.1,5\\n' > " + results).code, 0);
    const auto drawn = [&](const std::string& name, const std::string& more) {
        const std::string path = name == "-" ? name : scratch.path(name);
        const Ended r = run_shell("barycert " + more + " --quiet --plot " + path);
        EXPECT_EQ(r.err, "");
        return name == "-" ? r.out : read_file(path);
    };
    const std::string columns = " --columns 1,2,3 --value attribute0=column4 --fields attribute0";
    for (const std::string& command : {"check " + mesh, "verify " + mesh + " --results " + results + columns}) {
        EXPECT_TRUE(drawn("h.png", command).starts_with("\x89PNG")) << command;
        EXPECT_TRUE(drawn("h.pdf", command).starts_with("%PDF-")) << command;
        EXPECT_EQ(drawn("h.svg", command), drawn("-", command));
        EXPECT_TRUE(contains(drawn("-", command), "<svg")) << command;
        const Ended r = run_shell("barycert " + command + " --quiet --plot " + scratch.path("h.gif"));
        EXPECT_EQ(r.code, 2);
        EXPECT_TRUE(contains(r.err, ".png, .svg or .pdf")) << r.err;
    }
    EXPECT_TRUE(contains(drawn("-", "check " + mesh), "smallest dihedral angle"));
    const std::string errors = drawn("-", "verify " + mesh + " --results " + results + columns);
    EXPECT_TRUE(contains(errors, "error of attribute0, ulps, logarithmic")) << errors;
    EXPECT_TRUE(contains(errors, ": 1 row</title>") || contains(errors, ": 2 rows</title>")) << errors;
    EXPECT_TRUE(contains(errors, "<rect fill=\"#c8102e\"")) << "a wrong value: " << errors;
    const std::string surface = scratch.path("s.off");
    ASSERT_EQ(run_shell("printf 'OFF\\n3 1 0\\n0 0 0\\n1 0 0\\n0 1 0\\n3 0 1 2\\n' > " + surface).code, 0);
    const Ended r = run_shell("barycert check " + surface + " --quiet --plot " + scratch.path("h.svg"));
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, "--plot is for meshes")) << r.err;
}

TEST(Verify, BadInput) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    expect_error({"verify", two}, "--results is required");
    expect_error({"verify", two, "--results", scratch.path("none.csv")}, "none.csv");
    expect_error({"verify", two, "--results", scratch.put("a.csv", "x,y,z,attribute0\n0,0,0,many\n")}, "\"many\"");
    expect_error({"verify", two, "--results", scratch.put("b.csv", "x,y,z,cell\n0,0,0,1.5\n")}, "an integer");
    expect_error({"verify", two, "--results", scratch.put("c.csv", "x,y,z,attribute0\n0,0,inf,1\n")}, "finite");
    const std::string rows = scratch.put("d.csv", "x,y,z,attribute0\n0,0,0,1\n");
    expect_error({"verify", two, "--results", rows, "--json", rows}, "d.csv");
    EXPECT_EQ(read_file(rows), "x,y,z,attribute0\n0,0,0,1\n");
}

}  // namespace
}  // namespace barycert::cli_test

// Exit codes, and what is said where: results on stdout, all else on stderr, an error with its remedy and nothing else.

#include <filesystem>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

struct Refusal {
    Words arguments;
    std::string says;  ///< part of what stderr must say
};

void expect_refused(const Refusal& refusal, const How& how = {}) {
    const Ended r = run(refusal.arguments, how);
    const std::string line = ::testing::PrintToString(refusal.arguments);
    EXPECT_EQ(r.code, 2) << line << r.err;
    EXPECT_EQ(r.out, "") << line;
    EXPECT_TRUE(contains(r.err, refusal.says)) << line << " says " << r.err;
}

TEST(Usage, HelpAndVersionAreNoErrors) {
    for (const Words& arguments : std::vector<Words>{{"--help"},
                                                     {"audit", "--help"},
                                                     {"replay", "--help"},
                                                     {"kernels", "--help"},
                                                     {"families", "--help"},
                                                     {"--version"}}) {
        const Ended r = run(arguments);
        EXPECT_EQ(r.code, 0) << ::testing::PrintToString(arguments);
        EXPECT_EQ(r.err, "");
        EXPECT_NE(r.out, "");
    }
    EXPECT_TRUE(contains(run({"--help"}).out, "Exit codes: 0"));
    EXPECT_EQ(run({"--version"}).out.rfind("barycert ", 0), 0U);
}

TEST(Usage, WhatIsNotUnderstoodIsRefused) {
    // Were any of these taken for something else, the audit would run and print a table.
    const std::vector<Refusal> refusals{
        {{}, "subcommand is required"},
        {{"nonsense"}, "no such subcommand: found \"nonsense\"; `barycert --help` lists them"},
        {{"audit", "--nonsense"}, "--nonsense"},
        {{"audit", "--count", "0"}, "--count"},
        {{"audit", "--count", "-5"}, "--count"},
        {{"audit", "--count", "1e3"}, "--count"},
        {{"audit", "--count", "12x"}, "--count"},
        {{"audit", "--count", ""}, "--count"},
        {{"audit", "--count", "999999999999999999999"}, "--count"},
        {{"audit", "--count"}, "--count"},
        {{"audit", "--seed", "-1"}, "--seed"},
        {{"audit", "--seed", "1.5"}, "--seed"},
        {{"audit", "--seed", "99999999999999999999999"}, "--seed"},
        {{"audit", "--threads", "-1"}, "--threads"},
        {{"audit", "--threads", "many"}, "--threads"},
        {{"audit", "--kernel", "zzz"}, "no kernel of that name: found \"zzz\"; `barycert kernels` lists them"},
        {{"audit", "--kernel", "tetrahedron.*", "--kernel", "zzz"}, "found \"zzz\""},
        {{"audit", "--family", "zzz"}, "no family of that name: found \"zzz\"; `barycert families` lists them"},
        {{"audit", "--fail-on", "zzz"}, "unknown rule: expected NAME or NAME>NUMBER"},
        {{"audit", "--fail-on", "any>many"}, "bad limit in a rule"},
        {{"audit", "--fail-on", "any>-1"}, "bad limit in a rule"},
        {{"audit", "--fail-on", "any>nan"}, "bad limit in a rule"},
        {{"audit", "--fail-on", "any>"}, "bad limit in a rule"},
        {{"kernels", "zzz"}, "found \"zzz\""},
        {{"families", "zzz"}, "found \"zzz\""},
        {{"replay"}, "no case to replay: expected either a witness file, or --family and --case"},
        {{"replay", "w.json", "--family", "huge", "--case", "1"}, "either a witness file, or --family and --case"},
        {{"replay", "--family", "huge"}, "--family needs --case"},
        {{"replay", "--family", "hu*", "--case", "1"}, "--family must name one family"},
        {{"replay", "--family", "huge", "--case", "-1"}, "--case"},
        {{"replay", "--family", "mesh.inside", "--case", "1"}, "add --simplex NAME or --kernel NAME"},
        {{"replay", "--family", "mesh.inside", "--case", "1", "--simplex", "pentagon"}, "unknown simplex"},
        {{"replay", "--family", "mesh.inside", "--case", "1", "--kernel", "zzz"}, "no kernel of that name"},
        {{"replay", "--family", "perspective.ordinary", "--case", "1", "--kernel", "triangle.signed-area"},
         "no kernel of that name for the cases of that family"},
        {{"replay", "--family", "random", "--case", "1", "--kernel", "triangle.perspective-affine"},
         "no kernel of that name for the cases of that family"},
        {{"audit", "--kernel", "triangle.perspective-affine", "--family", "random"}, "nothing to audit"},
        {{"replay", "--family", "mesh.inside", "--case", "1", "--simplex", "tetrahedron", "--kernel",
          "tetrahedron.crame"},
         "did you mean \"tetrahedron.cramer\"?"},
        {{"replay", "w.json", "--seed", "3"}, "--seed is for a case that is generated"},
        {{"replay", "w.json", "--simplex", "triangle"}, "--simplex is for a case that is generated"},
        {{"audit", "--class-tolerance", "nan"}, "expected a finite number of at least 0, found \"nan\""},
        {{"audit", "--class-tolerance", "-1"}, "expected a finite number of at least 0, found \"-1\""},
        {{"audit", "--time-limit", "nan"}, "--time-limit"},
        {{"gaps", "m", "--class-tolerance", "inf"}, "--class-tolerance"},
        {{"search", "tetrahedron.cramer", "--seconds", "nan"}, "expected a finite number above 0"},
        {{"search", "tetrahedron.cramer", "--seconds", "0"}, "expected a finite number above 0"},
        {{"verify", "m", "--results", "r.csv", "--tolerance", "nan"}, "--tolerance"},
        {{"check", "m", "--vtu", "m.png"}, "expected a name that ends in .vtu"},
        {{"render", "slice", "m", "--plane", "0,0,1,0", "--width", "9", "--output", "s.vtp"},
         "--width is for pictures"},
        {{"render", "iso", "m", "--field", "T", "--value", "0", "--camera", "9,1", "--output", "s.ply"},
         "--camera is for pictures"},
        {{"render", "iso", "--segment", "0:1", "--values", "0,1", "--value", "0.5", "--json", "j"},
         "--segment cannot be combined with --json"},
        {{"mesh", "p.poly", "--output", ""}, "--output: expected the stem of files"},
        {{"mesh", "p.poly", "--output", "-"}, "--output: expected the stem of files"},
        {{"render"}, "nothing to draw"},
        {{"render", "scene.json"}, "--output is required"},
        {{"render", "gradient"}, "--output is required"},
        {{"render", "nonsense"}, "nonsense"},
        {{"render", "drift", "--count", "0"}, "--count"},
        {{"render", "drift", "--kernel", "zzz"}, "no kernel of that name"},
        {{"render", "drift", "--kernel", "tetrahedron.cramer"}, "the kernel is not for triangles without perspective"},
        {{"render", "drift", "--output", "drift.png"}, "expected a name that ends in .svg, found \"drift.png\""},
        {{"render", "texels", "--count", "0"}, "--count"},
    };
    for (const Refusal& refusal : refusals) expect_refused(refusal);
}

TEST(Usage, OfAMistypedNameTheNearestIsTold) {
    const Scratch scratch;
    const std::string points = scratch.put("points.csv", "x,y,z\n0.1,0.2,0.3\n"), bracket = mesh("bracket");
    const std::string rows = scratch.put("rows.csv", "x,y,z,cel\n0.1,0.2,0.3,0\n");
    const std::string witnesses = scratch.path("witnesses.json");
    ASSERT_EQ(
        run({"audit", "--count", "20", "--kernel", "tetrahedron.cramer", "--witnesses", witnesses, "--quiet"}).code, 0);
    const std::vector<Refusal> refusals{
        {{"smaple"}, "found \"smaple\"; did you mean \"sample\"? `barycert --help` lists them"},
        {{"help", "smaple"}, "did you mean \"sample\"?"},
        {{"help", "render", "isso"}, "did you mean \"iso\"?"},
        {{"render", "isso"}, "did you mean \"iso\"?"},
        {{"render", "slcie", bracket, "--plane", "0,0,1,0"}, "did you mean \"slice\"?"},
        {{"render", "mseh", bracket, "--output", "x.png"}, "did you mean \"mesh\"?"},
        {{"sample", bracket, "--ponts", points}, "not expected: --ponts " + points + "; did you mean \"--points\"?"},
        {{"sample", bracket, "--points=" + points, "--ouput=-"}, "did you mean \"--output\"?"},
        // Another error is found first.
        {{"render", "slice", bracket, "--palne=0,0,1,0"}, "\"--palne\" is no option, did you mean \"--plane\"?"},
        {{"render", "gradient", "--ouput", "x.png"}, "did you mean \"--output\"?"},
        {{"audit", "--oracle", "cgla"},
         "--oracle: expected integers, cgal or both, found \"cgla\"; did you mean \"cgal\"?\n"},
        {{"audit", "--kernel", "triangle.signed-aera"},
         "did you mean \"triangle.signed-area\"? `barycert kernels` lists"},
        {{"audit", "--kernel", "cramer"}, "did you mean \"tetrahedron.cramer\"?"},
        {{"audit", "--family", "randon"}, "did you mean \"random\"? `barycert families` lists"},
        {{"audit", "--fail-on", "false_zeor>3"}, "did you mean \"false_zero\"?"},
        {{"kernels", "triangle.invers"}, "did you mean \"triangle.inverse\"?"},
        {{"search", "triangle.invers"}, "did you mean \"triangle.inverse\"?"},
        {{"replay", "--family", "randon", "--case", "1"}, "did you mean \"random\"?"},
        {{"replay", witnesses, "--kernel", "tetrahedron.cramr"}, "did you mean \"tetrahedron.cramer\"? leave out"},
        {{"replay", witnesses, "--kernel", "*", "--reason", "fals_inside"}, "did you mean \"false_inside\"? leave out"},
        {{"replay", witnesses, "--reason", "z*"}, "no witness matches; leave out"},
        {{"replay", "--family", "mesh.inside", "--case", "1", "--simplex", "tetraedron"},
         "did you mean \"tetrahedron\"?"},
        {{"gaps", bracket, "--rule", "stric"}, "did you mean \"strict\"?"},
        {{"gaps", bracket, "--fail-on", "gpas"}, "did you mean \"gaps\"?"},
        {{"verify", bracket, "--results", rows, "--fail-on", "misssed"}, "did you mean \"missed\"?"},
        {{"verify", bracket, "--results", rows, "--cell-column", "cell"}, "did you mean \"cel\"?"},
        {{"sample", bracket, "--points", points, "--outside", "neerest", "--output", "-"}, "did you mean \"nearest\"?"},
        {{"sample", bracket, "--points", points, "--vtk-data", "zlip", "--output", "-"}, "did you mean \"zlib\"?"},
        {{"sample", bracket, "--points", points, "--fields", "atribute0", "--output", "-"},
         "did you mean \"attribute0\"? there are attribute0"},
        {{"sample", bracket, "--points", rows, "--keep", "cell2", "--output", "-"}, "no such column"},
        {{"sample", bracket, "--points", rows, "--keep", "sel", "--output", "-"}, "did you mean \"cel\"?"},
        {{"render", "mesh", bracket, "--field", "attribte0", "--output", scratch.path("x.png")},
         "did you mean \"attribute0\"?"},
    };
    for (const Refusal& refusal : refusals) expect_refused(refusal);
    // Nothing is guessed for what is near nothing.
    EXPECT_FALSE(contains(run({"zzzzzz"}).err, "did you mean"));
    EXPECT_FALSE(contains(run({"audit", "--zzzzzz"}).err, "did you mean"));
#ifdef BARYCERT_TETGEN_PROGRAM
    expect_refused({{"--qualty", "2", "x.poly"}, "did you mean \"--quality\"?"}, {.program = BARYCERT_TETGEN_PROGRAM});
    expect_refused({{"x.poly", "--order", "3"}, "--order: expected 1 or 2, found \"3\""},
                   {.program = BARYCERT_TETGEN_PROGRAM});
#endif
}

TEST(Usage, AnOptionWithTwoValuesSaysSo) {
    const std::string m = mesh("plate");
    const std::vector<Refusal> refusals{
        {{"sample", m, "--points", "a.csv", "--points", "b.csv", "--output", "-"},
         "error: --points is given 2 times: give it once; "},
        {{"audit", "--threads", "3", "--count", "9", "--threads", "4"}, "error: --threads is given 2 times"},
        {{"render", "gradient", "--output", "a.png", "--output", "b.png"}, "error: --output is given 2 times"},
        {{"sample", m, "--points", "a.csv", "b.csv", "--output", "-"},
         "error: not expected: b.csv; --points takes one value; "},
        {{"check", m, "--json", "a.json", "b.json"}, "not expected: b.json; --json takes one value"},
        {{"check", m, "b"}, "error: not expected: b; `barycert"},
        {{"check", "--delaunay", m, "b"}, "error: not expected: b; `barycert"},
    };
    for (const Refusal& refusal : refusals) expect_refused(refusal);
}

// Where a file is meant, an empty name, of a variable that is not set perhaps, is no leave to go without.
TEST(Usage, AnEmptyNameOfAFileIsRefused) {
    const std::string m = mesh("plate");
    for (const Words& arguments : std::vector<Words>{{"audit", ""},
                                                     {"audit", "--json", ""},
                                                     {"audit", "--witnesses", ""},
                                                     {"audit", "--plot", ""},
                                                     {"render", "drift", "--output", ""},
                                                     {"render", "texels", "--json", ""},
                                                     {"audit", "--kernel-library", ""},
                                                     {"check", ""},
                                                     {"check", m, "--json", ""},
                                                     {"check", m, "--html", ""},
                                                     {"check", m, "--vtu", ""},
                                                     {"check", m, "--conforms-to", ""},
                                                     {"check", m, "--fix-orientation", ""},
                                                     {"sample", "", "--points", "p.csv", "--output", "-"},
                                                     {"sample", m, "--points", "", "--output", "-"},
                                                     {"sample", m, "--points", "p.csv", "--output", ""},
                                                     {"sample", m, "--points", "p.csv", "--output", "-", "--json", ""},
                                                     {"sample", m, "--map", "", "--output", "-"},
                                                     {"resample", m, "--onto", "", "--output", "-"},
                                                     {"kernels", "--json", ""},
                                                     {"kernels", "--kernel-library", ""},
                                                     {"families", "--json", ""},
                                                     {"replay", ""},
                                                     {"replay", "--family", "huge", "--case", "1", "--mesh", ""}})
        expect_refused({arguments, "expected the name of a file, found \"\""});
}

TEST(Usage, HelpThatCannotBePrintedIsAnError) {
    for (const Words& arguments :
         std::vector<Words>{{"--help"}, {"--version"}, {"audit", "--help"}, {"sample", "--help"}}) {
        for (const How& how : {How{.stdout_path = "/dev/full"}, How{.close_stdout = true}}) {
            const Ended r = run(arguments, how);
            EXPECT_EQ(r.code, 2) << ::testing::PrintToString(arguments);
            EXPECT_TRUE(contains(r.err, "error: cannot write to stdout")) << r.err;
        }
    }
#ifdef BARYCERT_TETGEN_PROGRAM
    const Ended mesher = run({"--help"}, {.stdout_path = "/dev/full", .program = BARYCERT_TETGEN_PROGRAM});
    EXPECT_EQ(mesher.code, 2);
    EXPECT_TRUE(contains(mesher.err, "error: cannot write to stdout")) << mesher.err;
#endif
}

TEST(Usage, FamiliesThatDoNotApplyAreNoAudit) {
    expect_refused({{"audit", "--kernel", "segment.projection", "--family", "mesh.faces"}, "nothing to audit"});
    // A mesh of the user's in 3D supplies no plane triangle.
    expect_refused({{"audit", mesh("bracket"), "--kernel", "triangle.inverse", "--family", "mesh.inside"},
                    "mesh families of triangles need a 2D mesh"});
}

TEST(Usage, ABrokenMeshIsToldWithFileAndLine) {
    const Scratch scratch;
    const std::string node = scratch.put("bad.node", "3 2 0 0\n0 0 0\n1 one 0\n2 0 1\n");
    scratch.put("bad.ele", "1 3 0\n0 0 1 2\n");
    expect_refused({{"audit", node}, "error: " + node + ":3: "});
    expect_refused({{"replay", "--family", "mesh.inside", "--case", "1", "--simplex", "triangle", "--mesh", node},
                    "error: " + node + ":3: "});
    expect_refused({{"audit", scratch.path("none.node")}, "error: " + scratch.path("none.node") + ": "});
    expect_refused({{"audit", mesh("bracket"), node}, "error: " + node + ":3: "});
}

TEST(Usage, MissingDataAreToldWithTheRemedy) {
    expect_refused({{"audit"}, "found No such file or directory; name a mesh, or set BARYCERT_DATA_DIR"},
                   {.environment = {"BARYCERT_DATA_DIR=/none"}});
}

TEST(Usage, MeshWithoutItsProgramIsToldWithTheRemedy) {
    const Scratch scratch;
    std::filesystem::copy_file(BARYCERT_PROGRAM, scratch.path("barycert"));
    const How alone{.environment = {"PATH=" + scratch.folder()}, .program = scratch.path("barycert")};
    expect_refused(
        {{"mesh", "shape.poly"}, "error: cannot run barycert-tetgen: found No such file or directory; install"}, alone);
    // With a program of that name beside it, that one runs, with the same arguments.
    const std::string beside = scratch.put("barycert-tetgen", "#!/bin/sh\necho \"meshes $*\"\nexit 7\n");
    std::filesystem::permissions(beside, std::filesystem::perms::owner_all);
    const Ended r = run({"mesh", "a b.poly", "-q"}, alone);
    EXPECT_EQ(r.code, 7);
    EXPECT_EQ(r.out, "meshes a b.poly -q\n");
}

TEST(Usage, ListsAgreeAsTextAndAsJson) {
    const auto names_in_text = [](const std::string& text) {
        Words names;
        for (const std::string& line : lines_of(text)) {
            if (!line.empty() && line.front() != ' ') names.push_back(line);
        }
        return names;
    };
    for (const std::string what : {"kernels", "families"}) {
        const Ended text = run({what});
        const Ended json = run({what, "--json", "-"});
        EXPECT_EQ(text.code, 0);
        EXPECT_EQ(json.code, 0);
        EXPECT_EQ(text.err + json.err, "");
        Words names;
        const auto list = parse(json.out);
        for (const auto& entry : list[what]) names.push_back(entry["name"]);
        EXPECT_GT(names.size(), 10U);
        EXPECT_EQ(names_in_text(text.out), names);
        const Scratch scratch;
        EXPECT_EQ(run({what, "--json", scratch.path("list.json")}).out, text.out);
        EXPECT_EQ(read_file(scratch.path("list.json")), json.out);
    }
    EXPECT_EQ(names_in_text(run({"kernels", "segment.*", "triangle.inverse"}).out).back(), "triangle.inverse");
    EXPECT_EQ(names_in_text(run({"families", "mesh.faces"}).out), Words{"mesh.faces"});
}

}  // namespace
}  // namespace barycert::cli_test

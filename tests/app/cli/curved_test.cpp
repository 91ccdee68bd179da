// Curved second-order cells: every command that reads a mesh says first how it took their sides.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

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

const std::string told = "8 cells are curved: mid-edge nodes lie up to 0.21 of the edge off its middle";

/// With x as a field of nodes and the number of a cell as one of cells; returns its path.
std::string put_ball(const Scratch& scratch, const std::string& name, Mesh mesh) {
    mesh.point_fields.push_back({"t", 1, {}});
    for (std::size_t i = 0; i < mesh.points.size(); i += 3) mesh.point_fields[0].data.push_back(mesh.points[i]);
    mesh.cell_fields.push_back({"c", 1, std::vector<double>(mesh.cell_count(), 1)});
    const std::string path = scratch.path(name);
    EXPECT_TRUE(write_mesh(mesh, path));
    return path;
}

std::string put_curved(const Scratch& scratch) {
    return put_ball(scratch, "ball.vtu", testing::curved_ball(3));
}

/// A kind of command on a mesh: all take --curved and say the same.
std::vector<Words> commands(const Scratch& scratch, const std::string& mesh) {
    const std::string points = scratch.put("p.csv", "x,y,z\n.25,.25,.25\n.5,.5,0\n");
    scratch.put("rows.csv", "x,y,z,t\n.25,.25,.25,.25\n.5,.5,0,.5\n");
    return {{"check", mesh},
            {"sample", mesh, "--points", points, "--output", scratch.path("out.csv")},
            {"resample", mesh, "--grid", "3x3x3", "--output", scratch.path("out.vti")},
            {"resample", mesh, "--onto", mesh, "--output", scratch.path("onto.vtu")},
            {"verify", mesh, "--results", scratch.path("rows.csv")},
            {"render", "mesh", mesh, "--output", scratch.path("mesh.png")},
            {"render", "slice", mesh, "--plane", "0,0,1,0.25", "--output", scratch.path("slice.vtp")},
            {"render", "slice", mesh, "--plane", "0,0,1,0.25", "--field", "t", "--output", scratch.path("slice.png")},
            {"render", "iso", mesh, "--field", "t", "--value", "0.25", "--output", scratch.path("iso.vtp")},
            {"gaps", mesh, "--kernel", "tetrahedron.signed-volume", "--count", "10"}};
}

/// All others take their sides as straight.
bool takes_curves(const Words& command) {
    return command[0] == "sample" || command[0] == "resample" || command[0] == "verify";
}

TEST(Curved, EveryCommandSaysSoFirst) {
    const Scratch scratch;
    const std::string mesh = put_curved(scratch);
    std::vector<Words> all = commands(scratch, mesh);
    const Words audit{"audit", mesh, "--family", "mesh.*", "--count", "10"};
    for (const Words& more :
         {Words{}, Words{"--wide"}, Words{"--kernel", "tetrahedron.signed-volume"}, Words{"--kernel", "tetrahedron.*"}})
        all.push_back(plus(audit, more));
    for (const Words& command : all) {
        for (const bool straight : {false, true}) {
            const bool mapped = !straight && takes_curves(command);
            const Ended ended = run(straight ? plus(command, {"--curved", "straight"}) : command);
            EXPECT_NE(ended.code, 2) << ended.err;
            const std::string said = ended.out.substr(0, ended.out.find(mapped ? "as they are" : "as straight"));
            EXPECT_TRUE(contains(said, told)) << ended.out;
            EXPECT_LT(said.size(), 200U) << ended.out;  // nothing stands before it
            EXPECT_TRUE(mapped || !contains(ended.out, "exact, rounded once")) << ended.out;
            EXPECT_TRUE(mapped || !contains(ended.out, "certified:")) << ended.out;
        }
    }
}

TEST(Curved, JsonHasTheFigures) {
    const Scratch scratch;
    for (const Words& command : commands(scratch, put_curved(scratch))) {
        const std::string json = scratch.path("report.json");
        EXPECT_NE(run(plus(command, {"--json", json, "--quiet"})).code, 2) << command[0];
        const auto j = parse(read_file(json));
        EXPECT_EQ(j["curved"]["cells"], 8) << command[0];
        EXPECT_NEAR(j["curved"]["max_deviation"].get<double>(), testing::deviation_of_ball, 1e-15);
        EXPECT_EQ(j["curved"]["rounded_cells"], 0);
        EXPECT_EQ(j.contains("onto_curved"), command[0] == "resample" && command[2] == "--onto");
        if (j.contains("onto_curved")) {
            EXPECT_EQ(j["onto_curved"]["max_deviation"], j["curved"]["max_deviation"]);
            EXPECT_EQ(j["onto_curved"]["mapped"], false);  // its nodes are all that is asked for
        }
        EXPECT_EQ(j["curved"]["mapped"], takes_curves(command)) << command[0];
    }
}

TEST(Curved, RefusedIfAskedFor) {
    const Scratch scratch;
    const std::string mesh = put_curved(scratch);
    for (const Words& command : commands(scratch, mesh)) {
        for (const std::string file :
             {"out.csv", "out.vti", "onto.vtu", "mesh.png", "slice.vtp", "slice.png", "iso.vtp"})
            std::filesystem::remove(scratch.path(file));
        const Ended ended = run(plus(command, {"--curved", "refuse"}));
        EXPECT_EQ(ended.code, 2) << command[0];
        EXPECT_EQ(ended.out, "");
        for (const std::string& part : {std::string("ball.vtu"), std::string("the mesh is curved"), told,
                                        std::string("let them be taken as straight")})
            EXPECT_TRUE(contains(ended.err, part)) << ended.err;
        // Nothing was written, and the remedy works.
        for (const std::string file :
             {"out.csv", "out.vti", "onto.vtu", "mesh.png", "slice.vtp", "slice.png", "iso.vtp"})
            EXPECT_FALSE(std::filesystem::exists(scratch.path(file))) << file;
        EXPECT_NE(run(plus(command, {"--curved", "straight", "--quiet"})).code, 2);
    }
    const std::string straight = put_ball(scratch, "straight.vtu", testing::straight_ball(3));
    for (const Words& command : commands(scratch, straight)) {
        const Ended ended = run(plus(command, {"--curved", "refuse"}));
        EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
        EXPECT_FALSE(contains(ended.out, "as straight")) << ended.out;
    }
    // The target of --onto is a mesh that is read, too.
    expect_error({"resample", straight, "--onto", mesh, "--output", scratch.path("o.vtu"), "--curved", "refuse"},
                 "ball.vtu");
}

TEST(Curved, AuditNamesEachMesh) {
    const Scratch scratch;
    const std::string mesh = put_curved(scratch), json = scratch.path("audit.json");
    const Words audit{"audit", mesh, "--kernel", "tetrahedron.signed-volume", "--family", "mesh.*", "--count", "10"};
    const Ended ended = run(plus(audit, {"--json", json}));
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(contains(ended.out, "ball.vtu: " + told)) << ended.out;
    EXPECT_EQ(parse(read_file(json))["curved"][0]["cells"], 8);
    expect_error(plus(audit, {"--curved", "refuse"}), "the mesh is curved");
}

TEST(Curved, ValuesAreThoseOfStraightSidesAndSaidToBe) {
    const Scratch scratch;
    const std::string mesh = put_curved(scratch);
    const std::string points = scratch.put("outer.csv", "x,y,z\n0.7,0.7,0\n.5,.5,0\n");
    const Words sample{"sample", mesh, "--points", points, "--output", scratch.path("out.csv")};
    const Words straight = plus(sample, {"--curved", "straight"});
    const Ended whole = run(sample);
    EXPECT_TRUE(contains(whole.out, "values     exact, rounded once")) << whole.out;
    EXPECT_FALSE(contains(read_file(scratch.path("out.csv")), "outside"));
    const Ended ended = run(straight);
    EXPECT_TRUE(contains(ended.out, "values     exact for straight sides, rounded once")) << ended.out;
    EXPECT_TRUE(contains(read_file(scratch.path("out.csv")), "0.7,0.7,0,-1,outside")) << "inside the curved cell";
    const Ended walked = run(plus(straight, {"--outside", "nearest"}));
    EXPECT_TRUE(contains(walked.out, "walk: the mesh is certified for straight sides\n")) << walked.out;
    const Ended check = run({"check", mesh});
    EXPECT_EQ(check.code, 0);
    EXPECT_TRUE(contains(check.out, "certified for straight sides: 8 cells partition")) << check.out;
    EXPECT_TRUE(contains(check.out, "any two straight cells meet in a common face")) << check.out;
    for (const std::string& line : lines_of(check.out)) {
        EXPECT_LE(line.size(), contains(line, mesh) ? 100 + mesh.size() : 100U) << line;
    }
}

TEST(Curved, PicturesOfSlicesAreOfStraightSides) {
    const Scratch scratch;
    const Words slice{"render", "slice", put_curved(scratch), "--plane", "0,0,1,0.25", "--field", "t", "--output"};
    for (const std::string how : {"isoparametric", "straight"})
        EXPECT_EQ(run(plus(slice, {scratch.path(how + ".png"), "--curved", how})).code, 0);
    EXPECT_EQ(read_file(scratch.path("isoparametric.png")), read_file(scratch.path("straight.png")));
}

TEST(Curved, MapsAreOfOneKindOfSides) {
    const Scratch scratch;
    const std::string mesh = put_curved(scratch), map = scratch.path("m.map");
    const std::string points = scratch.put("outer.csv", "x,y,z\n0.7,0.7,0\n.5,.5,0\n");
    const Words sample{"sample", mesh, "--output", "-", "--quiet"};
    const Ended rows = run(plus(sample, {"--points", points, "--save-map", map}));
    EXPECT_EQ(run(plus(sample, {"--map", map})).out, rows.out);
    expect_error(plus(sample, {"--map", map, "--curved", "straight"}), "the map was made of cells taken otherwise");
}

TEST(Curved, PagesSaySoBeforeTheVerdict) {
    const Scratch scratch;
    const std::string mesh = put_curved(scratch), page = scratch.path("page.html");
    scratch.put("rows.csv", "x,y,z,t\n.25,.25,.25,.25\n");
    for (const Words& command : {Words{"check", mesh}, Words{"verify", mesh, "--results", scratch.path("rows.csv")},
                                 Words{"audit", mesh, "--family", "mesh.*", "--count", "10"}}) {
        run(plus(command, {"--html", page, "--quiet"}));
        const std::string text = read_file(page);
        const std::size_t at = text.find("8 cells are curved");
        ASSERT_NE(at, std::string::npos) << command[0];
        EXPECT_LT(at, std::min(text.find("class=\"verdict good\""), text.find("class=\"verdict bad\""))) << command[0];
        if (command[0] == "check") {
            EXPECT_TRUE(contains(text, ": certified for straight sides</title>"));
        }
    }
    // Where no table says so, stderr does.
    for (const std::string option : {"--html", "--json"})
        EXPECT_TRUE(contains(run({"check", mesh, option, "-"}).err, "note: " + told));
    EXPECT_EQ(run({"check", mesh, "--quiet"}).err, "");
}

// Two curved cells whose straight sides overlap: the corner of one stands in the other by less than their sides bulge.
TEST(Curved, ADefectNamesStraightenedSidesAsItsCause) {
    const Scratch scratch;
    Mesh mesh = testing::curved_ball(3);
    // A cell of its own, its vertex just within a face of the octahedron, under the bulge of other sides.
    Mesh other;
    other.points = {0.33, 0.33, 0.33, 2, 0.5, 0.5, 0.5, 2, 0.5, 0.5, 0.5, 2};
    other.cells = {0, 1, 2, 3};
    other = testing::second_order(std::move(other));
    const auto first = static_cast<Mesh::Index>(mesh.point_count());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const Mesh::Index node : other.cells) mesh.cells.push_back(first + node);
    for (const Mesh::Index node : other.mid_nodes) mesh.mid_nodes.push_back(first + node);
    const std::string path = put_ball(scratch, "two.vtu", std::move(mesh)), json = scratch.path("two.json");
    const Ended check = run({"check", path, "--json", json, "--html", scratch.path("two.html")});
    EXPECT_EQ(check.code, 1);
    const std::string cause = "1 cell of these is curved: sides of curved cells were taken as straight";
    EXPECT_TRUE(contains(check.out, cause)) << check.out;
    EXPECT_TRUE(contains(read_file(scratch.path("two.html")), cause));
    bool found = false;
    const auto report = parse(read_file(json));
    for (const auto& finding : report["findings"]) {
        if (!finding["breaks"]) {
            EXPECT_EQ(finding["curved_cells"], 0);
        }
        if (finding["name"] != "overlapping_cells") continue;
        found = true;
        EXPECT_EQ(finding["curved_cells"], 1);
    }
    EXPECT_TRUE(found) << check.out;
}

// Gmsh's curved cells are found; its straight ones are off by digits alone.
TEST(Curved, MeshesOfGmsh) {
    const Scratch scratch;
    if (run_shell("command -v gmsh", {.folder = scratch.folder()}).code != 0) GTEST_SKIP() << "no gmsh here";
    scratch.put("sphere.geo", "SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 1};\nMesh.MeshSizeMax = 0.5;\n");
    const auto made = [&](const std::string& name, const std::string& options) {
        const Ended ended =
            run_shell("gmsh -3 sphere.geo " + options + " -v 1 -o " + name, {.folder = scratch.folder()});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return scratch.path(name);
    };
    const auto curved = [&](const std::string& mesh) {
        return parse(run({"check", mesh, "--json", "-", "--quiet"}).out)["curved"];
    };
    for (const std::string format : {"msh22", "msh41"}) {
        for (const std::string binary : {"0", "1"}) {
            const std::string options = "-order 2 -format " + format + " -setnumber Mesh.Binary " + binary;
            const auto sphere = curved(made("sphere-" + format + binary + ".msh", options));
            EXPECT_GT(sphere["cells"], 100);
            EXPECT_NEAR(sphere["max_deviation"].get<double>(), 0.06, 0.02);
            const auto straight =
                curved(made("straight-" + format + binary + ".msh", options + " -setnumber Mesh.SecondOrderLinear 1"));
            // Corners and middles are written with 16 digits each.
            EXPECT_LT(straight["max_deviation"].get<double>(), 1e-14);
            EXPECT_LT(straight["max_rounded"].get<double>(), 1e-14);
        }
    }
}

}  // namespace
}  // namespace barycert::cli_test

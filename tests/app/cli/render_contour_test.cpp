// barycert render iso and render slice.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

/// The numbers of an .off file: points, then the corners of triangles.
struct Off {
    std::vector<std::string> points;
    std::vector<std::vector<int>> triangles;

    explicit Off(const std::string& path) {
        std::istringstream in(read_file(path));
        std::string word;
        std::size_t counts[3] = {};
        in >> word >> counts[0] >> counts[1] >> counts[2];
        EXPECT_EQ(word, "OFF");
        std::string line;
        std::getline(in, line);
        for (std::size_t i = 0; i < counts[0]; ++i) {
            std::getline(in, line);
            points.push_back(line);
        }
        for (std::size_t i = 0; i < counts[1]; ++i) {
            int corners = 0, a = 0, b = 0, c = 0;
            in >> corners >> a >> b >> c;
            EXPECT_EQ(corners, 3);
            triangles.push_back({a, b, c});
        }
        EXPECT_FALSE(in.fail());
    }
};

TEST(RenderIso, OfTwoCellsByHand) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), off = scratch.path("s.off");
    // attribute0 is 1 + 2x + 4y + 8z: 1 at node 0, 3, 5 and 9 at nodes 1, 2 and 3, 15 at node 4.
    const Ended r = run({"render", "iso", two, "--field", "point:attribute0", "--value", "4", "--output", off});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_TRUE(contains(r.out,
                         "cut        point:attribute0 = 4\nsurface    3 triangles, 5 points (0 of them nodes of "
                         "the mesh), in 2 cells\n"))
        << r.out;
    EXPECT_TRUE(contains(r.out, "note       fields that the format cannot hold: attribute0, cell:attribute0\n"))
        << r.out;
    const Off surface(off);
    EXPECT_EQ(surface.points, (Words{"0 0.75 0", "0 0 0.375", "0.5 0.5 0", "0.8333333333333334 0 0.16666666666666666",
                                     "1 0.08333333333333333 0.08333333333333333"}));
    EXPECT_EQ(surface.triangles.size(), 3U);
    // At a node's value: that node, and no other on its edges.
    ASSERT_EQ(run({"render", "iso", two, "--field", "attribute0", "--value", "5", "--output", off, "--quiet"}).out, "");
    const auto points = Off(off).points;
    EXPECT_EQ(std::count(points.begin(), points.end(), "0 1 0"), 1);
}

TEST(RenderIso, TheSameBytesOnAnyNumberOfThreads) {
    const Scratch scratch;
    for (const std::string suffix : {".vtp", ".ply", ".off"}) {
        std::string first;
        for (const std::string threads : {"1", "2", "3", "0", "2"}) {
            const std::string path = scratch.path("t" + threads + suffix);
            const Ended r = run({"render", "iso", mesh("cube-hole"), "--field", "attribute1", "--value", "0.3",
                                 "--threads", threads, "--output", path});
            ASSERT_EQ(r.code, 0) << r.err;
            const std::string bytes = read_file(path);
            EXPECT_GT(bytes.size(), 1000U);
            if (first.empty()) first = bytes;
            EXPECT_TRUE(bytes == first) << suffix << ' ' << threads;
        }
    }
}

TEST(RenderIso, TellsWhatItDidAsJson) {
    const Scratch scratch;
    const Ended r = run({"render", "iso", mesh("bracket"), "--field", "attribute0", "--value", "1", "--fields",
                         "attribute1", "--output", scratch.path("s.vtp"), "--json", "-", "--threads", "2"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.err, "cut        attribute0 = 1\n")) << r.err;
    const auto j = parse(r.out);
    EXPECT_EQ(j["command"], "render iso");
    EXPECT_EQ(j["value"], 1);
    EXPECT_EQ(j["fields"].dump(), "[\"attribute1\"]");
    EXPECT_GT(j["parts"], 100);
    EXPECT_EQ(j["cut"]["at_nodes"].get<int>() + j["cut"]["on_edges"].get<int>(), j["points"]);
    EXPECT_EQ(j["threads"], 2);
    EXPECT_FALSE(contains(read_file(scratch.path("s.vtp")), "attribute0"));
    EXPECT_TRUE(contains(read_file(scratch.path("s.vtp")), "Name=\"attribute1\""));
}

TEST(RenderIso, LinesOfAMeshOfTriangles) {
    const Scratch scratch;
    const Words line{"render", "iso", mesh("plate"), "--field", "attribute0", "--value", "1.25", "--output"};
    const Ended r = run(plus(line, {scratch.path("l.vtp")}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, " segments, ")) << r.out;
    EXPECT_TRUE(contains(read_file(scratch.path("l.vtp")), "NumberOfPolys=\"0\""));
    EXPECT_EQ(run(plus(line, {scratch.path("l.ply")})).code, 0);
    expect_error(plus(line, {scratch.path("l.off")}), "an .off file holds polygons only");
    EXPECT_EQ(scratch.names(), (Words{"l.ply", "l.vtp"}));
}

TEST(RenderIso, FieldsFromFilesAndTheirComponents) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), off = scratch.path("s.off");
    const std::string f = scratch.put("f.txt", "0 5\n1 6\n2 7\nnan 8\n4 9\n");
    const Words line{"render", "iso", two, "--field-file", "u=" + f, "--output", off, "--value"};
    EXPECT_EQ(run(plus(line, {"6.5", "--field", "u.1"})).code, 0);
    EXPECT_EQ(Off(off).points.size(), 5U);
    const Ended r = run(plus(line, {"0.5", "--field", "u.0"}));
    EXPECT_TRUE(contains(r.out, "surface    empty: the field at the nodes has 0 to 4\n")) << r.out;
    EXPECT_TRUE(contains(r.out, "note       2 cells left out: the field is NaN or infinite at a node")) << r.out;
    expect_error(plus(line, {"1", "--field", "u"}),
                 "the field has several components: expected one: u.0 to u.1, or the length |u|, found \"u\"");
    expect_error(plus(line, {"1", "--field", "u.2"}), "no such component in \"u.2\": expected 0 to 1");
    expect_error(plus(line, {"1", "--field", "v"}), "no field of that name: found \"v\"");
    expect_error(plus(line, {"1", "--field", "cell:attribute0"}), "is one of cells");
}

TEST(RenderIso, AsAPicture) {
    const Scratch scratch;
    const std::string png = scratch.path("s.png");
    const Words line{"render", "iso", mesh("flange"), "--field", "attribute0", "--output", png, "--value"};
    const Ended grey = run(plus(line, {"1.5", "--size", "200x150"}));
    EXPECT_EQ(grey.code, 0) << grey.err;
    EXPECT_TRUE(contains(grey.out, "picture    200 x 150 pixels, grey: --colours names a field\n")) << grey.out;
    const std::string first = read_file(png);
    EXPECT_EQ(first.substr(0, 8), "\x89PNG\r\n\x1a\n");
    const Words coloured{"1.5", "--colours", "attribute1", "--size", "200x150", "--camera", "60,25", "--json", "-"};
    const Ended r = run(plus(line, coloured));
    EXPECT_EQ(r.code, 0) << r.err;
    const auto j = parse(r.out);
    EXPECT_EQ(j["view"]["colours"], "attribute1");
    EXPECT_EQ(j["view"]["width"], 200);
    EXPECT_LT(j["view"]["low"], j["view"]["high"]);
    EXPECT_FALSE(read_file(png) == first);
    expect_error(plus(line, {"1e9"}), "the iso-surface is empty: expected a value from ");
    expect_error(plus(line, {"1", "--colours", "zzz"}), "no field of that name");
    expect_error(plus(line, {"1", "--camera", "nan,1"}), "--camera");
    expect_error(plus(line, {"1", "--size", "0x1"}), "--size");
    expect_error(plus(line, {"1", "--fields", "attribute1"}), "--fields cannot be combined with a picture");
    expect_error({"render", "iso", mesh("plate"), "--field", "attribute0", "--value", "1.25", "--output", png},
                 "iso-lines cannot be written as a picture");
}

TEST(RenderIso, OnASegment) {
    const auto says = [](const Words& options, const std::string& text) {
        const Ended r = run(plus({"render", "iso"}, options));
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(r.out, text);
    };
    says({"--segment", "1,1:2,2", "--values", "5,6", "--value", "5.5"}, "t 0.5\npoint 1.5,1.5\n");
    says({"--segment", "0,0,0:1,2,3", "--values", "0,3", "--value", "1"},
         "t 0.3333333333333333\npoint 0.3333333333333333,0.6666666666666666,1\n");
    says({"--segment", "-1:1", "--values", "0,1", "--value", "2"}, "t 2\npoint 3\noutside the segment, on its line\n");
    says({"--segment", "0:1", "--values", "1,1", "--value", "1"},
         "undetermined: both ends have the value 1: so has every point\n");
    says({"--segment", "0:1", "--values", "1,1", "--value", "2"},
         "undetermined: both ends have the value 1: no point has the one looked for\n");
    for (const std::string bad : {"0,0", "0:1,2", "0,0:nan,1", "1,2,3,4:1,2,3,4", "a:b", ":"})
        expect_error({"render", "iso", "--segment", bad, "--values", "1,2", "--value", "1"}, "--segment");
    expect_error({"render", "iso", "--segment", "0:1", "--value", "1"}, "--values FA,FB --value V");
    expect_error({"render", "iso", "--segment", "0:1", "--values", "1", "--value", "1"}, "--values");
    expect_error({"render", "iso", "--values", "1,2", "--value", "1"}, "--values needs --segment");
    expect_error({"render", "iso", mesh("plate"), "--segment", "0:1", "--values", "1,2", "--value", "1"},
                 "--segment cannot be combined");
}

TEST(RenderIso, WhatIsNotUnderstoodIsRefused) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), out = scratch.path("s.vtp");
    const Words line{"render", "iso", two, "--field", "attribute0", "--value"};
    expect_error({"render", "iso"}, "something is missing");
    expect_error({"render", "iso", two, "--field", "attribute0", "--output", out}, "something is missing");
    expect_error(plus(line, {"nan", "--output", out}), "--value");
    expect_error(plus(line, {"1,2", "--output", out}), "--value");
    expect_error(plus(line, {"1", "--output", scratch.path("s.stl")}),
                 "expected a surface (.vtp .off .ply) or a picture (.png .svg .pdf), found \".stl\"");
    expect_error(plus(line, {"1", "--output", out, "--fields", "zzz"}), "no field of that name");
    expect_error(plus(line, {"1", "--output", out, "--colours", "attribute0"}), "--colours is for pictures");
    expect_error(plus(line, {"1", "--output", out, "--range", "0,1"}), "--range is for pictures");
    expect_error(plus(line, {"1", "--output", scratch.path("none/s.vtp")}), "none");
    expect_error(plus(line, {"1", "--output", out, "--json", out}), "--json");
    expect_error({"render", "iso", scratch.path("no"), "--field", "f", "--value", "1", "--output", out}, "no");
    expect_error({"render", "zzz"}, "no such picture");
    expect_error({"render"}, "nothing to draw");
    EXPECT_EQ(scratch.names(), (Words{"two.ele", "two.node"})) << "nothing is written";
}

TEST(RenderSlice, AsASurface) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), off = scratch.path("s.off");
    const Ended r = run({"render", "slice", two, "--plane", "0,0,2,0.5", "--output", off});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "cut        plane 0,0,2,0.5\n")) << r.out;
    for (const std::string& point : Off(off).points) EXPECT_TRUE(point.ends_with(" 0.25")) << point;
    EXPECT_EQ(Off(off).points.size(), 5U);
    const Words ply{"render", "slice", two, "--plane", "0,0,2,0.5", "--output", scratch.path("s.ply")};
    EXPECT_TRUE(contains(run(ply).out, "fields     attribute0, cell:attribute0\n"));
    EXPECT_TRUE(contains(run(plus(ply, {"--field", "attribute0"})).out, "fields     attribute0\n"));
    EXPECT_TRUE(contains(run(plus(ply, {"--field", "cell:attribute0"})).out, "fields     cell:attribute0\n"));
    expect_error(plus(ply, {"--field", "zzz"}), "no field of that name");
    expect_error(plus(ply, {"--field", "attribute0", "--fields", "attribute0"}), "--field and --fields");
    const Ended none = run({"render", "slice", two, "--plane", "0,0,1,7", "--output", off, "--json", "-"});
    EXPECT_EQ(none.code, 0);
    EXPECT_TRUE(contains(none.err, "surface    empty: D at the nodes has 0 to 1\n")) << none.err;
    EXPECT_EQ(parse(none.out)["parts"], 0);
    EXPECT_EQ(Off(off).points.size(), 0U);
}

TEST(RenderSlice, AsAPicture) {
    const Scratch scratch;
    const std::string png = scratch.path("s.png");
    const Words line{"render", "slice", mesh("cube-hole"), "--plane", "0,0,1,0.5", "--output", png};
    const Ended r =
        run(plus(line, {"--field", "attribute0", "--samples", "1", "--width", "120", "--json", scratch.path("j")}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(read_file(png).substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_TRUE(contains(r.out, "picture    120 x 120 pixels of ")) << r.out;
    const auto j = parse(read_file(scratch.path("j")));
    EXPECT_EQ(j["picture"]["width"], 120);
    EXPECT_EQ(j["picture"]["height"], 120);
    EXPECT_EQ(j["picture"]["drawn"].get<int>() + j["picture"]["outside"].get<int>(), 14400);
    // The hole is a cylinder of radius 0.3 with straight sides: about 0.28 of the square.
    EXPECT_NEAR(j["picture"]["outside"].get<double>() / 14400, 0.277, 0.01);
    // Pixels are those points: what `sample` says there.
    const auto& o = j["picture"]["origin"];
    EXPECT_EQ(o[2], 0.5);
    EXPECT_EQ(j["picture"]["right"][0], j["picture"]["pixel"]);
    EXPECT_EQ(j["picture"]["up"][1], j["picture"]["pixel"]);
    EXPECT_EQ(run(plus(line, {"--field", "attribute0", "--width", "60", "--range", "0,1"})).code, 0);
    expect_error(plus(line, {"--width", "60"}), "a picture shows a field");
    expect_error(plus(line, {"--field", "zzz"}), "no field of that name");
    expect_error(plus(line, {"--field", "attribute0", "--width", "0"}), "--width");
    expect_error(plus(line, {"--field", "attribute0", "--width", "1000000"}), "the picture would be too large");
    expect_error(plus(line, {"--field", "attribute0", "--fields", "attribute1"}), "--fields cannot be combined");
    expect_error(plus(line, {"--field", "attribute0", "--range", "1,1"}), "--range");
    expect_error(
        {"render", "slice", mesh("cube-hole"), "--plane", "0,0,1,2", "--output", png, "--field", "attribute0"},
        "the section has no area: expected a plane that goes through the mesh, found D = 2, where the cells are "
        "from 0 to 1; choose D between them: --plane z=0.5");
    expect_error(
        {"render", "slice", mesh("cube-hole"), "--plane", "1,1,1,3", "--output", png, "--field", "attribute0"},
        "found D = 3, a plane that only touches the boundary: the cells are from 0 to 3; move it inwards: --plane "
        "1,1,1,2.997");
    // Where the mesh ends, at either end, there is a section.
    for (const std::string plane : {"0,0,-1,-1", "0,0,1,1", "0,0,1,0", "0,0,1,0.999"}) {
        const Ended end =
            run({"render", "slice", mesh("cube-hole"), "--plane", plane, "--output", scratch.path("e.vtp")});
        EXPECT_EQ(end.code, 0) << plane << end.err;
        EXPECT_FALSE(contains(end.err + end.out, "surface    0 triangles")) << plane << end.out << end.err;
        const Ended drawn =
            run({"render", "slice", mesh("cube-hole"), "--plane", plane, "--output", png, "--field", "attribute0"});
        EXPECT_EQ(drawn.code, 0) << plane << drawn.err;
    }
}

TEST(RenderSlice, OfFieldsOfCellsAndOblique) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), png = scratch.path("s.png");
    const Ended r = run({"render", "slice", two, "--plane", "1,1,1,1.25", "--field", "cell:attribute0", "--output", png,
                         "--width", "50", "--json", "-"});
    EXPECT_EQ(r.code, 0) << r.err;
    const auto j = parse(r.out);
    EXPECT_EQ(j["picture"]["low"], 9) << "the second cell alone is there";
    EXPECT_EQ(j["picture"]["high"], 9);
}

TEST(RenderSlice, ByOneAxis) {
    const Scratch scratch;
    const auto drawn = [&](const std::string& plane) {
        const Ended r =
            run({"render", "slice", mesh("cube-hole"), "--plane", plane, "--output", scratch.path("s.off")});
        EXPECT_EQ(r.code, 0) << r.err;
        return read_file(scratch.path("s.off"));
    };
    EXPECT_EQ(drawn("z=0.5"), drawn("0,0,1,0.5"));
    EXPECT_EQ(drawn("x=0.25"), drawn("1,0,0,0.25"));
    EXPECT_EQ(drawn("X = .25"), drawn("1, 0, 0, 0.25"));
    for (const std::string wrong : {"w=1", "z=", "z=nan", "z", "0,0,1"})
        expect_error({"render", "slice", mesh("cube-hole"), "--plane", wrong, "--output", scratch.path("s.off")},
                     "--plane: expected an axis and where, such as z=0.5, or NX,NY,NZ,D");
}

/// A quantity of sample is one in pictures, too, and so is a name that a refusal suggests.
TEST(Render, NamesOfQuantitiesAreThoseOfSample) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), png = scratch.path("p.png"), vtp = scratch.path("s.vtp");
    const std::string v = "v=" + scratch.put("v.txt", "0 0 0\n3 4 0\n0 0 2\n0 0 0\n1 1 1\n");
    const Words field{"--field-file", v, "--output", png, "--field"};
    for (const std::string name : {"|v|", "v.x", "v.1", "|grad(attribute0)|", "mean(cell:attribute0)", "grad(|v|).x"}) {
        const bool refused = name == "grad(|v|).x";  // nothing is made of a length at points, in sample neither
        for (const Words& line :
             std::vector<Words>{{"render", "mesh", two}, {"render", "slice", two, "--plane", "z=0.25"}}) {
            const Ended r = run(plus(line, plus(field, {name})));
            EXPECT_EQ(r.code, refused ? 2 : 0) << name << r.err;
            const bool told = contains(r.out, "note       converted: " + name + ": taken at the nodes");
            EXPECT_EQ(told, name == "|v|" && line[1] == "mesh") << r.out;
        }
    }
    const Words iso{"render", "iso", two, "--field-file", v, "--value", "2.5", "--output", vtp, "--field"};
    const Ended r = run(plus(iso, {"|v|", "--fields", "|v|,v"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "|v|: taken at the nodes, and interpolated between them")) << r.out;
    EXPECT_TRUE(contains(read_file(vtp), "Name=\"|v|\""));
    EXPECT_EQ(run({"render", "iso", two, "--field-file", v, "--value", "2.5", "--output", png, "--field", "v.x",
                   "--colours", "|v|"})
                  .code,
              0);
    expect_error(plus(iso, {"|grad(attribute0)|"}), "is one of cells");
    for (const Words& line : std::vector<Words>{{"render", "mesh", two}, {"render", "slice", two, "--plane", "z=0.25"}})
        expect_error(plus(line, plus(field, {"v"})), "expected one: v.0 to v.2, or the length |v|");
}

TEST(RenderSlice, WhatIsNotUnderstoodIsRefused) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), out = scratch.path("s.vtp");
    for (const std::string bad : {"0,0,0,1", "1,2,3", "0,0,1,inf", "0,0,1,x", "1,2,3,4,5", ""})
        expect_error({"render", "slice", two, "--plane", bad, "--output", out}, "--plane");
    expect_error({"render", "slice", two, "--output", out}, "--plane");
    expect_error({"render", "slice", mesh("plate"), "--plane", "0,0,1,0", "--output", out},
                 "a plane cuts meshes of tetrahedra");
    expect_error({"render", "slice", two, "--plane", "0,0,1,0", "--output", scratch.path("s.jpg")},
                 "expected a surface (.vtp .off .ply) or a picture (.png .svg .pdf), found \".jpg\"");
    expect_error({"render", "slice", two, "--plane", "0,0,1,0.5", "--output", out, "--range", "0,1"},
                 "--range is for pictures");
    EXPECT_EQ(scratch.names(), (Words{"two.ele", "two.node"})) << "nothing is written";
}

}  // namespace
}  // namespace barycert::cli_test

// barycert check: exit codes, outputs and options, on meshes that are good, broken and none at all.

#include <sys/stat.h>

#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

const std::string apart = "8 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 2 0 0\n5 3 0 0\n6 2 1 0\n7 2 0 1\n";
const std::string two_cells = "2 4 0\n0 0 1 2 3\n1 4 5 6 7\n";

/// A mesh in small: its files but the coordinates, which are `apart`.
std::string put_mesh(const Scratch& scratch, const std::string& stem, const std::string& ele,
                     const std::string& node = apart) {
    scratch.put(stem + ".node", node);
    scratch.put(stem + ".ele", ele);
    return scratch.path(stem);
}

/// Two cells of which one stands in the other.
std::string put_overlapping(const Scratch& scratch) {
    return put_mesh(scratch, "over", two_cells,
                    "8 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 .1 .1 .1\n5 1.1 .1 .1\n6 .1 1.1 .1\n7 .1 .1 1.1\n");
}

/// Cells apart from each other, the second in the negative order.
std::string put_mixed(const Scratch& scratch) {
    return put_mesh(scratch, "mixed", "2 4 1\n0 0 1 2 3 0.1\n1 5 4 6 7 0.2\n");
}

Words check(const std::string& path, const Words& more = {}) {
    Words arguments{"check", path};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

void expect_verdict(const std::string& path, int code, const std::string& says) {
    const Ended r = run(check(path));
    EXPECT_EQ(r.code, code) << r.err;
    EXPECT_EQ(r.err, "");
    ASSERT_FALSE(r.out.empty());
    EXPECT_EQ(lines_of(r.out).front(), path + ": " + says);
    EXPECT_EQ(run(check(path, {"--quiet"})).code, code);
}

TEST(Check, AGoodMeshIsCertified) {
    const Scratch scratch;
    expect_verdict(put_mesh(scratch, "m", two_cells), 0,
                   "certified: 2 cells partition a domain of 2 parts, 0 cavities, 0 tunnels");
    expect_verdict(put_mixed(scratch), 0, "certified: 2 cells partition a domain of 2 parts, 0 cavities, 0 tunnels");
    expect_verdict(put_mesh(scratch, "none", "0 4 0\n"), 0, "certified, trivially: the mesh has no cells");
    for (const std::string name : {"bracket", "cube-hole-o2", "flange", "lattice-box", "plate"}) {
        const Ended r = run(check(mesh(name)));
        EXPECT_EQ(r.code, 0) << name << r.out;
        EXPECT_TRUE(contains(r.out, ": certified: ")) << r.out;
    }
}

TEST(Check, ABrokenMeshIsNot) {
    const Scratch scratch;
    expect_verdict(put_overlapping(scratch), 1,
                   "NOT certified: 1 pair of cells overlaps, 3 pairs of boundary facets meet, and 1 more defect");
    expect_verdict(put_mesh(scratch, "flat", two_cells, apart.substr(0, apart.rfind("7 ")) + "7 3 1 0\n"), 1,
                   "NOT certified: 1 cell is degenerate, 4 pairs of boundary facets meet");
    const Ended twice = run(check(put_mesh(scratch, "twice", "3 4 0\n0 0 1 2 3\n1 4 5 6 7\n2 0 1 2 3\n")));
    EXPECT_EQ(twice.code, 1);
    EXPECT_TRUE(contains(twice.out,
                         "\nduplicate_cell               1  cells with the same nodes as another\n    cells 0 and 2\n"))
        << twice.out;
    const std::string neigh = put_mesh(scratch, "neigh", two_cells);
    scratch.put("neigh.neigh", "2 4\n0 1 -1 -1 -1\n1 -1 -1 -1 -1\n");
    expect_verdict(neigh, 1, "NOT certified: 1 entry of .neigh is wrong");
    const std::string face = put_mesh(scratch, "face", two_cells);
    scratch.put("face.face", "2 0\n0 0 1 2\n1 0 1 7\n");
    expect_verdict(face, 1, "NOT certified: 1 face in the files is not a facet");
}

TEST(Check, ConformityToThePlcIfAsked) {
    const std::string plc = std::string(BARYCERT_DATA_DIR) + "/plc/";
    const Ended good = run(check(mesh("cube-hole"), {"--conforms-to", plc + "cube-hole.poly"}));
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_TRUE(
        contains(good.out, "\nPLC        326 facets of the PLC: 326 respected exactly, 0 up to rounding, 0 violated\n"))
        << good.out;
    // Another shape: told, and the mesh is a partition nevertheless.
    const Ended other = run(check(mesh("cube-hole"), {"--conforms-to", plc + "torus.off"}));
    EXPECT_EQ(other.code, 0) << other.err;
    EXPECT_TRUE(contains(other.out, "0 up to rounding, 1296 violated\n")) << other.out;
    EXPECT_FALSE(contains(run(check(mesh("cube-hole"))).out, "PLC"));
    const Scratch scratch;
    const std::string cut = scratch.put("cut.off", "OFF\n3 1 0\n0 0 0\n");
    const std::vector<std::pair<Words, std::string>> refusals{
        {check(mesh("cube-hole"), {"--conforms-to", scratch.path("none.poly")}), "error: " + scratch.path("none.poly")},
        {check(mesh("cube-hole"), {"--conforms-to", cut}), "error: " + cut + ":"},
        {check(mesh("cube-hole"), {"--conforms-to", mesh("cube-hole")}), "error: " + mesh("cube-hole")},
        {check(mesh("plate"), {"--conforms-to", plc + "torus.off"}), "--conforms-to needs a mesh of tetrahedra"}};
    for (const auto& [arguments, says] : refusals) {
        const Ended r = run(arguments);
        EXPECT_EQ(r.code, 2) << says;
        EXPECT_TRUE(contains(r.err, says)) << r.err;
        EXPECT_EQ(r.out, "");
    }
}

TEST(Check, WhatCannotBeReadIsAnError) {
    const Scratch scratch;
    const std::string bad = put_mesh(scratch, "bad", "1 4 0\n0 0 1 2 99\n");
    const std::vector<std::pair<Words, std::string>> refusals{
        {check(bad), "error: " + bad + ".ele:2: "},
        {check(scratch.path("none")), "error: " + scratch.path("none") + ": no such file"},
        {check(scratch.path("none")), "MESH is the stem of TetGen's files"},
        {check(scratch.path("part.stl")), "error: " + scratch.path("part.stl") + ": no such file"},
        {check(scratch.folder()), "this is a folder"},
        {{"check"}, "MESH is required"},
        {check(bad, {bad}), "error: "},
        {check(bad, {"--threads", "-1"}), "--threads"},
        {check(bad, {"--examples", "-1"}), "--examples"},
        {check(bad, {"--contacts", "many"}), "--contacts"},
        {check(bad, {"--json"}), "--json"},
    };
    for (const auto& [arguments, says] : refusals) {
        const Ended r = run(arguments);
        EXPECT_EQ(r.code, 2) << says;
        EXPECT_EQ(r.out, "");
        EXPECT_TRUE(contains(r.err, says)) << r.err;
    }
    EXPECT_EQ(run(check(scratch.path("none"), {"--json", scratch.path("r.json")})).code, 2);
    EXPECT_TRUE(contains(read_file(scratch.path("r.json")), "\"code\": \"file.missing\""));
}

TEST(Check, AnyFileOfTheMeshNamesIt) {
    const Scratch scratch;
    const std::string stem = put_mesh(scratch, "m", two_cells);
    for (const std::string suffix : {"", ".node", ".ele"}) {
        const Ended r = run(check(stem + suffix));
        EXPECT_EQ(r.code, 0);
        EXPECT_EQ(r.out.rfind(stem + ": certified", 0), 0U);
    }
}

TEST(Check, JsonSaysWhatTheTableSays) {
    const Scratch scratch;
    const std::string over = put_overlapping(scratch);
    const Ended r = run(check(over, {"--json", "-"}));
    EXPECT_EQ(r.code, 1);
    EXPECT_EQ(r.err, "");
    const auto j = parse(r.out);
    EXPECT_EQ(j["schema"], 1);
    EXPECT_EQ(j["mesh"], over);
    EXPECT_EQ(j["verdict"], "not certified");
    EXPECT_EQ(j["contacts"].size(), 1U);
    EXPECT_EQ(j["findings"].back()["name"], "overlapping_cells");
    EXPECT_EQ(j["environment"]["rounding"], "nearest");
    EXPECT_FALSE(j.contains("delaunay"));
    const Ended file = run(check(over, {"--json", scratch.path("r.json"), "--quiet"}));
    EXPECT_EQ(file.code, 1);
    EXPECT_EQ(file.out + file.err, "");
    auto written = parse(read_file(scratch.path("r.json")));
    auto shown = j;
    for (auto* report : {&written, &shown}) (*report).erase("seconds");
    EXPECT_EQ(written, shown);
}

TEST(Check, HtmlIsAPage) {
    const Scratch scratch;
    const std::string over = put_overlapping(scratch);
    const Ended r = run(check(over, {"--html", "-"}));
    EXPECT_EQ(r.code, 1);
    EXPECT_EQ(r.err, "");
    EXPECT_TRUE(contains(r.out, "<html"));
    EXPECT_TRUE(contains(r.out, "</html>"));
    EXPECT_FALSE(contains(r.out, "NOT certified: 1 pair of cells overlaps, 3 pairs")) << "no table besides";
    const Ended both = run(check(over, {"--html", scratch.path("r.html"), "--json", scratch.path("r.json")}));
    EXPECT_EQ(both.code, 1);
    EXPECT_TRUE(contains(both.out, ": NOT certified: "));
    EXPECT_TRUE(contains(read_file(scratch.path("r.html")), "</html>"));
    EXPECT_EQ(parse(read_file(scratch.path("r.json")))["schema"], 1);
}

TEST(Check, OptionsReachTheCheck) {
    const Scratch scratch;
    const std::string over = put_overlapping(scratch);
    const auto j = parse(run(check(over, {"--json", "-", "--examples", "2", "--contacts", "0", "--threads", "1"})).out);
    EXPECT_EQ(j["contacts"].size(), 0U);
    EXPECT_EQ(j["findings"][0]["count"], 3);
    EXPECT_EQ(j["findings"][0]["places"].size(), 2U);
    EXPECT_EQ(j["threads"], 1);
    const Ended few = run(check(over, {"--examples", "0", "--contacts", "0"}));
    EXPECT_EQ(few.code, 1);
    EXPECT_FALSE(contains(few.out, "cells 0 and 1"));
    const Ended r = run(check(mesh("cube-hole"), {"--delaunay"}));
    EXPECT_EQ(r.code, 0);
    EXPECT_TRUE(contains(r.out, "\nDelaunay   "));
    EXPECT_GT(parse(run(check(mesh("cube-hole"), {"--delaunay", "--json", "-"})).out)["delaunay"]["facets"], 1000);
}

TEST(Check, ThreadsChangeNothing) {
    Words reports;
    for (const std::string threads : {"1", "2", "7"}) {
        auto j = parse(run(check(mesh("cube-hole"), {"--json", "-", "--delaunay", "--threads", threads})).out);
        j.erase("seconds");
        j.erase("threads");
        reports.push_back(j.dump());
    }
    EXPECT_EQ(reports[0], reports[1]);
    EXPECT_EQ(reports[0], reports[2]);
}

TEST(Check, TheCopyHasPositiveCellsAndAllElse) {
    const Scratch scratch;
    const std::string mixed = put_mixed(scratch);
    scratch.put("mixed.neigh", "2 4\n0 -1 -1 -1 -1\n1 -1 -1 -1 -1\n");
    EXPECT_TRUE(contains(run(check(mixed)).out, "mixed_orientation            1 "));
    const Ended r = run(check(mixed, {"--fix-orientation", scratch.path("fixed"), "--quiet"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out + r.err, "");
    EXPECT_EQ(scratch.names(),
              (Words{"fixed.ele", "fixed.neigh", "fixed.node", "mixed.ele", "mixed.neigh", "mixed.node"}));
    EXPECT_EQ(read_file(scratch.path("fixed.ele")), "2 4 1\n0 0 1 2 3 0.1\n1 5 4 7 6 0.2\n");
    const auto j = parse(run(check(scratch.path("fixed"), {"--json", "-"})).out);
    EXPECT_EQ(j["orientation"]["positive"], 2);
    EXPECT_EQ(j["orientation"]["negative"], 0);
    // A copy of a good mesh is the mesh; also with nodes at mid-edges, and over an older copy.
    for (const std::string name : {"cube-hole", "cube-hole-o2", "plate"}) {
        for (int again = 0; again < 2; ++again)
            EXPECT_EQ(run(check(mesh(name), {"--fix-orientation", scratch.path(name), "--quiet"})).code, 0);
        EXPECT_EQ(run(check(scratch.path(name), {"--json", "-"})).code, 0);
    }
}

// Two cells that share a facet, each with nodes of its own, one of which is an ulp off; and one of the cells twice.
const std::string twin_nodes =
    "8 3 1 0\n0 0 0 0 1\n1 1 0 0 2\n2 0 1 0 3\n3 0 0 1 4\n4 0 0 0 1\n5 1.0000000000000002 0 0 2.5\n6 0 1 0 3\n7 0 0 -1 "
    "4\n";
const std::string twins = "3 4 0\n0 0 1 2 3\n1 4 6 5 7\n2 0 1 2 3\n";

TEST(Check, TheRepairedCopyIsCheckedAndTold) {
    const Scratch scratch;
    const std::string broken = put_mesh(scratch, "broken", twins, twin_nodes);
    EXPECT_EQ(run(check(broken, {"--quiet"})).code, 1);
    // Coincident nodes alone: the slit of an ulp stays.
    const Ended exact = run(check(broken, {"--fix", scratch.path("slit.vtu")}));
    EXPECT_EQ(exact.code, 1) << exact.out;
    EXPECT_TRUE(contains(exact.out, "\n2 nodes merged into the lowest at their place; none moved\n")) << exact.out;
    EXPECT_TRUE(contains(exact.out, "\n1 cell dropped: 1 duplicate_cell\n"));
    EXPECT_TRUE(contains(exact.out, "slit.vtu: NOT certified: 6 pairs of boundary facets meet\n"));
    EXPECT_TRUE(contains(exact.out, "nodes 1 and 4, 2.22e-16 apart")) << exact.out;
    const std::string json = scratch.path("r.json"), copy = scratch.path("copy");
    const Ended within = run(check(broken, {"--fix", copy, "--merge-within", "1e-12", "--json", json}));
    EXPECT_EQ(within.code, 0) << within.err;
    EXPECT_TRUE(contains(within.out, "3 nodes merged into the lowest at their place, moved by at most 2.22"))
        << within.out;
    EXPECT_TRUE(contains(within.out,
                         "field attribute0: 1 merged node has another value than the node that is kept, by up to 0.5"));
    EXPECT_TRUE(contains(within.out, "copy: certified: 2 cells partition a domain of 1 part,"));
    EXPECT_EQ(read_file(copy + ".node").substr(0, 7), "5 3 1 0");
    const auto fix = parse(read_file(json))["fix"];
    EXPECT_EQ(parse(read_file(json))["verdict"], "not certified") << "of what was given";
    EXPECT_EQ(fix["verdict"], "certified");
    EXPECT_EQ(fix["merged"].size(), 3U);
    EXPECT_EQ(fix["dropped"][0]["cell"], 2);
    EXPECT_EQ(fix["dropped"][0]["why"], "duplicate_cell");
    EXPECT_EQ(fix["fields"][0]["largest_difference"], 0.5);
    EXPECT_EQ(read_file(broken + ".node"), twin_nodes) << "the input stays";
    // A defect without a single right repair stays, and the exit code says so.
    const Ended over = run(check(put_overlapping(scratch), {"--fix", scratch.path("over2")}));
    EXPECT_EQ(over.code, 1);
    EXPECT_TRUE(contains(over.out, "What remains in the copy\n")) << over.out;
}

TEST(Check, TheCopyTellsWhatItCannotHold) {
    const Scratch scratch;
    const std::string m = put_mesh(scratch, "m", "2 4 1\n0 0 1 2 3 0.1\n1 4 5 6 7 0.2\n");
    scratch.put("m.face", "1 1\n0 0 1 2 7\n");
    const std::string vtu = scratch.path("m.vtu");
    const Ended faces = run(check(m, {"--fix", vtu}));
    EXPECT_TRUE(contains(faces.out, "\nnothing to repair\nleft out: faces, for which the format has no place: 1\n"))
        << faces.out;
    std::string text = read_file((run(check(m, {"--fix", vtu, "--vtk-data", "ascii", "--quiet"})), vtu));
    text.replace(text.find("attribute0"), 10, "rho");
    text.replace(text.find("</CellData>"), 0,
                 "<DataArray type=\"Int64\" Name=\"id\" format=\"ascii\">9007199254740993 1</DataArray>\n");
    const std::string named = scratch.put("named.vtu", text);
    const std::string json = scratch.path("r.json");
    const Ended stem = run(check(named, {"--fix", scratch.path("copy"), "--json", json}));
    EXPECT_EQ(stem.code, 0) << stem.err;
    EXPECT_TRUE(contains(stem.out, "the names of fields, which an .ele file cannot hold: attribute0 is rho\n"))
        << stem.out;
    EXPECT_TRUE(contains(stem.out, "labels of cells, for which the format has no place: id\n"));
    EXPECT_EQ(parse(read_file(json))["fix"]["notes"].size(), 2U);
    EXPECT_TRUE(contains(run(check(named, {"--fix", scratch.path("copy.msh")})).out, "has no place: id\n"));
    EXPECT_TRUE(contains(run(check(named, {"--fix", scratch.path("copy.vtk")})).out, "the copy is as the mesh is\n"));
}

TEST(Check, NeighboursThatWereWrongAreToldOfTheCopy) {
    const Scratch scratch;
    const std::string neigh = put_mesh(scratch, "neigh", two_cells);
    scratch.put("neigh.neigh", "2 4\n0 1 -1 -1 -1\n1 -1 -1 -1 -1\n");
    const Ended r = run(check(neigh, {"--fix", scratch.path("copy")}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "\n1 entry of neighbours corrected\n")) << r.out;
    EXPECT_FALSE(contains(r.out, "nothing to repair"));
}

TEST(Check, NoCopyIsWrittenWithoutCells) {
    const Scratch scratch;
    const std::string flat =
        put_mesh(scratch, "flat", "1 4 0\n0 0 1 2 3\n", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 2 0 0\n3 3 0 0\n");
    const Ended r = run(check(flat, {"--fix", scratch.path("copy.vtu")}));
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err,
                         "copy.vtu: no copy is written, as it would have no cells: found 1 cell dropped: 1 "
                         "degenerate_cell"))
        << r.err;
    EXPECT_TRUE(contains(r.out, "NOT certified: 1 cell is degenerate"));
    EXPECT_EQ(scratch.names(), (Words{"flat.ele", "flat.node"}));
}

TEST(Check, ACopyForNumbersThatAreNoneHasAnotherFormat) {
    const Scratch scratch;
    const std::string m = put_mesh(scratch, "m", "2 4 1\n0 0 1 2 3 0.1\n1 4 5 6 7 0.2\n"),
                      vtu = scratch.path("nan.vtu");
    EXPECT_EQ(run(check(m, {"--fix", vtu, "--vtk-data", "ascii", "--quiet"})).code, 0);
    std::string text = read_file(vtu);
    text.replace(text.find("0.1 "), 3, "nan");
    const Ended r = run(check(scratch.put("nan.vtu", text), {"--fix", scratch.path("copy")}));
    EXPECT_EQ(r.code, 2) << r.out;
    EXPECT_TRUE(contains(r.err, "choose .vtu, .vtk or .msh, which hold it")) << r.err;
}

TEST(Check, ARepairThatCannotBeIsRefused) {
    const Scratch scratch;
    const std::string m = put_mesh(scratch, "m", two_cells);
    const std::vector<std::pair<Words, std::string>> refusals{
        {{"--fix", m}, "--fix would overwrite the mesh"},
        {{"--merge-within", "1"}, "--merge-within is for --fix"},
        {{"--fix", "c", "--merge-within", "-1"}, "--merge-within"},
        {{"--fix", "c", "--fix-orientation", "d"}, "--fix"},
        {{"--fix", "c.stl"}, "unknown format of a mesh to be written"},
        {{"--fix", "-"}, "--fix cannot write to stdout; name a file"},
        {{"--fix-orientation", "-"}, "--fix-orientation cannot write to stdout; name a file"},
    };
    for (const auto& [more, says] : refusals) {
        const Ended r = run(check(m, more));
        EXPECT_EQ(r.code, 2) << says;
        EXPECT_TRUE(contains(r.err, says)) << r.err;
    }
    EXPECT_EQ(scratch.names(), (Words{"m.ele", "m.node"}));
}

TEST(Check, TheCopyInOtherFormats) {
    const Scratch scratch;
    const std::string mixed = put_mixed(scratch);
    for (const std::string name : {"fixed.vtu", "fixed.vtk", "fixed.msh"}) {
        const std::string file = scratch.path(name);
        const Ended r = run(check(mixed, {"--fix-orientation", file, "--quiet"}));
        EXPECT_EQ(r.code, 0) << r.err;
        const auto j = parse(run(check(file, {"--json", "-"})).out);
        EXPECT_EQ(j["orientation"]["positive"], 2) << name;
        EXPECT_EQ(j["orientation"]["negative"], 0) << name;
    }
    EXPECT_EQ(scratch.names(), (Words{"fixed.msh", "fixed.vtk", "fixed.vtu", "mixed.ele", "mixed.node"}));
    const Ended over = run(check(scratch.path("fixed.vtu"), {"--fix-orientation", scratch.path("fixed.vtu")}));
    EXPECT_EQ(over.code, 2);
    EXPECT_TRUE(contains(over.err, "--fix-orientation would overwrite the mesh")) << over.err;
    const Ended other = run(check(mixed, {"--fix-orientation", scratch.path("fixed.stl")}));
    EXPECT_EQ(other.code, 2);
    EXPECT_TRUE(contains(other.err, "fixed.stl: unknown format of a mesh to be written")) << other.err;
    const Ended text =
        run(check(mixed, {"--fix-orientation", scratch.path("text.vtu"), "--vtk-data", "ascii", "--quiet"}));
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_TRUE(contains(read_file(scratch.path("text.vtu")), "format=\"ascii\""));
}

TEST(Check, TheCopyDoesNotMixWithAnotherMesh) {
    const Scratch scratch;
    const std::string m = put_mesh(scratch, "m", two_cells);
    scratch.put("other.face", "1 0\n0 0 1 2\n");
    const Ended r = run(check(m, {"--fix-orientation", scratch.path("other"), "--json", scratch.path("r.json")}));
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.out, "");
    EXPECT_EQ(r.err, "error: " + scratch.path("other.face") +
                         ": a file of another mesh exists; remove it, or give --fix-orientation another name\n");
    EXPECT_EQ(scratch.names(), (Words{"m.ele", "m.node", "other.face"}));
}

TEST(Check, VtuIsWrittenOrItIsToldHowToGetIt) {
    const Scratch scratch;
    const std::string over = put_overlapping(scratch), vtu = scratch.path("m.vtu");
    const Ended r = run(check(over, {"--vtu", vtu}));
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_EQ(r.err, "");
    const std::string written = read_file(vtu);
    for (const std::string name :
         {"orientation", "volume", "condition", "radius_edge", "aspect", "min_angle", "max_angle", "problems"})
        EXPECT_TRUE(contains(written, "Name=\"" + name + "\"")) << name;
    // Infinite ratios of a degenerate cell are values like others.
    const std::string flat = put_mesh(scratch, "flat", two_cells, apart.substr(0, apart.rfind("7 ")) + "7 3 1 0\n");
    EXPECT_EQ(run(check(flat, {"--vtu", vtu})).code, 1);
    EXPECT_EQ(run(check(mesh("cube-hole-o2"), {"--vtu", vtu, "--quiet"})).code, 0);
    EXPECT_EQ(run(check(mesh("plate"), {"--vtu", vtu, "--quiet"})).code, 0);
    EXPECT_EQ(scratch.names(), (Words{"flat.ele", "flat.node", "m.vtu", "over.ele", "over.node"}));
}

TEST(Check, OnePlaceForTwoFilesIsRefused) {
    const Scratch scratch;
    const std::string m = put_mesh(scratch, "m", two_cells);
    const How here{.folder = scratch.folder()};
    const std::vector<std::pair<Words, std::string>> refusals{
        {{"--fix-orientation", "c", "--vtu", "-"}, "--vtu cannot write to stdout"},
        {{"--json", "c.ele", "--fix-orientation", "./c"}, "--fix-orientation and --json name the same output"},
        {{"--json", "-", "--html", "-"}, "--json and --html name the same output"},
        {{"--json", "r", "--html", "./r"}, "--json and --html name the same output"},
        {{"--json", "m.node"}, "--json would overwrite the mesh"},
        {{"--json", "m.neigh"}, "--json would overwrite the mesh"},
        {{"--fix-orientation", "m"}, "--fix-orientation would overwrite the mesh"},
        {{"--json", "none/r"}, "cannot make a file beside the target"},
        {{"--fix-orientation", "none/c"}, "cannot make a file beside the target"},
        {{"--json", "r.vtu", "--vtu", "./r.vtu"}, "--vtu and --json name the same output"},
        {{"--vtu", "m.ele"}, "expected a name that ends in .vtu"},
        {{"--vtu", "none/r.vtu"}, "cannot make a file beside the target"},
    };
    for (const auto& [more, says] : refusals) {
        const Ended r = run(check("m", more), here);
        EXPECT_EQ(r.code, 2) << says;
        EXPECT_EQ(r.out, "");
        EXPECT_TRUE(contains(r.err, says)) << r.err;
    }
    EXPECT_EQ(scratch.names(), (Words{"m.ele", "m.node"}));
    EXPECT_EQ(read_file(m + ".ele"), two_cells);
}

TEST(Check, APlaceThatCannotBeWrittenDoesNotCostTheTable) {
    const Scratch scratch;
    const std::string m = put_mesh(scratch, "m", two_cells);
    const Ended full = run(check(m, {"--json", "/dev/full"}));
    EXPECT_EQ(full.code, 2);
    EXPECT_TRUE(contains(full.err, "error: /dev/full: cannot write the file: found No space left on device"));
    EXPECT_TRUE(contains(full.out, ": certified"));
    const std::string old = scratch.put("r.json", "old");
    const Ended small = run(check(m, {"--json", old}), {.max_file = 512});
    EXPECT_EQ(small.code, 2);
    EXPECT_EQ(read_file(old), "old");
    const Ended copy =
        run(check(mesh("bracket"), {"--fix-orientation", scratch.path("c"), "--quiet"}), {.max_file = 60000});
    EXPECT_EQ(copy.code, 2) << "the .node file is larger, the others are not";
    EXPECT_EQ(scratch.names(), (Words{"m.ele", "m.node", "r.json"}));
    EXPECT_EQ(run(check(m), {.stdout_path = "/dev/full"}).code, 2);
    EXPECT_EQ(run(check(m), {.close_stdout = true}).code, 2);
    EXPECT_EQ(run(check(m, {"--quiet"}), {.close_stdout = true, .close_stderr = true}).code, 0);
}

TEST(Check, KilledItLeavesNothing) {
    const Scratch scratch;
    const std::string old = scratch.put("r.json", "old");
    const Ended r = run(check(mesh("flange"), {"--json", old, "--fix-orientation", scratch.path("c")}),
                        {.terminal = true, .kill_on = "checking: cells", .kill_with = SIGKILL});
    EXPECT_EQ(r.signal, SIGKILL);
    EXPECT_EQ(read_file(old), "old");
    EXPECT_EQ(scratch.names(), Words{"r.json"});
}

TEST(Check, ProgressAndColourAreForTerminals) {
    const Ended shown = run(check(mesh("cube-hole")), {.environment = {"NO_COLOR"}, .terminal = true});
    EXPECT_EQ(shown.code, 0);
    EXPECT_TRUE(contains(shown.out, "\r\033[Kchecking: cells"));
    EXPECT_TRUE(contains(shown.out, "\033[32m"));
    const Ended plain = run(check(mesh("cube-hole")), {.environment = {"NO_COLOR=1"}, .terminal = true});
    EXPECT_FALSE(contains(plain.out, "\033[32m"));
    EXPECT_EQ(run(check(mesh("cube-hole"), {"--quiet"}), {.terminal = true}).out, "");
    const Ended piped = run(check(mesh("cube-hole")));
    EXPECT_FALSE(contains(piped.out + piped.err, "\033"));
    EXPECT_FALSE(contains(piped.out + piped.err, "checking"));
}

TEST(Check, HelpTellsOptionsAndExitCodes) {
    const Ended r = run({"check", "--help"});
    EXPECT_EQ(r.code, 0);
    for (const std::string word : {"--delaunay", "--threads", "--json", "--html", "--vtu", "--fix-orientation",
                                   "--examples", "--contacts", "--quiet", "--fix FILE", "--merge-within DISTANCE",
                                   "--near RATIO", "Exit codes: 0 certified, 1 not certified, 2 "})
        EXPECT_TRUE(contains(r.out, word)) << word;
    EXPECT_TRUE(contains(run({"--help"}).out, "\n  check "));
    EXPECT_TRUE(contains(run({"--help"}).out, "1 a mesh is not certified, results are wrong"));
}

}  // namespace
}  // namespace barycert::cli_test

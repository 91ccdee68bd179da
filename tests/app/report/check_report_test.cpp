// The report on a mesh: what a reader is told, as text and as JSON.

#include <cmath>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "barycert/report.hpp"
#include "check_meshes.hpp"
#include "core/base/text.hpp"
#include "lines.hpp"
#include "schema_tables.hpp"

namespace barycert::report_test {
namespace {

using Json = nlohmann::json;
using Lines = std::vector<std::string>;

std::string text(const CheckReport& report, const Mesh& mesh, bool colour = false) {
    return check_text(report, mesh, "part", {.colour = colour});
}
std::string text(const Mesh& mesh) {
    return text(checked(mesh, true), mesh);
}

Json json(const CheckReport& report) {
    return Json::parse(check_json(report, "part.1", measure_environment()));
}

/// A report of one problem, not of any mesh.
CheckReport with_finding(DefectKind problem, std::uint64_t count, bool at_least = false) {
    CheckReport r;
    r.nodes = 8;
    r.cells = 2;
    r.defects.push_back({problem, count, at_least, {{.cells = {0, 1}}}});
    return r;
}

TEST(CheckTerminal, TheFirstLineIsTheVerdict) {
    EXPECT_EQ(lines_of(text(own_mesh("bracket"))).front(),
              "part: certified: 2400 cells partition a domain of 1 part, 0 cavities, 1 tunnel");
    EXPECT_EQ(lines_of(text(own_mesh("cube-hole"))).front(),
              "part: certified: 1590 cells partition a domain of 1 part, 1 cavity, 0 tunnels");
    EXPECT_EQ(lines_of(text(own_mesh("plate"))).front(),
              "part: certified: 2040 cells partition a domain of 1 part, 1 hole");
    EXPECT_EQ(lines_of(text(tetrahedra(pair_of_cells().points, {0, 1, 2, 3}))).front(),
              "part: certified: 1 cell is a domain of 1 part, 0 cavities, 0 tunnels");
    EXPECT_EQ(lines_of(text(Mesh())).front(), "part: certified, trivially: the mesh has no cells");
    EXPECT_EQ(lines_of(text(overlapping())).front(),
              "part: NOT certified: 1 pair of cells overlaps, 3 pairs of boundary facets meet, and 1 more defect");
    EXPECT_EQ(lines_of(text(thoroughly_broken()))
                  .front()
                  .find("part: NOT certified: 3 pairs of cells overlap, 1 cell has a node twice, "),
              0U)
        << text(thoroughly_broken());
    EXPECT_TRUE(contains(lines_of(text(thoroughly_broken())).front(), " more defects"));
}

TEST(CheckTerminal, EveryProblemHasWordsForOneAndForMore) {
    for (const DefectText& t : defect_texts) {
        if (!t.breaks) continue;
        const std::string one = lines_of(text(with_finding(t.kind, 1), {})).front();
        const std::string two = lines_of(text(with_finding(t.kind, 2), {})).front();
        EXPECT_EQ(one.find("part: NOT certified: 1 "), 0U) << t.name;
        EXPECT_EQ(two.find("part: NOT certified: 2 "), 0U) << t.name;
        EXPECT_NE(one.substr(24), two.substr(24)) << t.name;
        EXPECT_TRUE(contains(text(with_finding(t.kind, 1), {}), "\n" + std::string(t.name) + " ")) << t.name;
    }
}

TEST(CheckTerminal, CausesStandWithWhatTheyBreak) {
    const Mesh mesh = cracked_and_hanging();
    const std::string all = text(mesh), above = all.substr(0, all.find("Notes: these do not affect"));
    EXPECT_TRUE(contains(above, "\n    node 0 within edge 9 10 of cell 2")) << all;
    EXPECT_TRUE(contains(above, "\n    -> split that cell at the node\n"));
    EXPECT_TRUE(contains(above, "\ncoincident_nodes "));
    EXPECT_TRUE(contains(
        above, "\n    -> merge coincident and near nodes, and split the cells at hanging nodes: both below\n"));
    EXPECT_TRUE(contains(above, ", nodes 0 1 and ")) << "both facets of a pair";
    EXPECT_FALSE(contains(all, "merge coincident nodes, or move the parts apart"));
}

TEST(CheckTerminal, WhatWasRepairedAndWhatRemains) {
    const Mesh mesh = cracked_and_hanging();
    FixedMesh fixed{.file = "copy.vtu", .done = {}, .after = {}};
    fixed.after = checked(fix_mesh(mesh, {}, fixed.done).value());
    const std::string told = fix_text(fixed, {});
    EXPECT_EQ(told.find("\nRepaired copy: copy.vtu\n1 node merged into the lowest at their place; none moved\n"), 0U)
        << told;
    EXPECT_TRUE(contains(told, "field T: 1 merged node has another value than the node that is kept, by up to 3: "));
    EXPECT_TRUE(contains(told, "\n1 cell dropped: 1 repeated_node\n"));
    EXPECT_TRUE(contains(told, "\ncopy.vtu: NOT certified: "));
    EXPECT_TRUE(contains(told, "\nWhat remains in the copy\n"));
    FixReport none;
    EXPECT_EQ(fix_text({.file = "c", .done = none, .after = checked(pair_of_cells())}, {})
                  .find("\nRepaired copy: c\nnothing to repair: the copy is as the mesh is\nc: certified: 2 cells"),
              0U);
}

TEST(CheckTerminal, LinesFitATerminal) {
    const std::vector<Mesh> meshes{own_mesh("bracket"),  own_mesh("plate"),   Mesh(),
                                   overlapping(),        thoroughly_broken(), broken_plane(),
                                   cracked_and_hanging()};
    for (const Mesh& mesh : meshes) {
        for (const std::string& line : lines_of(text(mesh)))
            EXPECT_LE(line.size(), 100U + std::string("part").size()) << line;
    }
    CheckReport wide = with_finding(DefectKind::overlapping_cells, 1000, true);
    const Mesh::Index big = std::numeric_limits<Mesh::Index>::max();
    wide.defects[0].places.assign(20, {{big - 1, big}, {big - 2, big - 1, big}, "coplanar"});
    CellContact c;
    c.cells = {big - 1, big};
    c.common.point.fill(-1.2345678901234567e-300);
    c.common.exact = true;
    wide.contacts.assign(2, c);
    wide.contacts[1].common.exact = false;
    wide.contacts[1].common.fraction.fill("-" + std::string(79, '7'));
    for (const std::string& line : lines_of(text(wide, {}))) EXPECT_LE(line.size(), 100U) << line;
}

TEST(CheckTerminal, ConditionsSayHowOftenTheyFail) {
    const auto row = [](const std::string& shown, const std::string& start) {
        for (const std::string& line : lines_of(shown)) {
            if (line.rfind(start, 0) == 0) return line.substr(line.find_last_of(' ') + 1);
        }
        return std::string();
    };
    const std::string good = text(own_mesh("bracket"));
    for (const std::string name : {"P1 ", "P2 ", "P3 ", "P4 ", "    hence", "P5 "}) EXPECT_EQ(row(good, name), "ok");
    EXPECT_TRUE(contains(text(own_mesh("torus")), "not provided\n")) << "it has neither .neigh nor .face";
    const std::string bad = text(overlapping());
    EXPECT_EQ(row(bad, "P1 "), "ok");
    EXPECT_EQ(row(bad, "P2 "), "ok");
    EXPECT_EQ(row(bad, "P3 "), "3");
    EXPECT_EQ(row(bad, "P4 "), "2");
    EXPECT_EQ(row(bad, "    hence"), "1");
    EXPECT_EQ(row(text(with_finding(DefectKind::boundary_contact, 1000, true), {}), "P3 "), "1000");
    EXPECT_TRUE(contains(text(with_finding(DefectKind::boundary_contact, 1000, true), {}), ">= 1000"));
    Mesh no_mesh = pair_of_cells();
    no_mesh.cells.pop_back();
    EXPECT_EQ(row(text(no_mesh), "P1 "), "1");
    EXPECT_TRUE(contains(text(no_mesh), "not checked\n"));
    EXPECT_TRUE(contains(text(no_mesh), "(the number of vertex indices is not a multiple of the vertices of a cell)"));
    EXPECT_TRUE(contains(text(thoroughly_broken()), "P2 to P5 leave out cells with an invalid index"));
}

TEST(CheckReport, FieldsThatAreNotFinite) {
    Mesh mesh = pair_of_cells();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    mesh.point_fields = {{"T", 2, {1, nan, 2, -HUGE_VAL, 0, 0, 1, 1, nan, 0}}, {"whole", 1, {1, 2, 3, 4, 5}}};
    mesh.cell_fields = {{"k", 1, {HUGE_VAL, 2}}};
    const CheckReport report = check_mesh(mesh);
    EXPECT_TRUE(report.certified());
    for (const std::string& shown : {text(report, mesh), check_html(report, mesh, "part")}) {
        EXPECT_TRUE(contains(shown, "field T: 3 of 10 values are not finite")) << shown;
        EXPECT_TRUE(contains(shown, "field k of cells: 1 of 2 values is not finite")) << shown;
        EXPECT_FALSE(contains(shown, "whole"));
    }
    EXPECT_EQ(json(report)["not_finite"], Json::parse(R"([{"field": "T", "of": "nodes", "count": 3, "values": 10},
                              {"field": "k", "of": "cells", "count": 1, "values": 2}])"));
    EXPECT_EQ(json(check_mesh(pair_of_cells()))["not_finite"], Json::array());
}

TEST(CheckTerminal, LongListsAreCutAndSaySo) {
    Mesh mesh = own_mesh("cube-hole");
    for (std::size_t cell = 0; cell < 40; ++cell) std::swap(mesh.cells[4 * cell], mesh.cells[4 * cell + 1]);
    mesh.neighbours.clear();
    const std::string shown = text(mesh);
    EXPECT_TRUE(contains(shown, "certified: 1590 cells")) << "the order of corners does not matter";
    EXPECT_TRUE(
        contains(shown,
                 "Notes: these do not affect the certificate\nmixed_orientation           40  cells of the less "
                 "frequent orientation\n    cells 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, and 30 more\n    -> check --fix"));
    EXPECT_FALSE(contains(shown, "Defects and remedies"));
    const std::string more = text(with_finding(DefectKind::overlapping_cells, 1000, true), {});
    EXPECT_TRUE(contains(more,
                         "overlapping_cells      >= 1000  pairs of cells whose interiors meet\n    cells 0 and 1; "
                         "and more\n"));
    EXPECT_TRUE(contains(more, "NOT certified: at least 1000 pairs of cells overlap\n"));
}

TEST(CheckTerminal, AFoldedCellIsNotMendedByItsOrientation) {
    // Cell 1 with its apex pushed through the common facet: the order of its corners is wrong for that reason.
    Mesh mesh = pair_of_cells();
    mesh.points[14] = 0.125;
    EXPECT_TRUE(contains(text(mesh), "writes a copy with positive cells; this does not repair folded cells\n"))
        << text(mesh);
    mesh = pair_of_cells();
    std::swap(mesh.cells[0], mesh.cells[1]);
    EXPECT_TRUE(contains(text(mesh), "writes a copy with positive cells\n"));
}

TEST(CheckTerminal, WitnessesAreExactOrSayThatTheyAreRounded) {
    const std::string shown = text(overlapping());
    EXPECT_TRUE(contains(shown, "cells 0 and 1 overlap: (")) << shown;
    EXPECT_TRUE(contains(shown, "\n    (0x1."));
    EXPECT_FALSE(contains(shown, "rounded\n"));

    CheckReport r = with_finding(DefectKind::boundary_contact, 2);
    CellContact c;
    c.cells = {0, 1};
    c.dimension = 1;
    c.common.point = {1 / 3.0, 0.5, -2};
    c.common.fraction = {"1/3", "1/2", "-2"};
    r.contacts = {c};
    const std::string thirds = text(r, {});
    EXPECT_TRUE(contains(thirds,
                         "1 pair of cells that meet where they must not, each with a common point\n"
                         "cells 0 and 1 touch along a segment: (0.3333333333333333, 0.5, -2), rounded\n"
                         "    x = 1/3\n    y = 1/2\n    z = -2\n"))
        << thirds;
    EXPECT_FALSE(contains(thirds, "--json"));
    r.contacts[0].common.fraction[1] = std::string(300, '1') + "/" + std::string(99, '2');
    const std::string cut = text(r, {});
    EXPECT_TRUE(contains(cut, "    y = 111111111111111111111111...222222222222222222222222 (400 characters)\n"));
    EXPECT_TRUE(contains(cut, "--json FILE writes the fractions in full.\n"));
    r.contacts[0].dimension = 0;
    EXPECT_TRUE(contains(text(r, {}), "touch in a point"));
    r.contacts[0].dimension = 2;
    EXPECT_TRUE(contains(text(r, {}), "touch in an area"));
}

TEST(CheckTerminal, PlacesArePositionsWhateverTheFileCountsFrom) {
    EXPECT_TRUE(
        contains(text(own_mesh("bracket")), "numbered from 0 in file order (the file itself numbers from 1).\n"));
    EXPECT_TRUE(contains(text(own_mesh("torus")), "numbered from 0 in file order.\n"));
}

TEST(CheckTerminal, InThePlaneThereAreAreasAndHoles) {
    const std::string shown = text(own_mesh("plate"));
    EXPECT_FALSE(contains(shown, "volume"));
    EXPECT_FALSE(contains(shown, "tunnel"));
    EXPECT_FALSE(contains(shown, "dihedral"));
    EXPECT_TRUE(contains(shown, "\narea       1.8042"));
    EXPECT_TRUE(contains(shown, "domain     1 part, 1 hole\n"));
    EXPECT_TRUE(contains(text(broken_plane()), "cells 0 and 1 overlap: ("));
}

TEST(CheckTerminal, VolumesTellWhetherTheyAreEqual) {
    EXPECT_TRUE(contains(text(pair_of_cells()),
                         "0.3333333333333333 in the cells, 0.3333333333333333 inside the boundary: "
                         "exactly equal\n"));
    EXPECT_TRUE(contains(text(thoroughly_broken()), "NOT equal\n"));
}

TEST(CheckTerminal, DelaunayOnlyIfAsked) {
    const Mesh mesh = own_mesh("plate");
    EXPECT_FALSE(contains(text(checked(mesh), mesh), "Delaunay"));
    CheckReport r = checked(pair_of_cells(), true);
    ASSERT_TRUE(r.delaunay);
    EXPECT_TRUE(contains(text(r, {}), "Delaunay   1 interior facet tested: all are locally Delaunay"));
    *r.delaunay = {10, 2, 3, 0.25, 7, 11};
    EXPECT_TRUE(
        contains(text(r, {}),
                 "10 interior facets tested: 2 are not locally Delaunay; 3 cospherical\n"
                 "           worst: node 11 lies inside the circumsphere of cell 7, 0.25 of its radius deep\n"));
}

TEST(CheckTerminal, MeasuresHaveTheirWorstCell) {
    // Cell 1 is the flatter one.
    const Mesh mesh = tetrahedra({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -0.125}, {0, 1, 2, 3, 0, 2, 1, 4});
    Lines rows;
    for (const std::string& line : lines_of(text(mesh))) {
        if (line.size() == 79 && line.back() == '1' && line[77] == ' ') rows.push_back(line);
    }
    // All but the bits and the largest angle: both cells are right angled along the axes.
    EXPECT_EQ(rows.size(), 4U);
    const std::string flat = text(tetrahedra({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, {0, 1, 2, 3}));
    EXPECT_TRUE(contains(flat, "         inf         inf         inf           0\n")) << flat;
}

TEST(CheckTerminal, ColourChangesNoLetter) {
    for (const Mesh& mesh : {own_mesh("bracket"), thoroughly_broken()}) {
        const CheckReport r = checked(mesh);
        std::string coloured = text(r, mesh, true);
        EXPECT_TRUE(contains(coloured, "\033["));
        for (std::size_t at; (at = coloured.find('\033')) != std::string::npos;)
            coloured.erase(at, coloured.find('m', at) - at + 1);
        EXPECT_EQ(coloured, text(r, mesh));
    }
}

TEST(CheckJson, SaysWhatTheReportSays) {
    const Mesh mesh = own_mesh("bracket");
    const CheckReport r = checked(mesh, true);
    const Json j = json(r);
    EXPECT_EQ(j["schema"], 1);
    EXPECT_EQ(j["mesh"], "part.1");
    EXPECT_EQ(j["verdict"], "certified");
    EXPECT_EQ(j["cells"], mesh.cell_count());
    EXPECT_EQ(j["nodes"], mesh.point_count());
    ASSERT_EQ(j["conditions"].size(), 5U);
    for (const Json& c : j["conditions"]) EXPECT_EQ(c["holds"], true);
    EXPECT_EQ(j["findings"].size(), r.defects.size());
    EXPECT_EQ(j["orientation"]["positive"], mesh.cell_count());
    EXPECT_EQ(j["volume"]["cells"], r.volume.cells);
    EXPECT_EQ(j["volume"]["equal"], true);
    EXPECT_EQ(j["boundary"]["tunnels"], 1);
    EXPECT_EQ(j["measures"]["min_angle"]["least"], distribution(r.measures.min_angle).min);
    EXPECT_EQ(j["measures"]["condition"]["most_cell"], distribution(r.measures.condition).max_cell);
    EXPECT_EQ(j["delaunay"]["facets"], r.delaunay->facets);
    EXPECT_FALSE(json(checked(mesh)).contains("delaunay"));
    for (std::size_t i = 0; i < defect_kind_count; ++i)
        EXPECT_EQ(j["problem_bits"][i], defect_text(static_cast<DefectKind>(i)).name);
    EXPECT_EQ(defect_bit(DefectKind::degenerate_cell), 1U << 4U) << "position i is bit i";
    EXPECT_EQ(j["problem_bits"][4], "degenerate_cell");
}

TEST(CheckJson, FindingsAndContactsStandWhole) {
    const CheckReport r = checked(thoroughly_broken());
    const Json j = json(r);
    EXPECT_EQ(j["verdict"], "not certified");
    ASSERT_EQ(j["findings"].size(), r.defects.size());
    for (std::size_t i = 0; i < r.defects.size(); ++i) {
        const Defect& f = r.defects[i];
        const Json& w = j["findings"][i];
        EXPECT_EQ(w["name"], defect_text(f.kind).name);
        EXPECT_EQ(w["count"], f.count);
        EXPECT_EQ(w["at_least"], f.at_least);
        ASSERT_EQ(w["places"].size(), f.places.size());
        for (const Json& place : w["places"]) {
            for (const Json& cell : place["cells"]) EXPECT_GE(cell, 0) << "unused entries are left out";
        }
    }
    ASSERT_EQ(j["contacts"].size(), r.contacts.size());
    for (std::size_t i = 0; i < r.contacts.size(); ++i) {
        const Json& w = j["contacts"][i]["witness"];
        EXPECT_EQ(w["exact"], r.contacts[i].common.exact);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(base::parse_double(w["hex"][k].get<std::string>()), r.contacts[i].common.point[k]);
            EXPECT_EQ(base::parse_double(w["decimal"][k].get<std::string>()), r.contacts[i].common.point[k]);
            EXPECT_EQ(w["fraction"][k], r.contacts[i].common.fraction[k]);
        }
    }
    EXPECT_EQ(json(with_finding(DefectKind::overlapping_cells, 1000, true))["findings"][0]["at_least"], true);
}

/// No null but where it says something, and no number that JSON has not.
void expect_numbers(const Json& value, const std::string& where) {
    if (value.is_structured()) {
        for (const auto& [key, inner] : value.items()) expect_numbers(inner, where + "." + key);
    } else if (value.is_number_float()) {
        EXPECT_TRUE(std::isfinite(value.get<double>())) << where;
    } else {
        EXPECT_FALSE(value.is_null()) << where;
    }
}

TEST(CheckJson, KnowsNoNanAndDoesNotHideInfinity) {
    const Json flat = json(checked(tetrahedra({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, {0, 1, 2, 3})));
    EXPECT_EQ(flat["measures"]["condition"]["most"], std::numeric_limits<double>::max());
    EXPECT_EQ(flat["measures"]["aspect"]["most"], std::numeric_limits<double>::max());
    EXPECT_EQ(flat["measures"]["volume"]["most"], 0);
    Json whole = json(checked(thoroughly_broken(), true));
    whole["boundary"].erase("tunnels");  // null: there are no such numbers
    whole["boundary"].erase("cavities");
    whole["delaunay"].erase("worst_cell");
    whole["delaunay"].erase("worst_node");
    expect_numbers(whole, "report");
    Mesh far = pair_of_cells();
    far.points[0] = std::numeric_limits<double>::quiet_NaN();
    const Json nowhere = json(checked(far));
    for (const Json& measure : nowhere["measures"]) EXPECT_TRUE(measure.is_null()) << "no cell has a place in space";
    EXPECT_FALSE(contains(nowhere.dump(), "nan"));
}

TEST(CheckJson, ANameThatIsNoUtf8IsNoCrash) {
    EXPECT_TRUE(contains(check_json(checked(pair_of_cells()), "\xff", measure_environment()), "\xef\xbf\xbd"));
}

}  // namespace
}  // namespace barycert::report_test

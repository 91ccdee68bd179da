// barycert sample: tables of points and rows: which columns are what, columns that are carried through, rows that are
// points again, fields from columns, notes.

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

class Tables : public ::testing::Test {
protected:
    Words line(const std::string& points, const Words& more = {}) const {
        return plus({"sample", two, "--points", points, "--fields", "attribute0", "--output", "-", "--quiet"}, more);
    }
    /// The rows on stdout.
    std::string rows(const std::string& points, const Words& more = {}) const {
        const Ended r = run(line(points, more));
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(r.err, "");
        return r.out;
    }
    Scratch scratch;
    std::string two = put_two_cells(scratch);
};

TEST_F(Tables, ColumnsAreCarriedThrough) {
    const std::string points =
        scratch.put("p.csv", "id,x,y,z,name\n007,.25,.25,.25,\"a, b\"\n12,2,2,2,\n9,.25,.25,.5, c \n");
    EXPECT_EQ(rows(points, {"--keep", "id,name"}),
              "x,y,z,cell,feature,attribute0,id,name\n0.25,0.25,0.25,0,interior,4.5,007,\"a, b\"\n"
              "2,2,2,-1,outside,nan,12,\n0.25,0.25,0.5,0,face,6.5,9,c\n");
    EXPECT_EQ(rows(points, {"--keep", "who=name", "--outside", "nearest"}),
              "x,y,z,cell,feature,attribute0,distance,who\n0.25,0.25,0.25,0,interior,4.5,0,\"a, b\"\n"
              "2,2,2,-1,outside,15,1.7320508075688772,\n0.25,0.25,0.5,0,face,6.5,0,c\n");
    EXPECT_EQ(rows(points, {"--keep", "id", "--on-boundary", "all"}),
              "x,y,z,cell,feature,attribute0,id\n0.25,0.25,0.25,0,interior,4.5,007\n2,2,2,-1,outside,nan,12\n"
              "0.25,0.25,0.5,0,face,6.5,9\n0.25,0.25,0.5,1,face,6.5,9\n");
    const Ended piped = run_shell(
        "cat p.csv | barycert sample two --points - --output - --fields attribute0 --keep id "
        "--quiet | cut -d, -f7 | tr '\\n' ' '",
        {.folder = scratch.folder()});
    EXPECT_EQ(piped.out, "id 007 12 9 ");
    // Rows of another run: what they have in common is not carried through, and told.
    const std::string before = scratch.put("before.csv", rows(points, {"--keep", "id"}));
    EXPECT_EQ(rows(before, {"--keep", "all"}),
              "x,y,z,cell,feature,attribute0,id\n0.25,0.25,0.25,0,interior,4.5,007\n2,2,2,-1,outside,nan,12\n"
              "0.25,0.25,0.5,0,face,6.5,9\n");
    const Ended told = run({"sample", two, "--points", before, "--keep", "all", "--output", scratch.path("r.csv")});
    EXPECT_TRUE(contains(told.err + told.out,
                         "left out: columns cell,feature,attribute0: the rows have columns of these names; "
                         "--keep OTHER=cell carries one through under another name"))
        << told.err << told.out;
    expect_error(line(points, {"--keep", "ids"}), "p.csv:1: no such column: expected \"ids\", found \"id\", \"x\"");
    expect_error(line(points, {"--keep", "cell=id"}),
                 "a column to keep has the name of another column of the rows: found \"cell\"");
    expect_error(line(points, {"--keep", "attribute0=id"}), "has the name of another column of the rows");
    expect_error({"sample", two, "--map", scratch.put("m", "x"), "--keep", "id", "--output", "-"},
                 "--keep cannot be combined with --map");
    expect_error({"sample", two, "--points", "-", "--keep", "id", "--output", scratch.path("r.npy")},
                 "standard input: the types of columns cannot be found in a stream");
}

TEST_F(Tables, ManyBlocksKeepTheirColumns) {
    ASSERT_EQ(run_shell("awk -v OFS=, 'BEGIN { print \"n,x,y,z\"; for (i = 0; i < 300000; ++i) print i, (i % 97) / 90, "
                        "(i % 89) / 88, "
                        "(i % 83) / 82 }' > p.csv",
                        {.folder = scratch.folder()})
                  .code,
              0);
    for (const std::string all : {"lowest", "all"}) {
        const Ended r = run_shell(
            "barycert sample two --points p.csv --keep n --fields attribute0 --on-boundary " + all +
                " --output r.csv --quiet && awk -F, -v last=-1 'NR > 1 && $7 != last { if ($7 != k++) bad = 1 } "
                "NR > 1 { last = $7; if ($1 - ($7 % 97) / 90 > 1e-5) bad = 1 } END { print k, bad + 0 }' "
                "r.csv",
            {.folder = scratch.folder()});
        EXPECT_EQ(r.out, "300000 0\n") << all << r.err;
    }
}

TEST_F(Tables, WhatComesOutGoesInAgain) {
    const std::string points = scratch.put("p.csv", six_points);
    for (const std::string file : {"r.csv", "r.npy", "r.vtu"}) {
        const std::string out = scratch.path(file), again = scratch.path("again-" + file);
        const Words common{"--fields", "attribute0", "--quiet"};
        ASSERT_EQ(run(plus({"sample", two, "--points", points, "--output", out}, common)).code, 0);
        const Ended r = run(plus({"sample", two, "--points", out, "--output", again}, common));
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_TRUE(read_file(again) == read_file(out)) << file;
        EXPECT_EQ(rows(out), six_rows) << file;
    }
    // With columns, over every format and back.
    const std::string source =
        scratch.put("q.csv", "id,x,y,z,t,name\n1,.25,.25,.25,0.5,a\n-7,.5,.5,.5,1e300,\xC3\xA4 b\n");
    const Words keep{"--keep", "id,t,name", "--fields", "attribute0", "--quiet"};
    const std::string csv = scratch.path("k.csv"), npy = scratch.path("k.npy"), back = scratch.path("back.csv");
    ASSERT_EQ(run(plus({"sample", two, "--points", source, "--output", npy}, keep)).code, 0);
    ASSERT_EQ(run(plus({"sample", two, "--points", source, "--output", csv}, keep)).code, 0);
    ASSERT_EQ(run(plus({"sample", two, "--points", npy, "--output", back}, keep)).code, 0);
    EXPECT_EQ(read_file(back),
              "x,y,z,cell,feature,attribute0,id,t,name\n0.25,0.25,0.25,0,interior,4.5,1,0.5,a\n"
              "0.5,0.5,0.5,1,interior,8,-7,1e+300,\xC3\xA4 b\n");
    const std::string vtu = scratch.path("k.vtu"), from_vtu = scratch.path("k3.npy");
    ASSERT_EQ(run(plus({"sample", two, "--points", npy, "--output", vtu}, keep)).code, 0);
    ASSERT_EQ(run(plus({"sample", two, "--points", vtu, "--output", from_vtu}, keep)).code, 0);
    EXPECT_TRUE(read_file(from_vtu) == read_file(npy));
    EXPECT_EQ(rows(vtu, {"--keep", "id,name,t"}).substr(0, 45), "x,y,z,cell,feature,attribute0,id,name,t\n0.25,");
    EXPECT_EQ(rows(vtu), rows(npy)) << "columns that are not kept need not be read";
    const std::string npy2 = scratch.path("k2.npy");
    ASSERT_EQ(run(plus({"sample", two, "--points", back, "--output", npy2}, keep)).code, 0);
    EXPECT_TRUE(read_file(npy2) == read_file(npy));
    EXPECT_TRUE(contains(read_file(npy), "('id', '<i8'), ('t', '<f8'), ('name', '<U3')"));
}

TEST_F(Tables, NothingIsGuessedOfColumns) {
    const std::string four = scratch.put("four.csv", "7,.25,.25,.25\n8,2,2,2\n");
    expect_error(line(four),
                 "error: " + four +
                     ":1: it is not clear which columns are the coordinates: expected 3 columns, or names "
                     "for them, found 4 columns without names; say which: --columns 1,2,3, or --columns 2,3,4");
    EXPECT_EQ(rows(four, {"--columns", "2,3,4", "--keep", "id=column1"}),
              "x,y,z,cell,feature,attribute0,id\n0.25,0.25,0.25,0,interior,4.5,7\n2,2,2,-1,outside,nan,8\n");
    const std::string named = scratch.put("named.csv", "lon,lat,depth\n.25,.25,.25\n");
    expect_error(line(named), "found \"lon\", \"lat\", \"depth\"; say which they are, such as --columns lon,lat,depth");
    const std::string one = "x,y,z,cell,feature,attribute0\n0.25,0.25,0.25,0,interior,4.5\n";
    EXPECT_EQ(rows(named, {"--columns", "lon,lat,depth"}), one);
    EXPECT_EQ(rows(named, {"--columns", "1,2,3"}), one);
    EXPECT_EQ(rows(named, {"--columns", "lon", "--columns", "lat", "--columns", "depth"}), one);
    // A mesh in the plane.
    scratch.put("flat.node", "3 2 1 0\n0 0 0 1\n1 1 0 2\n2 0 1 3\n");
    scratch.put("flat.ele", "1 3\n0 0 1 2\n");
    const auto flat = [&](const std::string& points, const Words& more = {}) {
        return plus({"sample", scratch.path("flat"), "--output", "-", "--points", points}, more);
    };
    const std::string three = scratch.put("three.csv", "x,y,z\n.25,.25,0\n.5,.25,1\n");
    expect_error(flat(three),
                 "three.csv:3: a point off the plane z = 0: expected z = 0, for the mesh is 2D, found \"1\"; "
                 "--columns x,y leaves z out of account");
    EXPECT_EQ(run(flat(three, {"--columns", "x,y", "--quiet"})).out,
              "x,y,cell,feature,attribute0\n0.25,0.25,0,interior,1.75\n0.5,0.25,0,interior,2\n");
    const Ended zero = run(flat(scratch.put("zero.csv", "x,y,z\n.25,.25,0\n")));
    EXPECT_EQ(zero.code, 0);
    EXPECT_TRUE(contains(zero.err, "zero.csv: left out: column z, which must be 0 throughout")) << zero.err;
    expect_error(flat(scratch.put("plain.csv", ".25,.25,0\n")), "it is not clear which columns");
}

TEST_F(Tables, NotesAreTold) {
    const std::string points = scratch.put("p.csv", "id;x;y;z\n1;.25;.25;.25\n"), json = scratch.path("j");
    const Ended r = run({"sample", two, "--points", points, "--output", scratch.path("r.csv"), "--json", json});
    EXPECT_EQ(r.err, "") << "none is important";
    EXPECT_TRUE(contains(r.out, "note       " + points + ": guessed: columns are separated by semicolons\n")) << r.out;
    EXPECT_TRUE(contains(r.out, "note       " + points + ": left out: column id; --keep id carries it through\n"));
    const auto j = parse(read_file(json));
    ASSERT_EQ(j["notes"].size(), 2U);
    EXPECT_EQ(j["notes"][0]["kind"], "guessed");
    EXPECT_EQ(j["notes"][1]["text"], "column id; --keep id carries it through");
    EXPECT_EQ(j["notes"][1]["file"], points);
    EXPECT_EQ(j["carried"].size(), 0U);
    const Ended kept =
        run({"sample", two, "--points", points, "--output", "-", "--json", json, "--keep", "id", "--quiet"});
    EXPECT_EQ(kept.err, "");
    EXPECT_EQ(parse(read_file(json))["carried"][0], "id");
}

TEST_F(Tables, FieldsFromColumns) {
    const std::string points = scratch.put("p.csv", ".25 .25 .25\n");
    const auto value = [&](const std::string& field, const std::string& option = "--field") {
        const Ended r =
            run({"sample", two, "--points", points, "--output", "-", "--quiet", option, "t=" + field, "--fields", "t"});
        EXPECT_EQ(r.code, 0) << r.err;
        const Words all = lines_of(r.out);
        return all.size() == 2 ? all[1].substr(26) : r.err;
    };
    const auto refused = [&](const std::string& field, const std::string& says) {
        expect_error({"sample", two, "--points", points, "--output", "-", "--field", "t=" + field, "--fields", "t"},
                     says);
    };
    const std::string csv = scratch.put(
        "f.csv",
        "name;T;v.0;v.1;big\na;4;1;0;9007199254740993\nb;8;1;0;1\n\"c;c\";12;1;0;1\n\nd;16;1;0;1\ne;20;1;0;1\n");
    EXPECT_EQ(value(csv + ":T"), "10");
    EXPECT_EQ(value(csv + ":2"), "10");
    EXPECT_EQ(value(csv + ":v"), "1,0");
    EXPECT_EQ(value(csv + ":T", "--point-field"), "10");
    refused(csv + ":U", "f.csv:1: no such column: expected \"U\", found \"name\", \"T\", \"v.0\", \"v.1\", \"big\"");
    refused(csv + ":6", "no such column");
    refused(csv + ":name", "f.csv:2: a value of field \"t\": expected a number, found \"a\"");
    refused(csv + ":big", "f.csv:2: a value of field \"t\": expected an integer that a double holds exactly");
    refused(csv, "name a column of the header: --field t=" + csv + ":name");
    refused(scratch.path("none.csv") + ":T", "none.csv: cannot read the file");
    refused(scratch.put("cut.csv", "a,T\n1,4\n1,8\n1,12\n1,16\n1,2"), "expected numbers");
    refused(scratch.path("cut.csv") + ":T", "cut.csv:6: the last row has no line end");
    refused(scratch.put("short.csv", "a,T\n1,4\n1\n") + ":T", "short.csv:3: too few fields in a line");
    refused(scratch.put("int.txt", "1\n2\n9007199254740993\n3\n4\n"),
            "int.txt:3: a row of field \"t\": expected an integer that a double holds exactly");
    // A colon may belong to the name of a file.
    EXPECT_EQ(value(scratch.put("a:T", "4\n8\n12\n16\n20\n")), "10");
    EXPECT_EQ(value(scratch.put("b:c.csv", "x:y\n4\n8\n12\n16\n20\n") + ":x:y"), "10");
    // A structured array: the rows of a run, at the nodes.
    const std::string npy = scratch.path("n.npy");
    ASSERT_EQ(run({"sample", two, "--points", scratch.path("two.node"), "--output", npy, "--quiet"}).code, 0);
    EXPECT_EQ(value(npy + ":attribute0"), "4.5");
    EXPECT_EQ(value(npy + ":cell"), "0");
    refused(npy, "the type of field \"t\": expected an array of numbers, found a structured array of \"x\", \"y\"");
    refused(npy + ":feature", "the type of field \"t\"");
    // Another mesh with as many nodes.
    scratch.put("same.node", "5 3 1 0\n0 0 0 0 2\n1 1 0 0 2\n2 0 1 0 2\n3 0 0 1 2\n4 1 1 1 2\n");
    scratch.put("same.ele", "2 4 1\n0 0 1 2 3 5\n1 1 2 3 4 6\n");
    const std::string same = scratch.path("same.node");
    expect_error({"sample", two, "--points", points, "--output", "-", "--field", "t=" + same + ":attribute0"},
                 "there is an array of nodes and one of cells of that name");
    EXPECT_EQ(value(same + ":attribute0", "--point-field"), "2");
    EXPECT_EQ(value(same + ":attribute0", "--cell-field"), "5");
    refused(same + ":T", "no such array: expected \"T\", found of nodes \"attribute0\"; of cells \"attribute0\"");
    refused(same, "it is not said which array of the file is meant: found of nodes \"attribute0\"");
    scratch.put("moved.node", "5 3 1 0\n0 0 0 1 2\n1 1 0 0 2\n2 0 1 0 2\n3 0 0 2 2\n4 1 1 1 2\n");
    scratch.put("moved.ele", "1 4\n0 0 1 2 3\n");
    const std::string moved = scratch.path("moved.node");
    const Ended told = run({"sample", two, "--points", points, "--output", scratch.path("r.csv"), "--field",
                            "t=" + moved + ":attribute0"});
    EXPECT_EQ(told.code, 0);
    EXPECT_EQ(told.err, "note: " + moved +
                            ": guessed: the nodes are in the order of the mesh, whose coordinates or cells "
                            "are others: field t\n");
    EXPECT_EQ(
        run({"sample", two, "--points", points, "--output", "-", "--field", "t=" + moved + ":attribute0", "--quiet"})
            .err,
        "");
    scratch.put("more.node", "6 3 1 0\n0 0 0 1 2\n1 1 0 0 2\n2 0 1 0 2\n3 0 0 2 2\n4 1 1 1 2\n5 0 0 0 0\n");
    scratch.put("more.ele", "1 4\n0 0 1 2 3\n");
    refused(scratch.path("more.node") + ":attribute0", "expected 5 rows, one for each node");
}

/// Two tetrahedra between a line and a triangle, which are no cells of the mesh; regions by name and by number.
std::string mixed_vtu() {
    return R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="5" NumberOfCells="4">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 0 1 2 3 0 1 2 1 2 3 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">2 6 9 13</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">3 10 5 10</DataArray></Cells>
<PointData><DataArray type="Float64" Name="T" format="ascii">1 3 5 9 15</DataArray></PointData>
<CellData><DataArray type="String" Name="material" format="ascii">97 0 115 116 101 101 108 0 98 0 105 44 110 0</DataArray>
<DataArray type="Int64" Name="tag" format="ascii">1 9007199254740993 3 -4</DataArray>
<DataArray type="Float64" Name="k" format="ascii">1 7 3 9</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>
)";
}

TEST_F(Tables, CellsHaveTheNumbersOfTheFileAndLabelsAreCarried) {
    const std::string mesh = scratch.put("m.vtu", mixed_vtu()), json = scratch.path("j");
    const std::string points = scratch.put("p.csv", "id,x,y,z\n7,.25,.25,.25\n8,2,2,2\n9,.5,.5,.5\n");
    const Ended r = run({"sample", mesh, "--points", points, "--fields", "T,material,tag", "--keep", "id", "--output",
                         scratch.path("r.csv"), "--json", json});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "note: " + mesh + ": left out: 2 cells that are no tetrahedra: 1 vtkLine, 1 vtkTriangle\n");
    EXPECT_TRUE(contains(r.out, "note       " + mesh + ": left out: 2 cells")) << r.out;
    EXPECT_EQ(read_file(scratch.path("r.csv")),
              "x,y,z,cell,feature,T,material,tag,id\n0.25,0.25,0.25,1,interior,4.5,steel,9007199254740993,7\n"
              "2,2,2,-1,outside,nan,,-9223372036854775808,8\n0.5,0.5,0.5,3,interior,8,\"i,n\",-4,9\n");
    const auto j = parse(read_file(json));
    EXPECT_EQ(j["carried"], nlohmann::json({"material", "tag", "id"}));
    EXPECT_TRUE(contains(j["notes"][0]["text"], "2 cells"));
    // Nothing named: every field, and a note of the labels.
    const Ended all = run({"sample", mesh, "--points", points, "--output", scratch.path("all.csv")});
    EXPECT_TRUE(contains(all.out, "left out: labels of cells material, tag; name fields and labels in --fields"))
        << all.out;
    EXPECT_EQ(lines_of(read_file(scratch.path("all.csv")))[0], "x,y,z,cell,feature,T,k");
    // Labels alone, in each format; outside a text is empty and an integer the smallest.
    for (const std::string out : {"l.npy", "l.vtu"}) {
        ASSERT_EQ(run({"sample", mesh, "--points", points, "--fields", "cell:tag,material", "--output",
                       scratch.path(out), "--quiet"})
                      .code,
                  0);
        EXPECT_EQ(
            rows(scratch.path(out), {"--keep", "c=cell,tag,material"}),
            "x,y,z,cell,feature,attribute0,c,tag,material\n0.25,0.25,0.25,0,interior,4.5,1,9007199254740993,steel\n"
            "2,2,2,-1,outside,nan,-1,-9223372036854775808,\n0.5,0.5,0.5,1,interior,8,3,-4,\"i,n\"\n")
            << out;
    }
    // A map has the mesh's own cells; rows from it those of the file.
    const std::string map = scratch.path("p.map");
    const Words fields{"--fields", "T,material", "--output", "-", "--quiet"};
    const Ended made = run(plus({"sample", mesh, "--points", points, "--save-map", map}, fields));
    EXPECT_EQ(run(plus({"sample", mesh, "--map", map}, fields)).out, made.out);
    EXPECT_TRUE(contains(made.out, ",3,interior,8,\"i,n\"\n")) << made.out;
    EXPECT_EQ(lines_of(run(plus({"sample", mesh, "--points", points, "--on-boundary", "all"}, fields)).out).size(), 4U);
    // Grids and other meshes.
    const Words grid{"resample", mesh, "--grid", "2x2x2", "--fields", "material,tag", "--quiet", "--output"};
    EXPECT_EQ(lines_of(run(plus(grid, {"-"})).out)[1], "0,0,0,1,vertex,steel,9007199254740993");
    expect_error(plus(grid, {scratch.path("g.npy")}), "the format has no place for a label of cells");
    expect_error(plus(grid, {scratch.path("g.vti")}), "the format has no place for a label of cells");
    EXPECT_EQ(
        run({"resample", mesh, "--grid", "2x2x2", "--fields", "tag", "--quiet", "--output", scratch.path("g.vti")})
            .code,
        0);
    EXPECT_TRUE(contains(read_file(scratch.path("g.vti")), "Int64\" Name=\"tag\""));
    const Words onto{"resample", mesh, "--onto", two, "--fields", "T,material", "--quiet", "--output"};
    EXPECT_EQ(lines_of(run(plus(onto, {"-"})).out)[5], "1,1,1,3,vertex,15,\"i,n\"");
    expect_error(plus(onto, {scratch.path("o.vtu")}), "a mesh has no labels of nodes");
    expect_error(plus({"sample", mesh, "--points", points, "--output", "-", "--fields"}, {"tag,tag"}),
                 "a label of cells is named twice");
    expect_error({"sample", mesh, "--points", points, "--output", "-", "--fields", "material", "--keep", "material=id"},
                 "a column to keep has the name of another column of the rows: found \"material\"");
    // Its arrays are fields of others.
    EXPECT_EQ(lines_of(run({"sample", two, "--points", points, "--field", "t=" + mesh + ":T", "--fields", "t",
                            "--output", "-", "--quiet"})
                           .out)[1],
              "0.25,0.25,0.25,0,interior,4.5");
    const std::string rows_vtu = scratch.path("nodes.vtu");
    ASSERT_EQ(run({"sample", mesh, "--points", two + ".node", "--output", rows_vtu, "--quiet"}).code, 0);
    EXPECT_EQ(lines_of(run({"sample", two, "--points", points, "--field", "t=" + rows_vtu + ":T", "--fields", "t",
                            "--output", "-", "--quiet"})
                           .out)[1],
              "0.25,0.25,0.25,0,interior,4.5")
        << "points without cells";
}

TEST_F(Tables, TextsMoveNoCursorOfATerminal) {
    const std::string points = scratch.put("p.csv", "x,y,z,\"n\x1b[2J\"\n.25,.25,.25,a\x1b]0;b\x07\n");
    const Ended r = run({"sample", two, "--points", points, "--keep", "all", "--output", "-"}, {.terminal = true});
    EXPECT_EQ(r.code, 0) << r.out;
    EXPECT_FALSE(contains(r.out, "a\x1b")) << r.out;
    EXPECT_TRUE(contains(r.out, "a\\x1b]0;b\\x07")) << r.out;
    EXPECT_TRUE(contains(rows(points, {"--keep", "all"}), "a\x1b]0;b\x07")) << "a file has what there is";
}

TEST_F(Tables, NodesOfMeshesArePoints) {
    const std::string nodes = scratch.path("two.node");
    const std::string expected =
        "x,y,z,cell,feature,attribute0,a\n0,0,0,0,vertex,1,1\n1,0,0,0,vertex,3,3\n0,1,0,0,vertex,5,5\n0,0,1,0,vertex,9,"
        "9\n"
        "1,1,1,1,vertex,15,15\n";
    for (const std::string& points : {nodes, two, scratch.path("two.ele")})
        EXPECT_EQ(rows(points, {"--keep", "a=attribute0"}), expected) << points;
}

}  // namespace
}  // namespace barycert::cli_test

/// Files that name files: partitioned data sets, blocks, series; and points of grids.
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

#include "tests/io/vtk/mesh_notes.hpp"

namespace barycert::testing {
namespace {

using Texts = std::vector<std::string>;

/// A tetrahedron on nodes at z = `z` and above; `more` goes into its point data.
std::string piece(double z, const std::string& more = "", const std::string& points = "<PointData>") {
    const std::string low = std::to_string(z), high = std::to_string(z + 1);
    return "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='4' NumberOfCells='1'>" + points +
           "<DataArray type='Float64' Name='T'>" + low + " 1 2 3</DataArray>" + more +
           "</PointData><CellData/><Points><DataArray type='Float64' NumberOfComponents='3'>0 0 " + low + " 1 0 " +
           low + " 0 1 " + low + " 0 0 " + high +
           "</DataArray></Points><Cells><DataArray type='Int64' Name='connectivity'>0 1 2 3</DataArray>"
           "<DataArray type='Int64' Name='offsets'>4</DataArray><DataArray type='UInt8' Name='types'>10</DataArray>"
           "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

std::string partitioned(const Texts& files) {
    std::string text = "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid GhostLevel='0'>";
    for (const std::string& file : files) text += "<Piece Source='" + file + "'/>";
    return text + "</PUnstructuredGrid></VTKFile>";
}

std::string ids(const std::string& numbers) {
    return "<DataArray type='Int64' Name='GlobalNodeId'>" + numbers + "</DataArray>";
}

TEST(VtkCollections, PiecesMakeOneMesh) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "m");
    put(folder / "m/0.vtu", piece(0));
    put(folder / "m/1.vtu", piece(1, "<DataArray type='Float64' Name='only'>1 2 3 4</DataArray>"));
    put(folder / "m.pvtu", partitioned({"m/0.vtu", "m/1.vtu"}));
    const Result<Mesh> mesh = read_mesh(folder / "m.pvtu");
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_EQ(mesh->cells, (std::vector<Mesh::Index>{0, 1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(mesh->points.size(), 24U);
    EXPECT_TRUE(mesh->cell_numbers.empty());
    ASSERT_EQ(mesh->point_fields.size(), 1U);
    EXPECT_EQ(mesh->point_fields[0].data, (std::vector<double>{0, 1, 2, 3, 1, 1, 2, 3}));
    EXPECT_EQ(notes_of(*mesh), (Texts{"point array \"only\": it is missing in a piece of the file"}));
    const Texts guessed = notes_of(*mesh, Note::Kind::guessed);
    ASSERT_EQ(guessed.size(), 1U);
    EXPECT_EQ(guessed[0].substr(0, 47), "1 nodes stand where another piece has one, and ");
    EXPECT_EQ(mesh_files(folder / "m.pvtu"), (Texts{folder / "m.pvtu", folder / "m/0.vtu", folder / "m/1.vtu"}));
    EXPECT_EQ(read_vtk_points(folder / "m.pvtu", 3).value(), mesh->points);
}

TEST(VtkCollections, NodesOfOneGlobalIdAreOne) {
    const TemporaryFolder folder;
    // The top of the first is the first node of the second. Its T differs there.
    put(folder / "0.vtu", piece(0, ids("10 11 12 13")));
    put(folder / "1.vtu", piece(1, ids("13 21 22 23")));
    put(folder / "m.pvtu", partitioned({"0.vtu", "1.vtu"}));
    const Result<Mesh> mesh = read_vtk(folder / "m.pvtu");
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_EQ(mesh->cells, (std::vector<Mesh::Index>{0, 1, 2, 3, 3, 4, 5, 6}));
    EXPECT_EQ(mesh->point_count(), 7U);
    EXPECT_EQ(mesh->point_fields[0].data, (std::vector<double>{0, 1, 2, 3, 1, 2, 3}));
    EXPECT_EQ(notes_of(*mesh, Note::Kind::converted).size(), 1U);
    ASSERT_EQ(notes_of(*mesh).size(), 1U);
    EXPECT_EQ(notes_of(*mesh)[0].substr(0, 24), "values at 1 of these nod");
    // The attribute names the array; nodes elsewhere are kept apart.
    const std::string attribute = "<PointData GlobalIds='n'>";
    put(folder / "0.vtu", piece(0,
                                "<DataArray type='Int32' Name='GlobalNodeId'>1 1 1 1</DataArray>"
                                "<DataArray type='Int64' Name='n'>1 2 3 4</DataArray>",
                                attribute));
    put(folder / "1.vtu", piece(1,
                                "<DataArray type='Int32' Name='GlobalNodeId'>1 1 1 1</DataArray>"
                                "<DataArray type='Int64' Name='n'>5 2 6 7</DataArray>",
                                attribute));
    const Result<Mesh> apart = read_vtk(folder / "m.pvtu");
    ASSERT_TRUE(apart) << apart.error().message();
    EXPECT_EQ(apart->point_count(), 8U);
    EXPECT_EQ(notes_of(*apart, Note::Kind::guessed)[0].substr(0, 24), "1 nodes are kept apart t");
}

TEST(VtkCollections, BlocksAndSeries) {
    const TemporaryFolder folder;
    put(folder / "0.vtu", piece(0));
    put(folder / "1.vtu", piece(5));
    put(folder / "m.vtm",
        "<VTKFile type='vtkMultiBlockDataSet'><vtkMultiBlockDataSet><Block index='0' name='solids'>"
        "<DataSet index='0' name='a' file='0.vtu'/><DataSet index='1' name='b' file='1.vtu'/></Block>"
        "<DataSet index='1' name='walls' file='walls.vtp'/><DataSet index='2'/></vtkMultiBlockDataSet></VTKFile>");
    const Result<Mesh> blocks = read_vtk(folder / "m.vtm");
    ASSERT_TRUE(blocks) << blocks.error().message();
    EXPECT_EQ(blocks->cell_count(), 2U);
    ASSERT_EQ(notes_of(*blocks).size(), 1U);
    EXPECT_EQ(notes_of(*blocks)[0], "1 blocks beside those with the mesh: \"walls (" + folder / "walls.vtp" + ")\"");
    EXPECT_TRUE(blocks->notes[0].important);
    EXPECT_TRUE(notes_of(*blocks, Note::Kind::guessed).empty());  // they do not touch

    put(folder / "m.pvd",
        "<VTKFile type='Collection'><Collection><DataSet timestep='0.5' part='0' file='0.vtu'/>"
        "<DataSet timestep='0.5' part='1' file='1.vtu'/><DataSet timestep='1e1' "
        "file='/x/y.vtu'/></Collection></VTKFile>");
    const Result<std::vector<SeriesStep>> steps = read_series(folder / "m.pvd");
    ASSERT_TRUE(steps) << steps.error().message();
    ASSERT_EQ(steps->size(), 2U);
    EXPECT_EQ((*steps)[0].time, 0.5);
    EXPECT_EQ((*steps)[0].files, (Texts{folder / "0.vtu", folder / "1.vtu"}));
    EXPECT_EQ((*steps)[1].time, 10);
    EXPECT_EQ((*steps)[1].files, (Texts{"/x/y.vtu"}));
    const Result<Mesh> first = read_vtk(folder / "m.pvd");
    ASSERT_TRUE(first) << first.error().message();
    EXPECT_EQ(first->cell_count(), 2U);
    EXPECT_EQ(notes_of(*first), (Texts{"all steps but the first of a series of 2: read is the time 0.5"}));
    EXPECT_TRUE(first->notes[0].important);
    // A series as ParaView writes it has one file a step.
    put(folder / "m.vtu.series",
        "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n    { \"name\" : \"0.vtu\", \"time\" : 0.5 },\n"
        "    { \"name\" : \"1.vtu\", \"time\" : 0.75 },\n    { \"name\" : \"/x/y.vtu\", \"time\" : 10 }\n  ]\n}\n");
    const Result<std::vector<SeriesStep>> same = read_series(folder / "m.vtu.series");
    ASSERT_TRUE(same) << same.error().message();
    ASSERT_EQ(same->size(), 3U);
    EXPECT_EQ((*same)[1].time, 0.75);
    EXPECT_EQ((*same)[1].files, (Texts{folder / "1.vtu"}));
    EXPECT_EQ((*same)[2].files, (Texts{"/x/y.vtu"}));
    const Result<Mesh> too = read_mesh(folder / "m.vtu.series");
    ASSERT_TRUE(too) << too.error().message();
    EXPECT_EQ(too->cell_count(), 1U);
    EXPECT_EQ(notes_of(*too), (Texts{"all steps but the first of a series of 3: read is the time 0.5"}));
    EXPECT_EQ(mesh_files(folder / "m.vtu.series"),
              (Texts{folder / "m.vtu.series", folder / "0.vtu", folder / "1.vtu", "/x/y.vtu"}));
    EXPECT_FALSE(read_series(folder / "m.vtm"));
    EXPECT_FALSE(read_series(folder / "none.pvd"));
}

TEST(VtkCollections, AStepIsChosen) {
    const TemporaryFolder folder;
    for (const int k : {0, 1, 2}) put(folder / (std::to_string(k) + ".vtu"), piece(k));
    put(folder / "m.pvd",
        "<VTKFile type='Collection'><Collection><DataSet timestep='0.5' file='0.vtu'/>\n<DataSet timestep='1' "
        "file='1.vtu'/>\n<DataSet timestep='1' part='1' file='2.vtu'/><DataSet timestep='3' file='0.vtu'/>\n"
        "<DataSet timestep='4' file='none.vtu'/></Collection></VTKFile>");
    const std::string path = folder / "m.pvd";
    const auto read = [&](const StepChoice& step) { return read_mesh(path, {.step = step}); };
    const Result<Mesh> one = read({.number = 1}), at = read({.time = 1.0});
    ASSERT_TRUE(one) << one.error().message();
    ASSERT_TRUE(at) << at.error().message();
    EXPECT_EQ(one->cell_count(), 2U);
    EXPECT_EQ(at->points, one->points);
    EXPECT_EQ(notes_of(*one), Texts{});
    EXPECT_EQ(notes_of(*at), (Texts{"all steps but number 1 of a series of 4: read is the time 1"}));
    for (const Note& note : at->notes) EXPECT_TRUE(note.kind != Note::Kind::left_out || !note.important) << note.text;
    const Result<Mesh> no_number = read({.number = 4}), no_time = read({.time = 2.0});
    ASSERT_FALSE(no_number);
    EXPECT_EQ(no_number.error().expected, "a number from 0 to 3");
    ASSERT_FALSE(no_time);
    EXPECT_EQ(no_time.error().expected, "one of the times 0.5, 1, 3, 4");
    // The error names the file that is missing, and where it is named.
    const Result<Mesh> last = read({.last = true});
    ASSERT_FALSE(last);
    EXPECT_EQ(last.error().file, path);
    EXPECT_EQ(last.error().line, 4U);
    EXPECT_EQ(last.error().expected, folder / "none.vtu");
    // No step can be chosen where there is no series.
    put(folder / "m.pvtu", partitioned({"0.vtu"}));
    EXPECT_FALSE(read_mesh(folder / "m.pvtu", {.step = {.number = 0}}));
    EXPECT_FALSE(read_mesh(folder / "0.vtu", {.step = {.last = true}}));
}

TEST(VtkCollections, PolygonDataAreTheMeshWhereThereIsNoOther) {
    const TemporaryFolder folder;
    put(folder / "s.vtp",
        "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='3' NumberOfPolys='1'><Points><DataArray "
        "type='Float64' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray type='Int64' "
        "Name='connectivity'>0 1 2</DataArray><DataArray type='Int64' Name='offsets'>3</DataArray></Polys></Piece>"
        "</PolyData></VTKFile>");
    put(folder / "0.vtu", piece(0));
    put(folder / "s.pvd",
        "<VTKFile type='Collection'><Collection><DataSet timestep='0' file='s.vtp'/></Collection></VTKFile>");
    put(folder / "s.vtp.series", "{\"files\": [{\"name\": \"s.vtp\", \"time\": 0}]}");
    const auto blocks = [](const std::string& files) {
        return "<VTKFile type='vtkMultiBlockDataSet'><vtkMultiBlockDataSet>" + files +
               "</vtkMultiBlockDataSet></VTKFile>";
    };
    put(folder / "s.vtm", blocks("<DataSet index='0' file='s.vtp'/><DataSet index='1' file='none.pvti'/>"));
    put(folder / "s.pvtp", "<VTKFile type='PPolyData'><PPolyData><Piece Source='s.vtp'/></PPolyData></VTKFile>");
    put(folder / "outer.vtm", blocks("<DataSet index='0' file='s.pvtp'/>"));
    const Result<Mesh> alone = read_mesh(folder / "s.vtp");
    ASSERT_TRUE(alone) << alone.error().message();
    for (const std::string name : {"s.pvd", "s.vtp.series", "s.vtm", "s.pvtp", "outer.vtm"}) {
        const Result<Mesh> mesh = read_mesh(folder / name);
        ASSERT_TRUE(mesh) << name << mesh.error().message();
        EXPECT_EQ(mesh->cells, alone->cells) << name;
        EXPECT_EQ(mesh->points, alone->points) << name;
    }
    // Beside a mesh they are left out, also those that are named further down.
    put(folder / "both.vtm", blocks("<DataSet index='0' file='0.vtu'/><DataSet index='1' file='s.vtm'/>"));
    const Result<Mesh> both = read_mesh(folder / "both.vtm");
    ASSERT_TRUE(both) << both.error().message();
    EXPECT_EQ(both->point_count(), 4U);
}

/// Two pixels, in the plane z = 0, or along other axes.
std::string image(const std::string& extent = "0 2 0 1 0 0") {
    return "<VTKFile type='ImageData'><ImageData WholeExtent='" + extent + "'><Piece Extent='" + extent +
           "'/></ImageData></VTKFile>";
}

TEST(VtkCollections, StructuredGridsAreTheMeshWhereNoneIsUnstructured) {
    const TemporaryFolder folder;
    put(folder / "g.vti", image());
    put(folder / "h.vtr",
        "<VTKFile type='RectilinearGrid'><RectilinearGrid WholeExtent='0 1 0 1 0 0'><Piece Extent='0 1 0 1 0 "
        "0'><Coordinates><DataArray type='Float64'>5 6</DataArray><DataArray type='Float64'>0 2</DataArray><DataArray "
        "type='Float64'>0</DataArray></Coordinates></Piece></RectilinearGrid></VTKFile>");
    put(folder / "s.vtp", "no file of VTK");
    put(folder / "0.vtu", piece(0));
    const auto read = [&](const Texts& files) {
        std::string text = "<VTKFile type='vtkMultiBlockDataSet'><vtkMultiBlockDataSet>";
        for (const std::string& file : files) text += "<DataSet file='" + file + "'/>";
        put(folder / "m.vtm", text + "</vtkMultiBlockDataSet></VTKFile>");
        return read_vtk(folder / "m.vtm");
    };
    const auto left_out = [&](const Texts& files) {
        std::string text = std::to_string(files.size()) + " blocks beside those with the mesh: ";
        for (std::size_t i = 0; i < files.size(); ++i) text += (i == 0 ? "\"" : ", \"") + folder / files[i] + "\"";
        return Texts{text};
    };
    const Result<Mesh> grids = read({"s.vtp", "g.vti", "h.vtr", "none.pvtr"});
    ASSERT_TRUE(grids) << grids.error().message();
    EXPECT_EQ(notes_of(*grids), left_out({"s.vtp", "none.pvtr"}));
    EXPECT_EQ(grids->shapes.types, (std::vector<std::uint8_t>{8, 8, 8}));
    EXPECT_EQ(grids->shapes.nodes, (std::vector<Mesh::Index>{0, 1, 3, 4, 1, 2, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(grids->point_count(), 10U);
    EXPECT_EQ(grids->points[12], 5);
    // Beside an unstructured grid they are left out.
    const Result<Mesh> both = read({"g.vti", "0.vtu", "s.vtp"});
    ASSERT_TRUE(both) << both.error().message();
    EXPECT_EQ(notes_of(*both), left_out({"g.vti", "s.vtp"}));
    EXPECT_EQ(both->point_count(), 4U);
    EXPECT_TRUE(both->shapes.types.empty());
    // One that is missing is an error, where it is the mesh.
    const Result<Mesh> missing = read({"g.vti", "none.vts"});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().what, "a file that is named here is missing");
    EXPECT_EQ(missing.error().expected, folder / "none.vts");
}

TEST(VtkCollections, ASeriesFileThatIsWrong) {
    const TemporaryFolder folder;
    const std::string whole = "{\"files\": [{\"name\": \"0.vtu\", \"time\": 0.5}]}";
    put(folder / "s.vtu.series", whole);
    EXPECT_TRUE(read_series(folder / "s.vtu.series"));
    // Cut off anywhere it is no JSON.
    for (std::size_t size = 1; size < whole.size(); ++size) {
        put(folder / "s.vtu.series", whole.substr(0, size));
        EXPECT_FALSE(read_series(folder / "s.vtu.series")) << size;
    }
    for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
             {"{", "the series is no JSON"},
             {"{}", "expected a member \"files\", an array, found none"},
             {"{\"files\": 3}", "found number"},
             {"{\"files\": [3]}", "entry 1 of \"files\""},
             {"{\"files\": [{\"name\": \"\", \"time\": 1}]}", "a member \"name\""},
             {"{\"files\": [{\"name\": \"a\", \"time\": \"1\"}]}",
              "expected a member \"time\", a finite number, found string"},
             {"{\"files\": [{\"name\": \"a\", \"time\": 1e999}]}", "the series"}}) {
        put(folder / "s.vtu.series", text);
        const Result<std::vector<SeriesStep>> steps = read_series(folder / "s.vtu.series");
        ASSERT_FALSE(steps) << text;
        EXPECT_NE(steps.error().message().find(message), std::string::npos) << text << '\n' << steps.error().message();
    }
    put(folder / "s.vtu.series", "{\"files\": []}");
    EXPECT_FALSE(read_vtk(folder / "s.vtu.series"));
    // A series that names itself does not go on for ever.
    put(folder / "s.vtu.series", "{\"files\": [{\"name\": \"s.vtu.series\", \"time\": 0}]}");
    EXPECT_FALSE(read_vtk(folder / "s.vtu.series"));
}

TEST(VtkCollections, WhatIsRefused) {
    const TemporaryFolder folder;
    put(folder / "0.vtu", piece(0));
    const auto refused = [&](const std::string& text, const std::string& what) {
        put(folder / "m", text);
        const Result<Mesh> mesh = read_vtk(folder / "m");
        ASSERT_FALSE(mesh) << what;
        EXPECT_EQ(mesh.error().what, what) << mesh.error().message();
    };
    refused(partitioned({"0.vtu", "0.vtu"}), "a file that is named twice in a collection of files");
    refused(partitioned({"m"}), "a file that is named twice in a collection of files");
    refused(partitioned({"none.vtu"}), "a file that is named here is missing");
    refused(partitioned({""}), "an entry without a file");
    refused(partitioned({}), "the file contains no mesh");
    refused("<VTKFile type='Collection'><Collection/></VTKFile>", "a series without steps");
    refused("<VTKFile type='Collection'><Collection><DataSet timestep='x' file='0.vtu'/></Collection></VTKFile>",
            "the time of a step");
    refused("<!DOCTYPE x [<!ENTITY a 'aaaa'>]><VTKFile type='UnstructuredGrid'>&a;</VTKFile>",
            "a document type in an XML file of VTK");
    std::string deep = partitioned({"d1"});
    for (int i = 1; i < 20; ++i) put(folder / ("d" + std::to_string(i)), partitioned({"d" + std::to_string(i + 1)}));
    refused(deep, "files that name files too deeply");
}

TEST(VtkCollections, PointsOfGrids) {
    const TemporaryFolder folder;
    const std::string arrays =
        "<PointData><DataArray type='Float64' Name='T'>1 2 3 4</DataArray>"
        "<Array type='String' Name='s'>97 0 97 0 97 0 97 0</Array></PointData>";
    put(folder / "g.vti",
        "<VTKFile type='ImageData'><ImageData WholeExtent='1 2 0 1 0 0' Origin='0.1 0 0' "
        "Spacing='0.1 2 1'><Piece Extent='1 2 0 1 0 0'>" +
            arrays + "</Piece></ImageData></VTKFile>");
    const Result<PointData> image = read_vtk_point_data(folder / "g.vti", 2);
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->points, (std::vector<double>{0.1 + 0.1, 0, 0.1 + 0.1 * 2, 0, 0.1 + 0.1, 2, 0.1 + 0.1 * 2, 2}));
    ASSERT_EQ(image->fields.size(), 1U);
    EXPECT_EQ(image->fields[0].data, (std::vector<double>{1, 2, 3, 4}));
    ASSERT_EQ(image->labels.size(), 1U);
    EXPECT_EQ(image->labels[0].size(), 4U);
    EXPECT_TRUE(read_vtk_point_data(folder / "g.vti", 2, std::vector<std::string>{"x"}).value().fields.empty());
    put(folder / "g.vtr",
        "<VTKFile type='RectilinearGrid'><RectilinearGrid WholeExtent='0 1 0 1 0 0'><Piece "
        "Extent='0 1 0 1 0 0'><Coordinates><DataArray type='Float64'>1 5</DataArray><DataArray "
        "type='Float32'>2 3</DataArray><DataArray type='Float64'>0</DataArray></Coordinates>" +
            arrays + "</Piece></RectilinearGrid></VTKFile>");
    EXPECT_EQ(read_vtk_points(folder / "g.vtr", 2).value(), (std::vector<double>{1, 2, 5, 2, 1, 3, 5, 3}));
    put(folder / "g.vts",
        "<VTKFile type='StructuredGrid'><StructuredGrid WholeExtent='0 1 0 0 0 0'><Piece "
        "Extent='0 1 0 0 0 0'><Points><DataArray type='Float64' NumberOfComponents='3'>1 2 3 4 5 6"
        "</DataArray></Points></Piece></StructuredGrid></VTKFile>");
    EXPECT_EQ(read_vtk_points(folder / "g.vts", 3).value(), (std::vector<double>{1, 2, 3, 4, 5, 6}));
    const auto opened = open_points(folder / "g.vts", 3);
    ASSERT_TRUE(opened);
    EXPECT_EQ((*opened)->count(), 2U);
    for (const char* extent : {"0 1 0 1", "0 1 0 1 0 x", "0 2147483647 0 2147483647 0 2147483647", "0 1 0 1 0 1"}) {
        put(folder / "g.vti", std::string("<VTKFile type='ImageData'><ImageData WholeExtent='") + extent +
                                  "'><Piece Extent='0 1 0 1 0 0'/></ImageData></VTKFile>");
        EXPECT_FALSE(read_vtk_points(folder / "g.vti", 3)) << extent;
        EXPECT_FALSE(read_vtk(folder / "g.vti"));
    }
}

}  // namespace
}  // namespace barycert::testing

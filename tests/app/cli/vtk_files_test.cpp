// VTK's files as inputs and outputs of all commands; cells are counted as in the file, and what it loses is told.

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

/// A triangle, then two tetrahedra with a material, the second one of which is flat if `flat`.
std::string three_cells(bool flat) {
    return std::string(
               "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='5' NumberOfCells='3'>"
               "<PointData><DataArray type='Float64' Name='T'>1 2 3 4 5</DataArray></PointData><CellData>"
               "<Array type='String' Name='material'>97 0 98 0 99 0</Array></CellData><Points><DataArray "
               "type='Float64' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 1 ") +
           (flat ? "1 0 0" : "1 1 1") +
           "</DataArray></Points><Cells><DataArray type='Int32' Name='connectivity'>0 1 2 0 1 2 3 1 2 3 4</DataArray>"
           "<DataArray type='Int32' Name='offsets'>3 7 11</DataArray><DataArray type='UInt8' Name='types'>5 10 10"
           "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

constexpr const char* told = "left out: 1 cells that are no tetrahedra: 1 vtkTriangle";

TEST(VtkFiles, CheckCountsCellsAsTheFileDoes) {
    const Scratch scratch;
    const std::string flat = scratch.put("flat.vtu", three_cells(true)), vtu = scratch.path("out.vtu");
    const Ended r = run({"check", flat, "--json", scratch.path("r.json"), "--html", scratch.path("r.html"), "--vtu",
                         vtu, "--vtk-data", "ascii"});
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_TRUE(contains(r.err, "note: " + flat + ": " + told)) << r.err;
    EXPECT_TRUE(contains(r.out, told)) << r.out;
    EXPECT_TRUE(contains(r.out, "cell 2")) << r.out;
    EXPECT_TRUE(contains(r.out, "cells that were left out included")) << r.out;
    const std::string html = read_file(scratch.path("r.html"));
    EXPECT_TRUE(contains(html, "1 vtkTriangle"));
    EXPECT_TRUE(contains(html, "cell 2"));
    const Json j = Json::parse(read_file(scratch.path("r.json")));
    ASSERT_EQ(j["notes"].size(), 1U);
    EXPECT_EQ(j["notes"][0]["kind"], "left out");
    EXPECT_EQ(j["notes"][0]["file"], flat);
    bool found = false;
    for (const Json& finding : j["findings"]) {
        if (finding["name"] == "degenerate_cell") {
            found = true;
            EXPECT_EQ(finding["places"][0]["cells"], Json({2}));
        }
    }
    EXPECT_TRUE(found);
    EXPECT_EQ(j["measures"]["volume"]["least_cell"], 2);
    EXPECT_EQ(j["measures"]["volume"]["most_cell"], 1);
    const std::string text = read_file(vtu);
    const std::size_t array = text.find("Name=\"cell\"");
    ASSERT_NE(array, std::string::npos);
    EXPECT_EQ(text.substr(text.find('\n', array) + 1, 3), "1 2");
    EXPECT_TRUE(contains(text, "<Array type=\"String\" Name=\"material\" format=\"ascii\">\n98 0 99 0"));
    EXPECT_EQ(run({"check", flat, "--quiet"}).err, "");
}

TEST(VtkFiles, SurfacesCarryTheNumbersOfTheFile) {
    const Scratch scratch;
    const std::string mesh = scratch.put("m.vtu", three_cells(false)), vtp = scratch.path("s.vtp");
    const Ended r = run({"render", "iso", mesh, "--field", "T", "--value", "4.5", "--output", vtp, "--vtk-data",
                         "ascii", "--json", scratch.path("r.json")});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.err, told)) << r.err;
    EXPECT_TRUE(contains(r.out, told)) << r.out;
    EXPECT_EQ(Json::parse(read_file(scratch.path("r.json")))["notes"].size(), 1U);
    const std::string text = read_file(vtp);
    const std::size_t array = text.find("Name=\"cell\"");
    ASSERT_NE(array, std::string::npos);
    EXPECT_EQ(text.substr(text.find('\n', array) + 1, 1), "2");
}

/// Files written with any data are read back, and the values are the same.
TEST(VtkFiles, EveryWayOfWritingThemReadsBack) {
    const Scratch scratch;
    const std::string points = scratch.put("p.csv", "0.2,0.3,0.4\n0.5,0.5,0.5\n9,9,9\n0.1,0.7,0.6\n");
    const std::string mesh_path = mesh("cube-hole");
    const Words sample{"sample", mesh_path, "--points"}, as_csv{"--quiet", "--output", "-"};
    const std::string rows = run(plus(plus(sample, {points}), as_csv)).out;
    ASSERT_EQ(lines_of(rows).size(), 5U);
    std::string onto;
    for (const std::string how : {"raw", "zlib", "lz4", "lzma", "ascii"}) {
        SCOPED_TRACE(how);
        const std::string vtu = scratch.path(how + ".vtu"), vti = scratch.path(how + ".vti"),
                          other = scratch.path("o.vtu");
        ASSERT_EQ(run(plus(plus(sample, {points}), {"--output", vtu, "--vtk-data", how})).code, 0);
        // Rows of sample are points of sample.
        EXPECT_EQ(run(plus(plus(sample, {vtu}), as_csv)).out, rows);
        ASSERT_EQ(run({"resample", mesh_path, "--grid", "3x4x5", "--output", vti, "--vtk-data", how, "--quiet"}).code,
                  0);
        const std::string at_grid = run(plus(plus(sample, {vti}), as_csv)).out;
        EXPECT_EQ(at_grid, run({"resample", mesh_path, "--grid", "3x4x5", "--output", "-", "--quiet"}).out);
        ASSERT_EQ(
            run({"resample", mesh_path, "--onto", mesh("lattice-eighths"), "--output", other, "--vtk-data", how}).code,
            0);
        const std::string values = run({"sample", other, "--points", points, "--quiet", "--output", "-"}).out;
        if (onto.empty()) onto = values;
        EXPECT_EQ(values, onto);
    }
}

TEST(VtkFiles, DataThatDoNotFitTheOutput) {
    const Scratch scratch;
    const std::string points = scratch.put("p.csv", "0.2,0.3,0.4\n"), csv = scratch.path("r.csv");
    const auto refused = [&](const Words& line, const std::string& says) {
        const Ended r = run(line);
        EXPECT_EQ(r.code, 2) << says;
        EXPECT_TRUE(contains(r.err, says)) << r.err;
    };
    refused({"sample", mesh("cube-hole"), "--points", points, "--output", csv, "--vtk-data", "zlib"},
            "--vtk-data is for files of VTK");
    refused({"sample", mesh("cube-hole"), "--points", points, "--output", csv, "--vtk-data", "zip"}, "--vtk-data");
    refused({"resample", mesh("cube-hole"), "--onto", mesh("cube-hole"), "--output", scratch.path("m.vtk"),
             "--vtk-data", "zlib"},
            "legacy files of VTK know no compression");
    refused({"check", mesh("cube-hole"), "--vtk-data", "zlib"}, "--vtk-data is for VTK's files");
    EXPECT_EQ(scratch.names(), (Words{"p.csv"}));
}

TEST(VtkFiles, PiecesAndSeriesAreMeshes) {
    const Scratch scratch;
    scratch.put("0.vtu", three_cells(false));
    const std::string all = scratch.put("m.pvtu",
                                        "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid><Piece Source='0.vtu'/>"
                                        "</PUnstructuredGrid></VTKFile>");
    const std::string steps =
        scratch.put("m.pvd",
                    "<VTKFile type='Collection'><Collection><DataSet timestep='0' file='m.pvtu'/><DataSet timestep='1' "
                    "file='none.vtu'/></Collection></VTKFile>");
    EXPECT_EQ(run({"check", all}).code, 0);
    const Ended r = run({"check", steps});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.err, "all steps but the first of a series of 2")) << r.err;
    // A piece is an input, and no output may take its place.
    const Ended over = run({"check", all, "--vtu", scratch.path("0.vtu")});
    EXPECT_EQ(over.code, 2);
    EXPECT_TRUE(contains(over.err, "--vtu would overwrite the mesh")) << over.err;
}

}  // namespace
}  // namespace barycert::cli_test

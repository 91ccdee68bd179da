// Surfaces and PLCs on the command line: check, and sample.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "barycert/raster.hpp"
#include "process.hpp"

namespace barycert::cli_test {
namespace {

const std::string plc = std::string(BARYCERT_DATA_DIR) + "/plc/";
const char* const tetrahedron = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

TEST(SurfaceCommands, EveryPlcOfTheProjectIsValid) {
    for (const char* name : {"bracket.poly", "cube-hole.poly", "flange.poly", "lattice-box.poly",
                             "lattice-eighths.poly", "needle-slit.smesh", "torus.off"}) {
        const Ended r = run({"check", plc + name});
        EXPECT_EQ(r.code, 0) << r.out;
        EXPECT_TRUE(contains(r.out, "TetGen will get a valid PLC that bounds 1 region")) << r.out;
    }
}

TEST(SurfaceCommands, ReportsAreWritten) {
    const Scratch scratch;
    const std::string off =
        scratch.put("a.off", std::string("OFF\n7 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n.2 .2 -1\n.2 .3 2\n1 1 1\n3 0 2 1\n3 "
                                         "0 1 3\n3 1 2 3\n3 2 0 3\n3 4 5 6\n"));
    const Ended r = run({"check", off, "--json", scratch.path("a.json"), "--html", scratch.path("a.html"), "--sarif",
                         scratch.path("a.sarif"), "--vtu", scratch.path("a.vtp")});
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_TRUE(contains(
        r.out, "NOT certified to be a closed surface without self-intersections: 2 pairs of triangles intersect"))
        << r.out;
    EXPECT_TRUE(contains(r.out, "meet along a segment")) << r.out;
    const auto json = nlohmann::json::parse(read_file(scratch.path("a.json")));
    EXPECT_EQ(json["surface"]["kind"], "triangles");
    EXPECT_EQ(json["findings"][0]["name"], "self_intersection");
    EXPECT_EQ(json["contacts"].size(), 2);
    EXPECT_FALSE(json.contains("measures"));
    EXPECT_TRUE(contains(read_file(scratch.path("a.html")), "Surface certificate of"));
    EXPECT_TRUE(contains(read_file(scratch.path("a.sarif")), "self_intersection"));
    EXPECT_TRUE(contains(read_file(scratch.path("a.vtp")), "Name=\"problems\""));
    const Ended again = run({"check", scratch.path("a.vtp"), "--quiet"});
    EXPECT_EQ(again.code, 1) << again.err;
}

// Red where triangles have defects, on the page as in the file; grey elsewhere.
TEST(SurfaceCommands, Pictures) {
    const Scratch scratch;
    const std::string whole = scratch.put("a.off", tetrahedron),
                      torn = scratch.put(
                          "b.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n.2 .2 -1\n.2 .3 2\n1 1 1\n3 0 2 1\n3 3 4 5\n"),
                      picture = scratch.path("p.png");
    const auto red_pixels = [&] {
        const Result<Image> image = read_png(picture);
        EXPECT_TRUE(image) << image.error().message();
        std::size_t red = 0, grey = 0;
        for (std::int32_t j = 0; image && j < image->height; ++j) {
            for (std::int32_t i = 0; i < image->width; ++i) {
                const Rgba c = image->pixel(i, j);
                (c[0] > c[1] ? red : grey) += c[0] < 250 || c[0] > c[1] ? 1 : 0;
            }
        }
        EXPECT_GT(red + grey, 10000U);
        return red;
    };
    EXPECT_EQ(run({"check", whole, "--picture", picture, "--quiet"}).code, 0);
    EXPECT_EQ(red_pixels(), 0U);
    EXPECT_EQ(run({"check", torn, "--picture", picture, "--html", scratch.path("p.html"), "--quiet"}).code, 1);
    EXPECT_GT(red_pixels(), 5000U);
    const std::string page = read_file(scratch.path("p.html"));
    EXPECT_TRUE(contains(page, "data:image/png;base64,"));
    EXPECT_TRUE(contains(page, "Red: triangles with defects"));
    const Ended jpg = run({"check", torn, "--picture", scratch.path("p.jpg")});
    EXPECT_EQ(jpg.code, 2);
    EXPECT_TRUE(contains(jpg.err, "unknown suffix of --picture")) << jpg.err;
    const Ended mesh = run({"check", plc + "../meshes/cube-hole", "--picture", picture});
    EXPECT_EQ(mesh.code, 2);
    EXPECT_TRUE(contains(mesh.err, "--picture is of surfaces")) << mesh.err;
}

// A polygon that crosses itself is a fault of the file in every format that has polygons.
TEST(SurfaceCommands, PolygonsThatCrossThemselves) {
    const Scratch scratch;
    const std::string nodes = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n", rings = "4 0 1 2 3\n3 0 1 4\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    for (const std::string& file :
         {scratch.put("a.off", "OFF\n5 2 0\n" + nodes + rings), scratch.put("a.ply", ply + nodes + rings),
          scratch.put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n")}) {
        const Ended r = run({"check", file});
        EXPECT_EQ(r.code, 1) << r.err;
        EXPECT_TRUE(contains(r.out, "1 facet is not simple")) << r.out;
        EXPECT_TRUE(contains(r.err, "polygons that cross themselves or are flat (1)")) << r.err;
    }
}

TEST(SurfaceCommands, OptionsOfMeshesAreErrors) {
    const Scratch scratch;
    const std::string off = scratch.put("a.off", tetrahedron);
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--delaunay"},
                                                 {"--fix", scratch.path("b.vtu")},
                                                 {"--conforms-to", off},
                                                 {"--vtu", scratch.path("b.vtu")}}) {
        std::vector<std::string> words{"check", off};
        words.insert(words.end(), more.begin(), more.end());
        const Ended r = run(words);
        EXPECT_EQ(r.code, 2) << r.out << r.err;
        EXPECT_TRUE(contains(r.err, more[0])) << r.err;
    }
    EXPECT_EQ(run({"check", plc + "../meshes/cube-hole", "--vtu", scratch.path("b.vtp")}).code, 2);
}

TEST(SurfaceCommands, ValuesAtNearestPoints) {
    const Scratch scratch;
    const std::string ply = scratch.put("a.ply",
                                        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
                                        "y\nproperty float z\nproperty float T\n"
                                        "element face 4\nproperty list uchar int vertex_indices\nproperty int "
                                        "id\nend_header\n0 0 0 0\n1 0 0 1\n0 1 0 0\n"
                                        "0 0 1 0\n3 0 2 1 5\n3 0 1 3 6\n3 1 2 3 7\n3 2 0 3 8\n");
    const std::string points = scratch.put("p.csv", "x,y,z,name\n.25,.25,-2,a\n.125,.125,.125,b\n0,0,5,c\n0.5,0,0,d\n");
    Ended r = run({"sample", ply, "--points", points, "--keep", "name", "--output", "-"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out,
              "x,y,z,cell,feature,T,id,distance,name\n0.25,0.25,-2,0,face,0.25,5,2,a\n0.125,0.125,0.125,0,face,0.125,5,"
              "-0.125,b\n"
              "0,0,5,1,vertex,0,6,4,c\n0.5,0,0,0,edge,0.5,5,0,d\n");
    EXPECT_TRUE(contains(r.err, "on it      1: 0 on a face, 1 on an edge, 0 at a vertex")) << r.err;
    r = run({"sample", ply, "--points", points, "--within", "3", "--fields", "id", "--output", "-", "--quiet"});
    EXPECT_TRUE(contains(r.out, "0,0,5,-1,outside,nan,nan")) << r.out;
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--outside", "error"}, {"--fields", "U"}, {"--on-boundary", "all"}}) {
        std::vector<std::string> words{"sample", ply, "--points", points, "--output", "-"};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(run(words).code, 2) << more[0];
    }
}

// Rows from a map are those from a search, whatever field; a map is of one surface.
TEST(SurfaceCommands, MapsAndFieldsFromFiles) {
    const Scratch scratch;
    const std::string off = scratch.put("a.off", tetrahedron);
    const std::string points = scratch.put("p.csv", "x,y,z\n.25,.25,-2\n.125,.125,.125\n0,0,5\n0.5,0,0\n7,7,7\n");
    const std::string nodes = scratch.put("u.txt", "1\n2\n3\n.1\n"), cells = scratch.put("v.txt", "5\n6\n7\n8\n");
    const std::vector<std::string> with{"--point-field", "u=" + nodes, "--cell-field", "v=" + cells, "--quiet"};
    const auto sample = [&](std::vector<std::string> words) {
        words.insert(words.end(), with.begin(), with.end());
        return run(words);
    };
    const Ended searched = sample(
        {"sample", off, "--points", points, "--save-map", scratch.path("a.map"), "--output", "-", "--within", "6"});
    EXPECT_EQ(searched.code, 0) << searched.err;
    EXPECT_TRUE(contains(searched.out, "x,y,z,cell,feature,u,v,distance\n0.25,0.25,-2,0,face,1.75,5,2\n"))
        << searched.out;
    EXPECT_TRUE(contains(searched.out, "7,7,7,-1,outside,nan,nan,nan")) << searched.out;
    const Ended mapped = sample({"sample", off, "--map", scratch.path("a.map"), "--output", "-", "--within", "6"});
    EXPECT_EQ(mapped.code, 0) << mapped.err;
    EXPECT_EQ(mapped.out, searched.out);
    const Ended closer = sample({"sample", off, "--map", scratch.path("a.map"), "--output", "-", "--within", "3"});
    EXPECT_TRUE(contains(closer.out, "0,0,5,-1,outside,nan,nan,nan")) << closer.out;
    const std::string other = scratch.put("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n");
    const Ended refused = run({"sample", other, "--map", scratch.path("a.map"), "--output", "-"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(contains(refused.err, "the map was made for another mesh")) << refused.err;
    const Ended both = run({"sample", off, "--points", points, "--field", "u=" + nodes, "--output", "-"});
    EXPECT_TRUE(contains(both.err, "could belong to nodes or to cells")) << both.err;
}

// A field of nodes and one of faces of one name, a name that rows have, and points without a place.
TEST(SurfaceCommands, NamesAndPointsThatAreNotFinite) {
    const Scratch scratch;
    const std::string ply = scratch.put(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float q\nproperty float distance\nelement face 1\nproperty list uchar int vertex_indices\n"
        "property int q\nend_header\n0 0 0 1 4\n1 0 0 1 4\n0 1 0 1 4\n3 0 1 2 5\n");
    const std::string points = scratch.put("p.csv", "x,y,z\n.25,.25,2\nnan,0,0\n");
    EXPECT_EQ(run({"sample", ply, "--points", points, "--output", "-"}).code, 2);
    const std::vector<std::string> nan{"--nonfinite-points", "nan", "--output", "-"};
    std::vector<std::string> words{"sample", ply, "--points", points, "--save-map", scratch.path("a.map")};
    words.insert(words.end(), nan.begin(), nan.end());
    const Ended r = run(words);
    const std::string rows =
        "x,y,z,cell,feature,q,point:distance,cell:q,distance\n0.25,0.25,2,0,face,1,4,5,2\n"
        "nan,0,0,-1,outside,nan,nan,nan,nan\n";
    EXPECT_EQ(r.out, rows) << r.err;
    EXPECT_TRUE(contains(r.err, "1 not finite")) << r.err;
    EXPECT_EQ(run({"sample", ply, "--map", scratch.path("a.map"), "--output", "-"}).out, rows);
    const Ended one = run({"sample", ply, "--map", scratch.path("a.map"), "--fields", "cell:q", "--output", "-"});
    const std::string taken = scratch.put("t.csv", "x,y,z,distance\n.25,.25,2,7\n");
    const Ended kept = run({"sample", ply, "--points", taken, "--keep", "distance", "--output", "-"});
    EXPECT_TRUE(contains(kept.err, "with another name for this one: --keep OTHER=distance")) << kept.out;
    EXPECT_TRUE(contains(one.out, "cell,feature,cell:q,distance\n0.25,0.25,2,0,face,5,2")) << one.out << one.err;
}

// Rows of files of meshes are of the triangles that are read. A flat .vtp is a mesh: what is said of its series is said
// of a mesh. In another plane it is a surface, and told to be.
TEST(SurfaceCommands, FilesOfMeshes) {
    const Scratch scratch;
    const std::string mixed =
        scratch.put("a.vtk",
                    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n"
                    "1 1 1\n0 1 1\nCELLS 4 14\n2 0 1\n3 0 1 2\n3 0 2 3\n2 1 2\nCELL_TYPES 4\n3\n5\n5\n3\n");
    const std::string rows = scratch.put("v.txt", "5\n6\n"), points = scratch.put("p.csv", "x,y,z\n.75,.25,9\n");
    const Ended r = run({"sample", mixed, "--points", points, "--cell-field", "v=" + rows, "--output", "-", "--quiet"});
    EXPECT_TRUE(contains(r.out, ",face,") || contains(r.out, ",edge,")) << r.err;
    const auto vtp = [&](const char* name, const std::string& z) {
        return scratch.put(
            name,
            R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData><Piece NumberOfPoints="3" )"
            R"(NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="1"><Points><DataArray )"
            R"(type="Float64" NumberOfComponents="3" format="ascii">0 0 )" +
                z + " 1 0 " + z + " 0 1 " + z +
                R"(</DataArray></Points><Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2)"
                R"(</DataArray><DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys></Piece>)"
                R"(</PolyData></VTKFile>)");
    };
    const std::string flat = vtp("flat.vtp", "0"), raised = vtp("raised.vtp", "1"),
                      plane = scratch.put("q.csv", "x,y\n.25,.25\n");
    scratch.put("f-1.txt", "1\n2\n3\n");
    scratch.put("f-2.txt", "4\n5\n6\n");
    const Ended steps = run({"sample", flat, "--points", plane, "--point-field", "p@" + scratch.path("f-*.txt"),
                             "--output", scratch.path("rows-{step}.csv"), "--quiet"});
    EXPECT_EQ(steps.code, 0) << steps.err;
    EXPECT_TRUE(contains(read_file(scratch.path("rows-2.csv")), "4.75"));
    EXPECT_TRUE(contains(run({"check", raised}).out, "lie in the plane z = 1")) << run({"check", raised}).err;
    EXPECT_EQ(run({"check", plc + "torus.off", "--step", "1"}).code, 2);
    const Ended list = run({"sample", mixed, "--points", points, "--cell-field", "v=" + rows, "--cell-field",
                            "w=" + rows, "--fields", "w,v", "--output", "-", "--quiet"});
    EXPECT_TRUE(contains(list.out, "feature,w,v,distance")) << list.err;
}

// Nearest projection: with any field of the nodes the weights give the values, up to rounding.
TEST(SurfaceCommands, WeightsOfNearestPoints) {
    const Scratch scratch;
    const std::string off = scratch.put("a.off", tetrahedron), npz = scratch.path("w.npz");
    const std::string points = scratch.put("p.csv", "x,y,z\n.25,.25,-2\n0,0,5\n0.3,-.1,-.1\n1,1,1\n7,7,7\n");
    ASSERT_EQ(run({"sample", off, "--points", points, "--within", "6", "--weights", npz, "--save-map",
                   scratch.path("a.map"), "--quiet"})
                  .code,
              0);
    const std::string bytes = read_file(npz);
    ASSERT_EQ(run({"sample", off, "--map", scratch.path("a.map"), "--within", "6", "--weights", npz, "--quiet"}).code,
              0);
    EXPECT_EQ(read_file(npz), bytes) << "from a map";
    if (std::system("/usr/bin/python3 -c 'import numpy' >/dev/null 2>&1") != 0) GTEST_SKIP() << "python3 has no numpy";
    const std::string script = scratch.put("script.py", R"(
import sys, numpy as np
z = np.load(sys.argv[1])
assert (z['cell'] == [0, 1, 0, 2, -1]).all(), z['cell']
assert (np.diff(z['indptr']) == [3, 1, 2, 3, 0]).all(), z['indptr']
assert (z['indices'] == [0, 1, 2, 3, 0, 1, 1, 2, 3]).all(), z['indices']
assert (z['data'] == [.5, .25, .25, 1, .7, .3, 1/3, 1/3, 1/3]).all(), z['data']
assert (z['shape'] == [5, 4]).all()
)");
    EXPECT_EQ(std::system(("/usr/bin/python3 " + script + " " + npz).c_str()), 0);
}

TEST(SurfaceCommands, FieldsOfPolygons) {
    const Scratch scratch;
    const std::string off = scratch.put("a.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1 2 3\n3 0 1 4\n");
    const std::string points = scratch.put("p.csv", "x,y,z\n.75,.25,-1\n.25,.75,-1\n.25,-1,.25\n");
    const std::string cells = scratch.put("v.txt", "5\n6\n");
    const Ended r = run({"sample", off, "--points", points, "--field", "v=" + cells, "--output", "-", "--quiet"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out,
              "x,y,z,cell,feature,v,distance\n0.75,0.25,-1,0,face,5,1\n0.25,0.75,-1,0,face,5,1\n"
              "0.25,-1,0.25,1,face,6,1\n");
    // A row for each polygon of the file, those that no triangles fill among them.
    const std::string uncut = scratch.put("b.off",
                                          "OFF\n8 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 0 0\n6 1 0\n6 0 0\n5 1 0\n"
                                          "4 0 1 2 3\n4 4 5 6 7\n");
    const Ended of_uncut = run({"sample", uncut, "--points", points, "--cell-field", "v=" + cells, "--output", "-"});
    EXPECT_TRUE(contains(of_uncut.out, "0.75,0.25,-1,0,face,5,1\n0.25,0.75,-1,0,face,5,1\n")) << of_uncut.out;
    const std::string few = scratch.put("w.txt", "5\n6\n7\n");
    EXPECT_EQ(run({"sample", off, "--points", points, "--field", "w=" + few, "--output", "-"}).code, 2);
}

TEST(SurfaceCommands, TrianglesInSpaceInFilesOfMeshes) {
    const Scratch scratch;
    const std::string msh = scratch.put(
        "a.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n4\n"
        "1 2 2 0 1 1 3 2\n2 2 2 0 1 1 2 4\n3 2 2 0 1 2 3 4\n4 2 2 0 1 3 1 4\n$EndElements\n");
    EXPECT_EQ(run({"check", msh}).code, 0);
    const std::string points = scratch.put("p.csv", "x,y,z\n.25,.25,-2\n");
    const Ended r = run({"sample", msh, "--points", points, "--output", "-", "--quiet"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "0.25,0.25,-2,0,face")) << r.out;
}

TEST(SurfaceCommands, ToldThatPolygonsAreCut) {
    const Scratch scratch;
    const std::string square = scratch.put("q.vtk",
                                           "# vtk DataFile Version 3.0\nq\nASCII\nDATASET POLYDATA\nPOINTS 4 "
                                           "double\n0 0 0 1 0 0 1 1 0.5 0 1 0\nPOLYGONS 1 5\n4 0 1 2 3\n");
    const Ended r = run({"check", square});
    EXPECT_TRUE(contains(r.out, "1 polygons, which are cut into triangles of their corners")) << r.out;
}

}  // namespace
}  // namespace barycert::cli_test

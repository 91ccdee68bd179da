// Surfaces and PLCs on the command line: check, and sample.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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
         {std::vector<std::string>{"--outside", "error"}, {"--fields", "U"}, {"--weights", scratch.path("w.npz")}}) {
        std::vector<std::string> words{"sample", ply, "--points", points, "--output", "-"};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(run(words).code, 2) << more[0];
    }
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

}  // namespace
}  // namespace barycert::cli_test

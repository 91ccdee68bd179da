/// Every format of PLC in; files out that read back to what they say.
#include <algorithm>
#include <cstring>

#include "tests/app/tetgen/harness.hpp"

namespace barycert::test {
namespace {

std::string cube_ply(const std::string& properties, const std::string& rest_of_row) {
    std::string text = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 8\n" + properties +
                       "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& [x, y, z] : cube_nodes) {
        text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + rest_of_row + "\n";
    }
    return text + side_rows(0, "", "");
}

template <class Visit>
void for_each_cube_triangle(const Visit& visit) {
    for (const auto& [a, b, c, d] : cube_sides) {
        visit(a, b, c);
        visit(a, c, d);
    }
}

std::string cube_stl_text() {
    std::string text = "solid cube\n";
    for_each_cube_triangle([&](int a, int b, int c) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int node : {a, b, c}) {
            const auto& [x, y, z] = cube_nodes[static_cast<std::size_t>(node)];
            text += "vertex " + std::to_string(x) + " " + std::to_string(y) + ".0 " + std::to_string(z) + "e0\n";
        }
        text += "endloop\nendfacet\n";
    });
    return text + "endsolid cube\n";
}

/// The test's machines are little-endian, as the format is.
std::string cube_stl_binary() {
    std::string bytes = "solid, says this binary file too";
    bytes.resize(80);
    bytes += std::string("\x0c\0\0\0", 4);
    for_each_cube_triangle([&](int a, int b, int c) {
        std::array<float, 12> numbers{};
        std::size_t at = 3;
        for (const int node : {a, b, c}) {
            for (const int x : cube_nodes[static_cast<std::size_t>(node)]) numbers[at++] = static_cast<float>(x);
        }
        std::array<char, 50> record{};
        std::memcpy(record.data(), numbers.data(), sizeof numbers);
        bytes.append(record.data(), record.size());
    });
    return bytes;
}

/// Meshes `input`, expects a unit cube of the eight corners, and returns it.
Mesh expect_cube(const std::string& input) {
    const Outcome run = run_tetgen({input, "--output", input + ".out"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("8 nodes"), std::string::npos) << run.err;
    const Mesh mesh = read_tetgen(input + ".out").value();
    EXPECT_EQ(mesh.point_count(), 8U);
    EXPECT_EQ(mesh.face_count(), 12U);
    EXPECT_EQ(mesh.neighbours.size(), mesh.cells.size());
    EXPECT_EQ(total_volume(mesh), 1);
    return mesh;
}

TEST(Formats, Poly) {
    const Scratch folder;
    for (const int base : {0, 1}) {
        const Mesh mesh = expect_cube(folder.put("cube.poly", cube_poly(base)));
        EXPECT_EQ(mesh.index_base, base);
        EXPECT_EQ(mesh.face_markers, std::vector<std::int64_t>(12, 7));
    }
}

TEST(Formats, PolyWithNodesApart) {
    const Scratch folder;
    folder.put(
        "cube.node", "# nodes\n8 3 1 1\n" + [] {
            std::string rows;
            for (std::size_t i = 0; i < 8; ++i) {
                const auto& [x, y, z] = cube_nodes[i];
                rows += std::to_string(i) + ", " + std::to_string(x) + " " + std::to_string(y) + " " +
                        std::to_string(z) + " 0." + std::to_string(i) + " 5\n";
            }
            return rows;
        }());
    const Mesh mesh = expect_cube(folder.put("cube.poly", "0\n6 0\n" + side_rows(0, "1\n", "") + "0\n"));
    ASSERT_EQ(mesh.point_fields.size(), 1U);
    EXPECT_EQ(mesh.point_fields[0].data[7], 0.7);
    EXPECT_EQ(mesh.point_markers[7], 5);

    // The .poly's own header says nothing about attributes of the other file, which ends before that word.
    std::string rows;
    for (std::size_t i = 0; i < 8; ++i) {
        const auto& [x, y, z] = cube_nodes[i];
        rows += std::to_string(i) + " " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    }
    folder.put("plain.node", "8 3\n" + rows);
    EXPECT_TRUE(
        expect_cube(folder.put("plain.poly", "0 3 2 0\n6 0\n" + side_rows(0, "1\n", "") + "0\n")).point_fields.empty());

    // Writing over the PLC's own nodes would destroy it.
    const std::string before = contents(folder.path("cube.node"));
    EXPECT_EQ(run_tetgen({folder.path("cube.poly"), "--output", folder.path("cube")}).code, 2);
    EXPECT_EQ(contents(folder.path("cube.node")), before);
}

TEST(Formats, Smesh) {
    const Scratch folder;
    const Mesh mesh =
        expect_cube(folder.put("cube.smesh", "8 3\n" + cube_rows(1, true) + "6 1\n" + side_rows(1, "", " 3")));
    EXPECT_EQ(mesh.face_markers, std::vector<std::int64_t>(12, 3));
}

TEST(Formats, Off) {
    const Scratch folder;
    expect_cube(folder.put("cube.off", cube_off()));
    expect_cube(folder.put("comments.off",
                           "OFF # geometry\n# counts\n8 6 0\n" + cube_rows(0, false) + side_rows(0, "", " 255 0 0")));
    expect_cube(folder.put("from-one.off", "OFF\n8 6 0\n" + cube_rows(0, false) + side_rows(1, "", "")));
}

TEST(Formats, Stl) {
    const Scratch folder;
    expect_cube(folder.put("text.stl", cube_stl_text()));
    expect_cube(folder.put("binary.stl", cube_stl_binary()));
}

TEST(Formats, Ply) {
    const Scratch folder;
    expect_cube(folder.put("cube.ply", cube_ply("property float x\nproperty float y\nproperty float z\n", "")));
    // Columns go by name: this one lists z first.
    expect_cube(folder.put("order.ply", cube_ply("property float z\nproperty float x\nproperty float y\n"
                                                 "property uchar red\n",
                                                 " 255")));
}

// Numbers that TetGen's own reader would misread: octal 010, a gap in the numbers, a number with a Fortran exponent.
TEST(Formats, NumbersAreReadRightlyOrRefused) {
    const Scratch folder;
    std::string octal = cube_poly();
    octal.replace(octal.find("1 1 0 0"), 7, "1 010 0 0");
    const Outcome run = run_tetgen({folder.put("octal.poly", octal)});
    ASSERT_EQ(run.code, 0) << run.err;
    const Mesh mesh = read_tetgen(folder.path("octal.1")).value();
    EXPECT_EQ(*std::max_element(mesh.points.begin(), mesh.points.end()), 10);

    for (const std::string wrong : {"1 nan 0 0", "1 1.0D+00 0 0", "5 1 0 0", "1 inf 0 0", "1 1 0 0 9"}) {
        std::string text = cube_poly();
        text.replace(text.find("1 1 0 0"), 7, wrong);
        const Outcome refused = run_tetgen({folder.put("wrong.poly", text)});
        EXPECT_EQ(refused.code, 2) << wrong;
        EXPECT_NE(refused.err.find("wrong.poly:3: "), std::string::npos) << refused.err;
    }
}

// Meshes that were read are written again to the same bytes: no bit of a coordinate is lost.
TEST(Formats, OutputRoundTrip) {
    const Scratch folder;
    const std::string input = folder.put("cube.poly", cube_poly(1));
    ASSERT_EQ(run_tetgen({input, "--quality", "1.1", "--max-volume", "0.003", "--order", "2"}).code, 0);
    const Mesh mesh = read_tetgen(folder.path("cube.1")).value();
    ASSERT_GT(mesh.cell_count(), 300U);
    const std::string comment = "Generated by barycert-tetgen cube.poly --quality 1.1 --max-volume 0.003 --order 2";
    ASSERT_TRUE(write_tetgen(mesh, folder.path("again"), {.comment = comment}));
    for (const std::string extension : {".node", ".ele", ".face", ".neigh"}) {
        EXPECT_EQ(contents(folder.path("cube.1" + extension)), contents(folder.path("again" + extension))) << extension;
    }
    EXPECT_NE(contents(folder.path("cube.1.ele")).find("# " + comment + "\n"), std::string::npos);
}

TEST(Formats, SharedShapes) {
    const std::filesystem::path plcs = std::filesystem::path(BARYCERT_SHARED_DATA_DIR) / "plc";
    if (!std::filesystem::exists(plcs)) GTEST_SKIP() << "no folder " << plcs;
    const Scratch folder;
    for (const std::string name : {"slit-1.smesh", "spike-10-10.smesh", "wedge-1.smesh", "fandisk.off"}) {
        const Outcome run = run_tetgen({(plcs / name).string(), "--quality", "--output", folder.path(name)});
        ASSERT_EQ(run.code, 0) << run.err;
        EXPECT_GT(read_tetgen(folder.path(name)).value().cell_count(), 20U) << name;
    }
}

}  // namespace
}  // namespace barycert::test

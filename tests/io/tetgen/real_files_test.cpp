// Files from real programs and traps on disk. The folder may be absent; the traps stand as strings in grammar_test.cpp.
#include <filesystem>
#include <set>

#include "tests/io/tetgen/mesh_files.hpp"

namespace barycert::testing {
namespace {

const std::string shared = BARYCERT_SHARED_DATA_DIR;

#define SKIP_WITHOUT_SHARED_DATA() \
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no " << shared

/// The stems of a folder's .node files.
std::set<std::string> stems_in(const std::string& folder) {
    std::set<std::string> stems;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".node") stems.insert(entry.path().stem().string());
    }
    return stems;
}

struct Good {
    const char* stem;
    std::size_t nodes, cells;
    int dimension = 3, base = 0;
    MidEdgeOrder order = MidEdgeOrder::none;
    std::size_t point_fields = 0, cell_fields = 0;
    bool markers = false;
};

void expect_good(const std::string& folder, const Good& good) {
    SCOPED_TRACE(good.stem);
    const Result<Mesh> mesh = read_tetgen(folder + good.stem);
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_EQ(mesh->point_count(), good.nodes);
    EXPECT_EQ(mesh->cell_count(), good.cells);
    EXPECT_EQ(mesh->dimension, good.dimension);
    EXPECT_EQ(mesh->index_base, good.base);
    EXPECT_EQ(mesh->mid_edge_order, good.order);
    EXPECT_EQ(mesh->point_fields.size(), good.point_fields);
    EXPECT_EQ(mesh->cell_fields.size(), good.cell_fields);
    EXPECT_EQ(mesh->point_markers.size(), good.markers ? good.nodes : 0);
    for (const int threads : {1, 2, 7}) {
        const Result<Mesh> again = read_tetgen(folder + good.stem, {.threads = threads});
        ASSERT_TRUE(again);
        expect_same(*again, *mesh);
    }
}

struct Bad {
    const char* stem;
    const char* suffix;
    std::size_t line;
    const char* what;
    const char* expected;
    const char* found;
};

void expect_bad(const std::string& folder, const Bad& bad) {
    SCOPED_TRACE(bad.stem);
    expect_error(read_tetgen(folder + bad.stem), std::string(bad.stem) + bad.suffix, bad.line, bad.what, bad.expected,
                 bad.found, nullptr);
}

TEST(RealFiles, Meshes) {
    SKIP_WITHOUT_SHARED_DATA();
    const std::string folder = shared + "/tetgen/";
    std::set<std::string> left = stems_in(folder);
    for (const Good& good : {
             Good{"Cube21", 9261, 48000, 3, 0, MidEdgeOrder::none, 0, 1},
             Good{"armadillo_203693", 45484, 203693},
             Good{"cube_136_elements", 51, 136},
             Good{"cube_1626_elements_quadratic", 2570, 1626, 3, 0, MidEdgeOrder::vtk},
             Good{"cube_2mm_12_elements_with_node_attributes", 12, 12, 3, 0, MidEdgeOrder::none, 2},
             Good{"cylinder_14748_elem", 2978, 14748, 3, 0, MidEdgeOrder::none, 0, 1},
             Good{"disk_984_elements", 543, 984, 2, 0, MidEdgeOrder::none, 0, 0, true},
             Good{"disk_984_elements_indexed_from_1", 543, 984, 2, 1, MidEdgeOrder::none, 0, 0, true},
             Good{"ellipsoid_15811_elements", 3432, 15811},
         }) {
        expect_good(folder, good);
        left.erase(good.stem);
    }
    expect_bad(folder, {"HumanWedgeMesh_BIN", ".node", 1, "a binary file", "text", "\"BIN\" in the header"});
    left.erase("HumanWedgeMesh_BIN");
    EXPECT_TRUE(left.empty()) << "no expectation for " << *left.begin();
}

TEST(RealFiles, ChasteBadData) {
    SKIP_WITHOUT_SHARED_DATA();
    const std::string folder = shared + "/nasty/";
    std::set<std::string> left = stems_in(folder);
    // Their fault lies in a file that is not of this format.
    const Good good[] = {{"chaste_bad_faces_disk_522_elements", 312, 522, 2, 0, MidEdgeOrder::none, 0, 0, true},
                         {"chaste_disk_522_order_2_elements", 1145, 522, 2, 0, MidEdgeOrder::triangle, 0, 0, true}};
    for (const Good& each : good) {
        expect_good(folder, each);
        left.erase(each.stem);
    }
    const Bad bad[] = {
        {"chaste_bad_elements_disk_522_elements", ".ele", 3, "a row out of sequence", "row 1", "\"2\""},
        {"chaste_bad_nodes_disk_522_elements", ".node", 3, "a row out of sequence", "row 1", "\"3\""},
        {"chaste_permuted_nodes_disk_522_elements", ".node", 7, "a row out of sequence", "row 6", "\"7\""},
        {"chaste_canonical_triangle_missing_edge_attribute", ".node", 2, "too few columns in a row",
         "5 columns: id, 2 coordinates, 1 attribute, 1 marker", "4"},
        {"chaste_canonical_triangle_missing_node_attribute", ".node", 3, "too few columns in a row",
         "5 columns: id, 2 coordinates, 2 attributes", "4"},
    };
    for (const Bad& each : bad) {
        expect_bad(folder, each);
        left.erase(each.stem);
    }
    EXPECT_TRUE(left.empty()) << "no expectation for " << *left.begin();
}

TEST(RealFiles, TetgenTraps) {
    SKIP_WITHOUT_SHARED_DATA();
    const std::string folder = shared + "/nasty/tetgen_traps/";
    std::set<std::string> left = stems_in(folder);
    for (const char* stem : {"ok1", "bom", "comma", "crlf", "hdr1"}) {
        expect_good(folder, {stem, 4, 1, 3, 1});
        left.erase(stem);
    }
    const Bad bad[] = {
        {"badidx", ".ele", 2, "corner out of range", "1 to 4 (nodes)", "\"9\""},
        {"base5", ".node", 2, "a bad first row number", "0 or 1", "\"5\""},
        {"dash", ".node", 1, "bad number of nodes in the header", nullptr, "\"---\""},
        {"dexp", ".node", 3, "bad coordinate", "a number", "\"1.0D+03\""},
        {"five", ".ele", 1, "bad number of corners in the header", nullptr, "5"},
        {"gap", ".node", 4, "a row out of sequence", "row 3", "\"30\""},
        {"nanx", ".node", 2, "bad coordinate", "a finite number", "\"nan\""},
        {"octal", ".ele", 2, "bad corner", "an integer without leading zeros", "\"010\""},
        {"perm", ".node", 3, "a row out of sequence", "row 2", "\"3\""},
        {"semi", ".node", 1, "bad number of nodes in the header", nullptr, "\"4;3;0;0\""},
        {"short", ".node", 6, "the file ends too early", "5 rows as the header tells", "4"},
        {"trail", ".node", 6, "text after the last row", nullptr, "\"garbage\""},
    };
    for (const Bad& each : bad) {
        expect_bad(folder, each);
        left.erase(each.stem);
    }
    EXPECT_TRUE(left.empty()) << "no expectation for " << *left.begin();
}

}  // namespace
}  // namespace barycert::testing

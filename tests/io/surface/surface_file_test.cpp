// PLY and OFF files, read again: PLY by what its header says, OFF by the reader of PLCs. VTP files are VTK's to judge.
#include "tests/io/surface/surface_files.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/io/tetgen/mesh_files.hpp"

namespace barycert::testing {
namespace {

/// An element of a binary PLY file: rows of doubles for its scalar properties, and lists of indices.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<std::pair<std::string, std::string>> properties;  ///< type, name
    std::vector<std::vector<double>> rows;
    std::vector<std::vector<std::int32_t>> lists;
};

template <class T>
T take(const std::string& bytes, std::size_t& at) {
    T x;
    std::memcpy(&x, bytes.data() + at, sizeof x);
    at += sizeof x;
    return x;
}

std::vector<PlyElement> read_ply(const std::string& bytes) {
    const std::string end = "end_header\n";
    std::size_t at = bytes.find(end) + end.size();
    std::istringstream head(bytes.substr(0, at));
    std::vector<PlyElement> elements;
    std::string line;
    std::getline(head, line);
    EXPECT_EQ(line, "ply");
    std::getline(head, line);
    EXPECT_EQ(line, "format binary_little_endian 1.0");
    while (std::getline(head, line) && line + "\n" != end) {
        std::istringstream words(line);
        std::string word, type, name;
        words >> word;
        if (word == "comment") continue;
        if (word == "element") {
            PlyElement& e = elements.emplace_back();
            words >> e.name >> e.count;
        } else if (word == "property") {
            words >> type;
            if (type == "list") {
                std::string count, index;
                words >> count >> index;
                EXPECT_EQ(count + index, "ucharint");
            }
            words >> name;
            elements.back().properties.emplace_back(type, name);
        }
        EXPECT_FALSE(words.fail()) << line;
        EXPECT_FALSE(words >> word) << "one word too many: " << line;
    }
    for (PlyElement& e : elements) {
        for (std::size_t i = 0; i < e.count; ++i) {
            e.rows.emplace_back();
            for (const auto& [type, name] : e.properties) {
                if (type == "double") e.rows.back().push_back(take<double>(bytes, at));
                if (type == "int") e.rows.back().push_back(take<std::int32_t>(bytes, at));
                if (type != "list") continue;
                e.lists.emplace_back();
                const auto size = take<unsigned char>(bytes, at);
                for (int k = 0; k < size; ++k) e.lists.back().push_back(take<std::int32_t>(bytes, at));
            }
        }
    }
    EXPECT_EQ(at, bytes.size());
    return elements;
}

std::vector<std::string> names_of(const PlyElement& e) {
    std::vector<std::string> names;
    for (const auto& [type, name] : e.properties) names.push_back(name);
    return names;
}

using Names = std::vector<std::string>;

TEST(SurfaceFile, PlyHasEveryNumber) {
    const TemporaryFolder folder;
    const Surface s = two_triangles();
    const SurfaceFile file = write_surface(s, folder / "s.PLY").value();
    EXPECT_TRUE(file.left_out.empty());
    EXPECT_EQ(file.renamed.size(), 5U);
    EXPECT_EQ(file.renamed.front(), "T (K) as T__K_");
    const std::vector<PlyElement> ply = read_ply(get(folder / "s.PLY"));
    ASSERT_EQ(ply.size(), 2U);
    EXPECT_EQ(ply[0].name, "vertex");
    EXPECT_EQ(names_of(ply[0]),
              (Names{"x", "y", "z", "T__K_", "u_______Gr____e_0", "u_______Gr____e_1", "u_______Gr____e_2", "x_"}));
    for (std::size_t v = 0; v < 4; ++v) {
        std::vector<double> row{s.points.begin() + static_cast<long>(3 * v),
                                s.points.begin() + static_cast<long>(3 * v + 3)};
        row.push_back(s.point_fields[0].data[v]);
        for (std::size_t c = 0; c < 3; ++c) row.push_back(s.point_fields[1].data[3 * v + c]);
        row.push_back(s.point_fields[2].data[v]);
        EXPECT_EQ(bits_of(ply[0].rows.at(v)), bits_of(row));
    }
    EXPECT_EQ(ply[1].name, "face");
    EXPECT_EQ(names_of(ply[1]), (Names{"vertex_indices", "region_0", "region_1"}));
    EXPECT_EQ(ply[1].lists, (std::vector<std::vector<std::int32_t>>{{0, 1, 2}, {2, 1, 3}}));
    EXPECT_EQ(ply[1].rows, (std::vector<std::vector<double>>{{1, 2}, {3, 1.0 / 7}}));
}

TEST(SurfaceFile, PlyOfSegmentsHasEdges) {
    const TemporaryFolder folder;
    write_surface(two_segments(), folder / "s.ply").value();
    const std::vector<PlyElement> ply = read_ply(get(folder / "s.ply"));
    ASSERT_EQ(ply.size(), 2U);
    EXPECT_EQ(ply[0].rows.at(2), (std::vector<double>{1.0 / 3, 2, 0, 0.3}));
    EXPECT_EQ(ply[1].name, "edge");
    EXPECT_EQ(names_of(ply[1]), (Names{"vertex1", "vertex2", "cell"}));
    EXPECT_EQ(ply[1].rows, (std::vector<std::vector<double>>{{0, 1, 5}, {1, 2, 6}}));
}

TEST(SurfaceFile, OffIsReadAsAPlc) {
    const TemporaryFolder folder;
    const Surface s = two_triangles();
    const SurfaceFile file = write_surface(s, folder / "s.off").value();
    EXPECT_EQ(file.left_out, (Names{"T (K)", "u <&\"'> Größe", "x", "region"}));
    const Plc plc = read_plc(folder / "s.off").value();
    EXPECT_EQ(bits_of(plc.points), bits_of(s.points));
    ASSERT_EQ(plc.facets.size(), 2U);
    EXPECT_EQ(plc.facets[1].polygons[0], (std::vector<std::int32_t>{2, 1, 3}));
    const auto lines = write_surface(two_segments(), folder / "lines.off");
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().what, "an .off file holds polygons only");
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(SurfaceFile, WhatCannotBeWrittenLeavesNothing) {
    const TemporaryFolder folder;
    const auto says = [&](const Surface& s, const std::string& name, const std::string& part) {
        const auto written = write_surface(s, folder / name);
        ASSERT_FALSE(written);
        EXPECT_NE(written.error().message().find(part), std::string::npos) << written.error().message();
    };
    says(two_triangles(), "s.obj", "expected .vtp, .off or .ply, found \".obj\"");
    says(two_triangles(), "s", "found no suffix");
    Surface s = two_triangles();
    s.cells[2] = 4;
    says(s, "s.vtp", "a corner of a cell that is no point");
    s = two_triangles();
    s.points[1] = HUGE_VAL;
    says(s, "s.off", "a coordinate that is not finite");
    s = two_triangles();
    s.point_fields[0].data.pop_back();
    says(s, "s.ply", "a field that does not fit");
    s = two_triangles();
    s.point_fields[1].name = "T (K)";
    says(s, "s.vtp", "\"T (K)\" twice");
    s.point_fields[1].name = "\xff";
    says(s, "s.vtp", "UTF-8");
    s.point_fields[1].name = "";
    says(s, "s.vtp", "the name of an array");
    EXPECT_EQ(folder.file_count(), 0U);
    EXPECT_FALSE(write_surface(two_triangles(), folder / "none/s.vtp"));
}

}  // namespace
}  // namespace barycert::testing

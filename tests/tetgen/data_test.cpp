/// data/ is what data/README.md says.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

namespace barycert::test {
namespace {

const std::filesystem::path data_folder = BARYCERT_DATA_DIR;

/// A row `| name | nodes | cells | orientation | ...` of the table of meshes.
struct Row {
    std::string name;
    std::size_t nodes = 0;
    std::size_t cells = 0;
    std::string orientation;
};

std::vector<Row> rows_of_readme() {
    std::vector<Row> rows;
    std::ifstream in(data_folder / "README.md");
    for (std::string line; std::getline(in, line);) {
        std::replace(line.begin(), line.end(), '|', ' ');
        line.erase(std::remove(line.begin(), line.end(), ','), line.end());
        std::istringstream words(line);
        Row row;
        if (words >> row.name >> row.nodes >> row.cells >> row.orientation && row.name.starts_with('`')) {
            row.name = row.name.substr(1, row.name.size() - 2);
            rows.push_back(row);
        }
    }
    return rows;
}

Mesh mesh_of(const Row& row) {
    return read_tetgen((data_folder / "meshes" / row.name).string()).value();
}

__extension__ using Quad = __float128;

/// The sign of a cell's signed volume or area, det(b-a, c-a, d-a): -1, 0 or 1; 2 where 113 bits do not tell.
int orientation(const Mesh& mesh, std::size_t cell) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::array<std::array<Quad, 3>, 3> e{};
    e[2][2] = 1;  // a triangle's third edge, out of the plane
    for (std::size_t k = 0; k < d; ++k) {
        for (std::size_t axis = 0; axis < d; ++axis) {
            const auto at = [&](std::size_t corner) {
                return mesh.points[d * static_cast<std::size_t>(mesh.cells[(d + 1) * cell + corner]) + axis];
            };
            e[k][axis] = Quad(at(k + 1)) - Quad(at(0));
        }
    }
    const auto minor = [&](std::size_t p, std::size_t q) { return e[1][p] * e[2][q] - e[1][q] * e[2][p]; };
    const Quad volume = e[0][0] * minor(1, 2) - e[0][1] * minor(0, 2) + e[0][2] * minor(0, 1);
    // Coordinates are below 8 and, as this test checks, zero or above 2^-40, so that differences of doubles are exact
    // in 113 bits (3 - -92 < 113). Each of the six products is below 2^12 and takes less than ten roundings of 2^-113.
    constexpr double bound = 60 * 0x1p12 * 0x1p-113;
    if (volume == 0) return 0;
    if (volume < bound && volume > -bound) return 2;
    return volume > 0 ? 1 : -1;
}

TEST(Data, ReadmeListsEveryMesh) {
    std::set<std::string> listed;
    for (const Row& row : rows_of_readme()) listed.insert(row.name);
    std::set<std::string> present;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder / "meshes")) {
        present.insert(entry.path().stem().string());
    }
    EXPECT_EQ(listed, present);
    EXPECT_GE(listed.size(), 9U);
}

TEST(Data, CountsAreAsTheReadmeSays) {
    for (const Row& row : rows_of_readme()) {
        const Mesh mesh = mesh_of(row);
        EXPECT_EQ(mesh.point_count(), row.nodes) << row.name;
        EXPECT_EQ(mesh.cell_count(), row.cells) << row.name;
        EXPECT_EQ(mesh.dimension, row.name == "plate" ? 2 : 3);
        EXPECT_EQ(mesh.mid_nodes.empty(), row.name != "cube-hole-o2");
    }
}

TEST(Data, OrientationIsAsTheReadmeSays) {
    for (const Row& row : rows_of_readme()) {
        const Mesh mesh = mesh_of(row);
        for (const double x : mesh.points) {
            ASSERT_TRUE(x == 0 || (std::abs(x) > 0x1p-40 && std::abs(x) <= 8)) << row.name << ": coordinate " << x;
        }
        std::array<std::size_t, 4> tally{};  // -1, 0, 1, unknown
        for (std::size_t i = 0; i < mesh.cell_count(); ++i) ++tally[static_cast<std::size_t>(orientation(mesh, i) + 1)];
        EXPECT_EQ(tally[3], 0U) << row.name << ": undecided";
        const std::size_t sign = row.orientation == "negative" ? 0 : 2;
        EXPECT_EQ(tally[sign], row.cells)
            << row.name << ": " << tally[0] << " negative, " << tally[1] << " degenerate, " << tally[2] << " positive";
    }
}

// The formulas of the README, each operation rounded once.
TEST(Data, FieldsAreAsTheReadmeSays) {
    for (const Row& row : rows_of_readme()) {
        const Mesh mesh = mesh_of(row);
        ASSERT_EQ(mesh.point_fields.size(), 5U) << row.name;
        const auto d = static_cast<std::size_t>(mesh.dimension);
        for (std::size_t i = 0; i < mesh.point_count(); ++i) {
            const double x = mesh.points[d * i];
            const double y = mesh.points[d * i + 1];
            const double z = d == 3 ? mesh.points[d * i + 2] : 0;
            const auto value = [&](std::size_t a) { return mesh.point_fields[a].data[i]; };
            ASSERT_EQ(value(0), 1 + x / 2 - y / 4 + 2 * z) << row.name << ": node " << i;
            constexpr double half_decimal = 0.51e-6;  // rounded to six decimals
            ASSERT_NEAR(value(1), std::sin(3 * x) * std::cos(2 * y) * std::exp(-z), half_decimal);
            ASSERT_NEAR(value(2), -std::sin(2 * y), half_decimal);
            ASSERT_NEAR(value(3), std::sin(2 * x), half_decimal);
            ASSERT_NEAR(value(4), std::cos(z) / 2, half_decimal);
        }
    }
}

// Lattice nodes are fl(k / 10) and k / 8: on the latter the linear field is exact.
TEST(Data, LatticeNodesLieOnTheirLattice) {
    for (const auto& [name, divisor] : {std::pair{"lattice-box", 10.0}, {"lattice-eighths", 8.0}}) {
        const Mesh mesh = read_tetgen((data_folder / "meshes" / name).string()).value();
        for (const double x : mesh.points) ASSERT_EQ(x, std::round(x * divisor) / divisor);
    }
}

TEST(Data, FilesTellTheirOriginAndNoMore) {
    std::uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder / "meshes")) {
        bytes += entry.file_size();
        std::ifstream in(entry.path());
        std::string last;
        for (std::string line; std::getline(in, line);) last = line;
        EXPECT_TRUE(last.starts_with("# Generated by barycert-")) << entry.path() << ": " << last;
        EXPECT_EQ(last.find('/'), std::string::npos) << last;
    }
    EXPECT_LT(bytes, 6'000'000U);
}

}  // namespace
}  // namespace barycert::test

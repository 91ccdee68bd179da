// Files that are cut, extended or replaced while they are read: what stood there, or an error; never the end of the
// process.
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <ios>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "io/fields/field_file.hpp"
#include "io/mesh_format.hpp"
#include "tests/temporary_folder.hpp"

namespace barycert::testing {
namespace {

constexpr int nodes = 100000;

/// One cell, and many nodes: "ID x y z" or "x y z" a line.
std::string rows(int first_id) {
    std::string text;
    for (int i = 0; i < nodes; ++i) {
        if (first_id >= 0) text += std::to_string(i + first_id) + ' ';
        text += i == 1 ? "1 0 0\n" : i == 2 ? "0 1 0\n" : i == 3 ? "0 0 1\n" : std::to_string(i) + ".25 0 0\n";
    }
    return text;
}

struct Format {
    const char* name;  ///< of the file that is changed
    std::string head;
    int first_id;  ///< -1: rows without
    std::string tail;
};

std::vector<Format> formats() {
    const std::string n = std::to_string(nodes);
    return {{"m.node", n + " 3 0 0\n", 0, ""},
            {"m.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + n + "\n", 1,
             "$EndNodes\n$Elements\n1\n1 4 0 1 2 3 4\n$EndElements\n"},
            {"m.vtu",
             "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
             "<Piece NumberOfPoints=\"" +
                 n +
                 "\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" "
                 "NumberOfComponents=\"3\" format=\"ascii\">\n",
             -1,
             "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3"
             "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray><DataArray "
             "type=\"UInt8\" Name=\"types\" "
             "format=\"ascii\">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n"},
            {"m.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " + n + " double\n", -1,
             "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"},
            {"m.txt", "", -1, ""},
            {"m.csv", "x y z\n", -1, ""}};
}

/// How many numbers were read.
Result<std::size_t> read(const std::string& path) {
    if (path.ends_with(".txt")) {
        Notes notes;
        const Result<Field> field = io::read_field_file("f", path, "", notes);
        if (!field) return field.error();
        return field->data.size();
    }
    if (path.ends_with(".csv")) {
        const auto source = open_points(path, 3);
        if (!source) return source.error();
        std::vector<double> points;
        for (Result<std::size_t> taken = 1U; *taken != 0;) {
            taken = (*source)->read(1000, points);
            if (!taken) return taken.error();
        }
        return points.size();
    }
    const Result<Mesh> mesh = read_mesh(path);
    if (!mesh) return mesh.error();
    return mesh->points.size();
}

enum class Change { cut, extend, replace };

void change(const std::string& path, Change how) {
    if (how == Change::cut) std::filesystem::resize_file(path, std::filesystem::file_size(path) / 3);
    if (how == Change::extend) std::ofstream(path, std::ios::app) << "1 2 3\n";
    if (how != Change::replace) return;
    std::ofstream(path + ".new") << "nothing like it\n";
    std::filesystem::rename(path + ".new", path);
}

TEST(ChangingFiles, ARowOfPointsThatIsCutOffIsNoBadRow) {
    const TemporaryFolder folder;
    const std::string path = folder / "p.csv", text = "x y z\n" + rows(-1);
    for (const std::size_t cut : {text.size() - 1, text.size() - 4, text.rfind('\n', text.size() - 2) + 1}) {
        put(path, text);
        const auto source = open_points(path, 3);
        ASSERT_TRUE(source) << source.error().message();
        std::vector<double> points;
        ASSERT_TRUE((*source)->read(1, points));
        std::filesystem::resize_file(path, cut);
        Result<std::size_t> taken = 1U;
        while (taken && *taken != 0) taken = (*source)->read(1000, points);
        ASSERT_FALSE(taken) << cut;
        EXPECT_EQ(taken.error().what, "the file was changed while it was read");
        EXPECT_EQ(taken.error().file, path);
    }
}

TEST(ChangingFiles, AreReadAsTheyWereOrRefused) {
    std::mt19937 random(1);
    const TemporaryFolder folder;
    put(folder / "m.ele", "1 4 0\n0 0 1 2 3\n");
    for (const Format& format : formats()) {
        SCOPED_TRACE(format.name);
        const std::string path = folder / format.name, text = format.head + rows(format.first_id) + format.tail;
        put(path, text);
        const Result<std::size_t> all = read(path);
        ASSERT_TRUE(all) << all.error().message();
        EXPECT_EQ(*all, 3U * nodes);
        for (int i = 0; i < 24; ++i) {
            put(path, text);
            const auto how = static_cast<Change>(i % 3);
            const std::chrono::microseconds after(random() % 4000);
            std::thread changes([&] {
                std::this_thread::sleep_for(after);
                change(path, how);
            });
            const Result<std::size_t> some = read(path);
            changes.join();
            if (some) {
                // Without a count, a row that was appended before the file was opened is one of its rows.
                const bool counted =
                    how != Change::extend || format.head.find(std::to_string(nodes)) != format.head.npos;
                if (counted || *some != *all + 3) {
                    EXPECT_EQ(*some, *all);
                }
            } else {
                EXPECT_EQ(some.error().file, path);
            }
        }
        put(path, "");
    }
}

}  // namespace
}  // namespace barycert::testing

/// Mesh files of a test: written to a folder of their own, removed afterwards.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

namespace barycert::testing {

class TemporaryFolder {
public:
    TemporaryFolder() {
        static std::atomic<int> count{0};
        path_ = std::filesystem::temp_directory_path() /
                ("barycert-mesh-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    std::size_t file_count() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
    }

private:
    std::filesystem::path path_;
};

inline void put(const std::string& path, const std::string& text) {
    std::filesystem::remove(path);  // some file systems wait for the disk where a file is overwritten
    std::ofstream(path, std::ios::binary) << text;
}

inline std::string get(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline const char* const tetrahedron_node = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
inline const char* const tetrahedron_ele = "1 4 0\n1 1 2 3 4\n";

/// Reads the texts as STEM.node and STEM.ele (and the others if not empty).
inline Result<Mesh> read_texts(const std::string& node, const std::string& ele = tetrahedron_ele,
                               const std::string& face = "", const std::string& neigh = "", int threads = 1) {
    const TemporaryFolder folder;
    put(folder / "m.node", node);
    put(folder / "m.ele", ele);
    if (!face.empty()) put(folder / "m.face", face);
    if (!neigh.empty()) put(folder / "m.neigh", neigh);
    return read_tetgen(folder / "m", {.threads = threads});
}

inline std::string bits_of(const std::vector<double>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

inline void expect_same_fields(const std::vector<Field>& a, const std::vector<Field>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].name, b[i].name);
        EXPECT_EQ(a[i].components, b[i].components);
        EXPECT_EQ(bits_of(a[i].data), bits_of(b[i].data));
    }
}

/// Equal in everything, doubles by their bits.
inline void expect_same(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.dimension, b.dimension);
    EXPECT_EQ(bits_of(a.points), bits_of(b.points));
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.mid_nodes, b.mid_nodes);
    EXPECT_EQ(a.mid_edge_order, b.mid_edge_order);
    expect_same_fields(a.point_fields, b.point_fields);
    expect_same_fields(a.cell_fields, b.cell_fields);
    EXPECT_EQ(a.point_markers, b.point_markers);
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.face_mid_nodes, b.face_mid_nodes);
    EXPECT_EQ(a.face_markers, b.face_markers);
    EXPECT_EQ(a.neighbours, b.neighbours);
    EXPECT_EQ(a.index_base, b.index_base);
}

/// The error of a read that must fail, with every part checked that is not nullptr.
inline void expect_error(const Result<Mesh>& result, const std::string& suffix, std::size_t line, const char* what,
                         const char* expected, const char* found, const char* remedy_part) {
    ASSERT_FALSE(result) << "read, but " << what << " was to be told";
    const Error& error = result.error();
    SCOPED_TRACE(error.message());
    EXPECT_TRUE(error.file.ends_with(suffix));
    EXPECT_EQ(error.line, line);
    EXPECT_EQ(error.what, what);
    if (expected != nullptr) {
        EXPECT_EQ(error.expected, expected);
    }
    if (found != nullptr) {
        EXPECT_EQ(error.found, found);
    }
    if (remedy_part != nullptr) {
        EXPECT_NE(error.remedy.find(remedy_part), std::string::npos);
    }
}

}  // namespace barycert::testing

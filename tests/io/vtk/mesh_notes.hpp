/// Helpers that the tests of VTK's files share, with or without VTK.
#pragma once

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
#include "tests/io/tetgen/mesh_files.hpp"

namespace barycert::testing {

/// Everything printed between its construction and text().
class Printed {
public:
    Printed() {
        ::testing::internal::CaptureStdout();
        ::testing::internal::CaptureStderr();
    }
    std::string text() { return ::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr(); }
};

inline Result<Mesh> read_quietly(const std::string& path) {
    Printed printed;
    Result<Mesh> mesh = read_vtk(path);
    EXPECT_EQ(printed.text(), "");
    return mesh;
}

/// The texts of the notes of that kind.
inline std::vector<std::string> notes_of(const Mesh& mesh, Note::Kind kind = Note::Kind::left_out) {
    std::vector<std::string> texts;
    for (const Note& note : mesh.notes) {
        if (note.kind == kind) texts.push_back(note.text);
    }
    return texts;
}

/// The mesh as a VTK file holds it: what has no place in the format is gone.
inline Mesh as_in_vtk(Mesh mesh) {
    mesh.mid_edge_order = mesh.mid_nodes.empty() ? MidEdgeOrder::none : MidEdgeOrder::vtk;
    mesh.faces.clear();
    mesh.face_mid_nodes.clear();
    mesh.face_markers.clear();
    mesh.neighbours.clear();
    mesh.index_base = 0;
    return mesh;
}

inline Mesh mesh_of_data(const char* name) {
    return read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/" + name, {.threads = 1}).value();
}

}  // namespace barycert::testing

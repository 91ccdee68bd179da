/// What the tests of VTK files share: files made by VTK's own writers, and ears for what is printed.
#pragma once

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "barycert/vtk.hpp"
#include "io/tetgen/mesh_files.hpp"

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

inline std::string bits_of(vtkDataArray* array) {
    return {static_cast<const char*>(array->GetVoidPointer(0)),
            static_cast<std::size_t>(array->GetNumberOfValues()) * sizeof(double)};
}

inline Mesh mesh_of_data(const char* name) {
    return read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/" + name, {.threads = 1}).value();
}

template <class Array>
vtkSmartPointer<Array> array_of(const char* name, int components, const std::vector<double>& values) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
    for (std::size_t i = 0; i < values.size(); ++i) {
        array->SetComponent(static_cast<vtkIdType>(i) / components, static_cast<int>(i) % components, values[i]);
    }
    return array;
}

}  // namespace barycert::testing

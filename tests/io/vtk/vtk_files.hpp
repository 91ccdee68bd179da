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
#include "io/vtk/mesh_notes.hpp"

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

inline std::string bits_of(vtkDataArray* array) {
    return {static_cast<const char*>(array->GetVoidPointer(0)),
            static_cast<std::size_t>(array->GetNumberOfValues()) * sizeof(double)};
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

/// Files that the tests with VTK share, made by VTK's own writers.
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
#include "tests/io/vtk/mesh_notes.hpp"

namespace barycert::testing {

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

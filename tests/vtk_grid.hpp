/// Meshes and points as VTK takes them. For sources in C++17 (VTK 9.1's vtkSMPTools.h does not compile as C++20) and in
/// C++20.
#pragma once

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace barycert::test {

/// `coordinates`: a vector or span of doubles, `dimension` a point; in the plane z is 0.
template <class Coordinates>
vtkSmartPointer<vtkPoints> vtk_points(const Coordinates& coordinates, std::size_t dimension = 3) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(coordinates.size() / dimension));
    for (std::size_t i = 0; i < coordinates.size() / dimension; ++i) {
        const double* const x = coordinates.data() + dimension * i;
        points->SetPoint(static_cast<vtkIdType>(i), x[0], x[1], dimension == 3 ? x[2] : 0);
    }
    return points;
}

/// Cells by VTK's numbers of types, where the nodes of each end, and the nodes; with a field of nodes.
inline vtkSmartPointer<vtkUnstructuredGrid> vtk_grid(vtkPoints* points, const std::vector<std::uint8_t>& types,
                                                     const std::vector<std::int64_t>& ends,
                                                     const std::vector<std::int32_t>& nodes, const char* field,
                                                     const std::vector<double>& values) {
    vtkNew<vtkCellArray> cells;
    cells->AllocateExact(static_cast<vtkIdType>(types.size()), static_cast<vtkIdType>(nodes.size()));
    vtkNew<vtkUnsignedCharArray> numbers;
    numbers->SetNumberOfValues(static_cast<vtkIdType>(types.size()));
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < types.size(); ++c) {
        numbers->SetValue(static_cast<vtkIdType>(c), types[c]);
        const std::vector<vtkIdType> cell(nodes.begin() + begin, nodes.begin() + ends[c]);
        cells->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
        begin = ends[c];
    }
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points);
    grid->SetCells(numbers, cells);
    vtkNew<vtkDoubleArray> array;
    array->SetName(field);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), values[i]);
    grid->GetPointData()->SetScalars(array);
    return grid;
}

}  // namespace barycert::test

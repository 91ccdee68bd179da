/// VTK's types of cells by their numbers (vtkCellType.h).
#pragma once

#include <cstdint>
#include <string>

namespace barycert::io {

enum VtkCell : std::uint8_t {
    vtk_empty_cell = 0,
    vtk_vertex = 1,
    vtk_poly_vertex = 2,
    vtk_line = 3,
    vtk_poly_line = 4,
    vtk_triangle = 5,
    vtk_tetra = 10,
    vtk_quadratic_edge = 21,
    vtk_quadratic_triangle = 22,
    vtk_quadratic_tetra = 24,
    vtk_cubic_line = 35,
    vtk_lagrange_curve = 68,
};

/// "vtkTetra"; "unknown type 200".
std::string vtk_class_name(std::uint8_t type);

}  // namespace barycert::io

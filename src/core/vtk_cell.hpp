/// Types of cells by VTK's numbers (vtkCellType.h), which files and Mesh::Shapes have, too.
#pragma once

#include <cstdint>

namespace barycert {

/// Types that have a name here; what is known of each of VTK's types stands in mesh/cell_types.cpp.
enum VtkCell : std::uint8_t {
    vtk_empty_cell = 0,
    vtk_vertex = 1,
    vtk_poly_vertex = 2,
    vtk_line = 3,
    vtk_poly_line = 4,
    vtk_triangle = 5,
    vtk_triangle_strip = 6,
    vtk_polygon = 7,
    vtk_pixel = 8,
    vtk_quad = 9,
    vtk_tetra = 10,
    vtk_voxel = 11,
    vtk_hexahedron = 12,
    vtk_wedge = 13,
    vtk_pyramid = 14,
    vtk_pentagonal_prism = 15,
    vtk_hexagonal_prism = 16,
    vtk_quadratic_triangle = 22,
    vtk_quadratic_tetra = 24,
    vtk_quadratic_polygon = 36,
    vtk_polyhedron = 42,
    vtk_lagrange_triangle = 69,
    vtk_lagrange_tetra = 71,
    vtk_lagrange_wedge = 73,
    vtk_bezier_wedge = 80,
};

}  // namespace barycert

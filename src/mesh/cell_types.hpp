/// Types of cells by VTK's numbers (vtkCellType.h), and how cells of any of them become those of a mesh.
#pragma once

#include "mesh/pulling.hpp"

namespace barycert::mesh {

/// VTK's cell types that this library names.
enum VtkCell : std::uint8_t {
    vtk_vertex = 1,
    vtk_poly_vertex = 2,
    vtk_line = 3,
    vtk_poly_line = 4,
    vtk_triangle = 5,
    vtk_triangle_strip = 6,
    vtk_polygon = 7,
    vtk_quad = 9,
    vtk_tetra = 10,
    vtk_quadratic_triangle = 22,
    vtk_quadratic_tetra = 24,
    vtk_polyhedron = 42,
};

enum class CellKind : std::uint8_t {
    tetrahedron,
    triangle,
    lower,    ///< points and lines
    surface,  ///< polygons of any order
    solid,    ///< what else fills space
    other,    ///< whose corners are not known
};

struct CellType {
    CellKind kind = CellKind::other;
    std::uint8_t linear = 0;  ///< the type of its corners, which come first
    std::size_t nodes = 0;    ///< 0: any number, but at least the corners
    std::string name;         ///< "vtkTetra"; "unknown type 200"

    int dimension() const {
        if (kind == CellKind::triangle || kind == CellKind::surface) return 2;
        return kind == CellKind::tetrahedron || kind == CellKind::solid ? 3 : 0;
    }
};
const std::array<CellType, 256>& cell_types();

/// Nodes at corners. Requires: as many nodes as the type has.
std::span<const Mesh::Index> corners_of(const CellType& type, std::span<const Mesh::Index> nodes);

/// Appends the rings of a polygon, by its corners; those of a strip are triangles.
void add_rings(const CellType& type, std::span<const Mesh::Index> nodes, std::vector<std::vector<Mesh::Index>>& rings);

/// Appends a cell to mesh.shapes by its corners, no faces; simplices up to order 4 whole. False: nodes are left out.
bool add_shape(Mesh& mesh, std::uint8_t type, std::span<const Mesh::Index> nodes);

}  // namespace barycert::mesh

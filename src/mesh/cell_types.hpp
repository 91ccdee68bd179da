/// The table of cell types, by VTK's numbers, and how cells of any of them become those of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/vtk_cell.hpp"

namespace barycert::mesh {

enum class CellKind : std::uint8_t {
    tetrahedron,
    triangle,
    lower,    ///< points and lines
    surface,  ///< polygons of any order
    solid,    ///< what else fills space
    other,    ///< whose corners are not known
};

struct CellType {
    std::uint8_t number = 0;  ///< VTK's
    CellKind kind = CellKind::other;
    std::uint8_t linear = 0;         ///< the type of its corners, which come first
    std::size_t nodes = 0;           ///< 0: any number, but at least the corners
    std::size_t corners = 0;         ///< 0: any number
    std::string_view faces = {};     ///< rings of corners in base 16, seen from outside; empty: the nodes tell
    std::string_view vtk_name = {};  ///< "Tetra" of vtkTetra; empty: VTK has no such type
    std::string_view meshio = {};    ///< meshio's name, "tetra"; empty: it has none
    bool in_shapes = false;          ///< Mesh::Shapes has cells of it: linear ones and curved simplices

    /// 0 for points and lines, too.
    constexpr int dimension() const {
        if (kind == CellKind::triangle || kind == CellKind::surface) return 2;
        return kind == CellKind::tetrahedron || kind == CellKind::solid ? 3 : 0;
    }
    /// "vtkTetra"; "unknown type 200".
    std::string name() const;
};

/// Each type at its number.
const std::array<CellType, 256>& cell_types();

inline const CellType& cell_type(std::uint8_t number) {
    return cell_types()[number];
}

/// The faces of a cell of Mesh::Shapes as rings of places among its corners; none where the nodes tell.
const std::vector<std::vector<Mesh::Index>>& rings_of(std::uint8_t type);

/// Triangles and tetrahedra of order 2 to 4: VTK's quadratic and Lagrange ones, whose corners come first.
constexpr bool is_curved_simplex(std::uint8_t type) {
    return type == vtk_quadratic_triangle || type == vtk_quadratic_tetra || type == vtk_lagrange_triangle ||
           type == vtk_lagrange_tetra;
}

/// Returns 2 to 4, the order of a simplex with so many nodes; 0 if it is another.
constexpr int simplex_order(int dimension, std::size_t nodes) {
    constexpr std::array<std::array<std::size_t, 3>, 2> counts{{{6, 10, 15}, {10, 20, 35}}};
    for (std::size_t i = 0; i < 3; ++i) {
        if (counts[dimension == 3 ? 1 : 0][i] == nodes) return static_cast<int>(i) + 2;
    }
    return 0;
}

/// The type of the same shape whose corners are numbered round each layer: that of pixels and voxels, which VTK numbers
/// row by row; others are their own.
constexpr std::uint8_t numbered_round(std::uint8_t type) {
    return type == vtk_pixel ? std::uint8_t{vtk_quad} : type == vtk_voxel ? std::uint8_t{vtk_hexahedron} : type;
}

/// Nodes at corners. Precondition: as many nodes as the type has.
std::span<const Mesh::Index> corners_of(const CellType& type, std::span<const Mesh::Index> nodes);

/// Appends the rings of a polygon, by its corners; those of a strip are triangles.
void add_rings(const CellType& type, std::span<const Mesh::Index> nodes, std::vector<std::vector<Mesh::Index>>& rings);

/// Appends a cell to mesh.shapes by its corners, no faces; simplices up to order 4 whole. False: nodes are left out.
bool add_shape(Mesh& mesh, std::uint8_t type, std::span<const Mesh::Index> nodes);

}  // namespace barycert::mesh

/// Unstructured grids on their way into VTK's files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "core/vtk_cell.hpp"
#include "io/vtk/out_file.hpp"
#include "mesh/mid_edges.hpp"

namespace barycert::io {

/// An unstructured grid of cells of one type, of so many nodes each, or of those shapes.
struct OutGrid {
    std::vector<OutArray> point_arrays, cell_arrays;
    OutArray points, connectivity;
    std::size_t cells = 0, nodes = 1;
    std::uint8_t type = 0;  ///< VTK's number
    const Mesh::Shapes* shapes = nullptr;

    std::size_t end(std::size_t cell) const {
        return shapes == nullptr ? nodes * (cell + 1) : static_cast<std::size_t>(shapes->ends[cell]);
    }
    std::uint8_t type_of(std::size_t cell) const { return shapes == nullptr ? type : shapes->types[cell]; }
};

/// The nodes of all cells: corners, then mid-edge nodes, whose order in the mesh is VTK's.
struct CellNodes {
    const Mesh& mesh;
    std::size_t corners = mesh.corners();  ///< of a cell, and all of its nodes
    std::size_t nodes = corners + (mesh.mid_nodes.empty() ? 0 : mesh::edges_of(mesh.dimension).size());

    Mesh::Index operator()(std::size_t i) const {
        const std::size_t cell = i / nodes, k = i % nodes;
        return k < corners ? mesh.cells[cell * corners + k] : mesh.mid_nodes[cell * (nodes - corners) + k - corners];
    }
    VtkCell type() const {
        if (mesh.dimension == 2) return nodes == corners ? vtk_triangle : vtk_quadratic_triangle;
        return nodes == corners ? vtk_tetra : vtk_quadratic_tetra;
    }
};

/// As RawFaces has them. `ends`: where those of each polyhedron end, -1 of other cells.
std::vector<std::int64_t> face_streams(const Mesh::Shapes& shapes, std::vector<std::int64_t>& ends);

/// Into a .vtu file.
Status write_grid(OutGrid grid, const std::string& path, VtkData data);

/// Into a legacy file: numbers in big-endian order, or as text. `node`: of cells that are no shapes.
Status write_legacy_grid(OutGrid grid, const CellNodes& node, const std::string& path, bool text);

// Texts of arrays.

inline bool has_zero_byte(const std::string& text) {
    return text.find('\0') != std::string::npos;
}

/// Each text with a zero byte behind it.
std::string with_ends(const std::vector<std::string>& texts);

}  // namespace barycert::io

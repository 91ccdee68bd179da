/// Meshes and points from VTK's files: .vtu and .vtp (XML) and .vtk (legacy). Only where barycert::vtk is built.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/core/result.hpp"
#include "barycert/mesh/mesh.hpp"

namespace barycert {

/// What a file held besides the mesh.
struct VtkLeftOut {
    struct Array {
        std::string name;
        std::string why;  ///< one clause
    };
    std::size_t cells = 0;            ///< cells of a lower dimension than the mesh
    std::vector<Array> point_arrays;  ///< arrays that are no fields
    std::vector<Array> cell_arrays;
};

/// Reads an unstructured grid from XML (.vtu) or legacy format (.vtk; there also polygon data, if they are triangles).
/// Which of the two it is, is told by the first bytes. ASCII, base64, raw, compressed by zlib, LZ4 or LZMA, of either
/// byte order, in one piece or several.
///
/// - Tetrahedra make a mesh of dimension 3. Where there are none, triangles make one of dimension 2, and all points
/// must
///   have z = 0. All cells are linear or all are quadratic (VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE), whose
///   mid-edge nodes go to mid_nodes.
/// - Vertices, lines and, beside tetrahedra, triangles are left out, and so are their rows of the cell arrays: cells,
///   and what cell fields say of them, are counted among those kept, in the order of the file.
/// - Arrays of any numeric type and any number of components become fields of the same name, exactly. An array that
///   cannot (strings; no name; a 64-bit integer that is no double; missing in one of the pieces) is left out. Of arrays
///   with time steps the first is read.
/// - A point array "marker" of 64-bit integers, one a point, becomes point_markers: write_vtk keeps them there.
///   Arrays without a point or cell (field data) are not looked at.
///
/// What is left out is told in `left_out`, if it is given. VTK prints nothing.
///
/// Error: the file is missing, cut off, contradicts itself, has a coordinate that is not finite, an index that is no
/// point, more than 2147483647 points or cells, cells of other types (they are named), no cells of its dimension, or
/// triangles off the plane z = 0; memory is short. Memory is bounded by what the file holds once it is decompressed.
Result<Mesh> read_vtk(const std::string& path, VtkLeftOut* left_out = nullptr);

/// The points of any .vtu, .vtp or .vtk (unstructured grid, polygon data, structured grid), `dimension` coordinates a
/// point. In dimension 2, every z must be 0.
///
/// Error: as in read_vtk, as far as it concerns points; cells are not read.
Result<std::vector<double>> read_vtk_points(const std::string& path, int dimension);

}  // namespace barycert

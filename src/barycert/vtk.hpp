/// Files of VTK: meshes, points and sampled rows. Only where barycert::vtk is built, which tells whoever links it by
/// the macro BARYCERT_WITH_VTK.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

/// From then on read_mesh, open_points, open_table and write_mesh take VTK's files too. Call it before threads start.
void use_vtk_files();

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

// Meshes and sampled points to VTK's files. Only where barycert::vtk is built.

/// Writes the mesh as its path ends: .vtu as write_vtu does; .vtk in the legacy format, binary, through VTK's writer.
/// read_vtk reads the same mesh from either, to the bits of every double, but for faces, neighbours and the index base.
///
/// A legacy file is of version 4.2, which every reader of the format knows, and of 5.1 from 2^31 numbers of cells on.
/// It appears whole or not at all and is written as it is made. Names of fields may hold any bytes.
///
/// Error: an ending that is neither; as write_vtu, but for what concerns XML; in a legacy file a name that takes more
/// than 200 bytes there (all but letters and digits may take three), which VTK's own readers would not read, or the
/// name METADATA or NULL_ARRAY, which mean something else there.
Status write_vtk(const Mesh& mesh, const std::string& path);

// VTK's VTU files (XML, unstructured grid), through VTK's own writer. Only where barycert::vtk is built, which
// tells whoever links it by the macro BARYCERT_WITH_VTK.

/// Writes points, cells and fields as one piece, for every reader of VTU files.
///
/// - Triangles get z = 0. Where there are mid-edge nodes, cells are quadratic ones. Corners keep their order, so a cell
///   of negative volume stays one.
/// - Fields are Float64 arrays under their own names, with their components; any value may be in them, NaN and infinity
///   too. point_markers are an Int64 array "marker". Faces and neighbours have no place in the format.
/// - Data are appended raw: neither compressed nor in base64. Every double reads back to the same bits, NaNs with their
///   payloads, and the same mesh gives the same bytes.
///
/// The file appears whole or not at all. It is made in memory first, which takes its size, 21 bytes a linear
/// tetrahedron and 24 a node besides fields, and about as much as the cells again.
///
/// Error: the mesh is inconsistent; a field has no name, the name of another one of its kind (of "marker", where there
/// are markers), or a name that XML cannot hold (not UTF-8, or control characters but for tab and line breaks); the
/// file cannot be written; memory is short. VTK prints nothing: what it has to say is in the Error.
Status write_vtu(const Mesh& mesh, const std::string& path);

}  // namespace barycert

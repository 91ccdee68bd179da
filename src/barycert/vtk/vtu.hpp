/// VTK's VTU files (XML, unstructured grid), through VTK's own writer. Only where barycert::vtk is built, which
/// tells whoever links it by the macro BARYCERT_WITH_VTK.
#pragma once

#include <string>

#include "barycert/core/result.hpp"
#include "barycert/mesh/mesh.hpp"

namespace barycert {

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

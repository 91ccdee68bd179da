/// Meshes and sampled points to VTK's files. Only where barycert::vtk is built.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "barycert/core/result.hpp"
#include "barycert/core/simplex.hpp"
#include "barycert/mesh/mesh.hpp"

namespace barycert {

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

/// Points and what was found at them: row i of each span and field belongs to point i. A span may be empty; then its
/// array is left out.
struct PointRows {
    int dimension = 3;
    std::span<const double> points;        ///< `dimension` coordinates a row
    std::span<const Mesh::Index> cells;    ///< the cell that holds the point, -1 where none does
    std::span<const Feature> features;     ///< where in that cell
    std::span<const std::uint8_t> inside;  ///< 1 where a cell holds the point, 0 elsewhere
    std::vector<Field> fields;             ///< one value a row
    std::span<const double> distances;     ///< to the mesh, in units of the coordinates
};

/// Writes the rows to a .vtu file: each point a cell of type VTK_VERTEX (z = 0 in dimension 2), the rest as point
/// arrays: `cell` (Int64), `feature` (UInt8: 0 interior, 1 face, 2 edge, 3 vertex, 4 outside, 5 degenerate),
/// `vtkValidPointMask` (Int8: 1 inside, 0 outside, as VTK's own probes name it), `distance` (Float64) and the fields
/// (Float64, any value).
///
/// Made in memory first, as by write_vtu. Error: spans or fields of other lengths; a name that is one of these, appears
/// twice, is empty, or that XML cannot hold; a coordinate that is not finite; the file cannot be written.
Status write_vtk_points(const std::string& path, const PointRows& rows);

}  // namespace barycert

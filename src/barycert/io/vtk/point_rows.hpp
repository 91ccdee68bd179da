/// Sampled points as a VTU file has them: an array a field.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert::io {

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
/// Raw appended and uncompressed, in the order of this machine; nothing is made in memory first. Error: spans or fields
/// of other lengths; a name that is one of these, appears twice, is empty, or that XML cannot hold; a coordinate that
/// is not finite; the file cannot be written.
Status write_vtk_points(const std::string& path, const PointRows& rows);

/// A sink of rows into such a file. It keeps them in memory until commit(), for the format has one array after the
/// other.
Result<std::unique_ptr<TableSink>> open_vtu_sink(const std::string& path, const TableFormat& format);

}  // namespace barycert::io

/// Sampled points as a VTU file has them: an array a field.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"

namespace barycert::io {

/// The values of a field of somebody else.
struct FieldRows {
    std::string name;
    int components = 1;
    std::span<const double> values;
};

/// Those of a column; its texts one after the other, each ended by a zero byte.
struct ColumnRows {
    std::string name;
    std::variant<std::span<const std::int64_t>, std::span<const double>, std::span<const char>> values;
};

/// Points and what was found at them: row i of each span and field belongs to point i. A span may be empty; then its
/// array is left out.
struct PointRows {
    int dimension = 3;
    std::span<const double> points;        ///< `dimension` coordinates a row
    std::span<const Mesh::Index> cells;    ///< the cell that holds the point, -1 where none does
    std::span<const Feature> features;     ///< where in that cell
    std::span<const std::uint8_t> inside;  ///< 1 where a cell holds the point, 0 elsewhere
    std::vector<FieldRows> fields;         ///< one value a row
    std::span<const double> distances;     ///< to the mesh, in units of the coordinates
    std::vector<ColumnRows> carried;       ///< as they are
};

/// Writes the rows to a .vtu file: each point a cell of type VTK_VERTEX (z = 0 in dimension 2), the rest as point
/// arrays: `cell` (Int64), `feature` (UInt8: 0 interior, 1 face, 2 edge, 3 vertex, 4 outside, 5 degenerate),
/// `vtkValidPointMask` (Int8: 1 inside, 0 outside, as VTK's own probes name it), `distance` (Float64) and the fields
/// (Float64, any value).
///
/// Columns that are carried through are Int64, Float64 or String arrays. Numbers stand in the order of this machine;
/// what is made is made some at a time. Error: spans or fields of other lengths; a name that is one of these, appears
/// twice, is empty, or that XML cannot hold; a coordinate that is not finite; the file cannot be written.
Status write_vtk_points(const std::string& path, const PointRows& rows, VtkData data = VtkData::raw);

/// A sink of rows into such a file. The format has one array after the other: rows are kept in files without names
/// beside the target up to commit(), so that memory does not grow with them.
Result<std::unique_ptr<TableSink>> open_vtu_sink(const std::string& path, const TableFormat& format);

}  // namespace barycert::io

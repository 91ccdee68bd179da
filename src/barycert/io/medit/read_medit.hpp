/// Meshes and fields out of Medit's files.
#pragma once

#include <string>

#include "barycert/io.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Reads .mesh and .meshb of version 1 to 4.
///
/// - Tetrahedra make a mesh of dimension 3, and its Triangles are the faces, with their references as markers. Where
///   there are no cells of dimension 3, triangles make one of dimension 2; then z is 0, if there is one. All cells are
///   of order 1 or all of order 2 (TetrahedraP2, TrianglesP2), whose mid-edge nodes are told by the points.
/// - Cells are numbered as Medit does: each section of its own.
/// - References of nodes are point markers, those of cells the cell field "medit:ref"; absent where all are 0.
/// - SolAt... are fields, as in read_medit_fields.
/// - What else there is is left out, with a Note.
///
/// Error: what the format does not have; a coordinate that is not finite; a node that there is not; cells of other
/// types or of both orders, which are named; no cells; triangles off the plane z = 0.
Result<Mesh> read_medit(const std::string& path, const ReadOptions& options);

/// The fields of .sol and .solb files for a mesh of that dimension, and notes, in a mesh without nodes and cells: those
/// of nodes, and those of triangles or tetrahedra, are solution0, solution1, ... each.
Result<Mesh> read_medit_fields(const std::string& path, int dimension);

}  // namespace barycert::io

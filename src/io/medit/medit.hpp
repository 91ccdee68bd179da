/// Files of Medit.
#pragma once

#include <string>
#include <string_view>

#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "io/in_space.hpp"

namespace barycert::io {

/// By the first bytes of a file, behind a byte-order mark.
bool is_medit(std::string_view head);

/// Reads .mesh and .meshb of version 1 to 4.
///
/// - Tetrahedra make a mesh of dimension 3, and its Triangles are the faces, with their references as markers. Where
///   there are no cells of dimension 3, triangles make one of dimension 2; then z is 0, if there is one. If all are of
///   order 2 (TetrahedraP2, TrianglesP2), their mid-edge nodes are told by the points.
/// - Hexahedra, Prisms, Pyramids, Quadrilaterals, and cells of several sections or of a higher order are taken by their
///   corners and cut into simplices; cells count on from section to section.
/// - References of nodes are point markers, those of cells the cell field "medit:ref"; absent where all are 0.
/// - SolAt... are fields, as in read_medit_fields.
/// - What else there is is left out, with a Note.
///
/// Error: what the format does not have; a coordinate not finite; an unknown node; no cells; polygons off the plane.
Result<Mesh> read_medit(const std::string& path, const ReadOptions& options, InSpace* space = nullptr);

/// Notes and fields of .sol and .solb files, solution0, solution1, ..., for a mesh of that dimension, in an empty one.
Result<Mesh> read_medit_fields(const std::string& path, int dimension);

}  // namespace barycert::io

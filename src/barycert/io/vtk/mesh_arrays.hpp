/// Meshes as the arrays of VTK's files, and what keeps one from being written.
#pragma once

#include <string>
#include <vector>

#include "barycert/io/vtk/out_array.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Whether names are to stand in XML attributes.
enum class Names : bool { any, xml };

/// What is wrong with the mesh or the names of its fields, in one clause; empty if nothing is.
std::string fault_of_mesh(const Mesh& mesh, Names names);

/// Empty if every name can be written and is the only one: VTK keeps but one array of a name.
std::string fault_of_names(std::vector<std::string> all, Names names);

/// That `what` ("the mesh") cannot be written because of that fault.
Error cannot_write(const std::string& what, const std::string& fault, const std::string& path);

/// VTK's number for the type of the cells.
std::uint8_t cell_type_of(const Mesh& mesh);

/// Corners and mid-edge nodes a cell.
std::size_t nodes_a_cell(const Mesh& mesh);

/// All nodes of cell after cell: corners, then mid-edge nodes, whose order in the mesh is VTK's.
OutArray connectivity_of(const Mesh& mesh);

/// True if offsets into the list of nodes do not fit in 32 bits.
bool needs_wide_indices(const Mesh& mesh);

/// Arrays of points: fields and markers.
std::vector<OutArray> point_arrays_of(const Mesh& mesh);

/// Arrays of cells: fields and labels. Texts go to `room`, which must outlive them.
std::vector<OutArray> cell_arrays_of(const Mesh& mesh, std::vector<std::string>& room);

}  // namespace barycert::io

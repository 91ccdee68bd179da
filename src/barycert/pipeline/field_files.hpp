/// Fields from files, among those of the mesh.
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/pipeline.hpp"
#include "barycert/result.hpp"

namespace barycert::pipeline {

/// True for the names that rows, grids and meshes have besides fields: x, y, z, cell, feature, distance,
/// vtkValidPointMask.
bool is_name_of_rows(const std::string& name);

/// Adds the fields of files to the mesh, and to its notes what is to be told of them. So that columns have one name each, a field of cells that has the name of one
/// of nodes is called cell:NAME from then on, and a field with a name that rows have themselves (x, y, z, cell,
/// feature, distance, vtkValidPointMask) point:NAME or cell:NAME. Errors: those of read_field_file; a name that there
/// is already; a number of rows that is that of neither nodes nor cells, or, where it is not said which, of both.
Status add_fields(const std::vector<FieldFile>& files, Mesh& mesh);

}  // namespace barycert::pipeline

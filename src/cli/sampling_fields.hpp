/// Which fields are sampled: those of the mesh, those of files, and the choice among them.
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "sampling.hpp"

namespace barycert::cli {

/// Adds the fields of files to the mesh. So that columns have one name each, a field of cells that has the name of one
/// of nodes is called cell:NAME from then on, and a field with a name that rows have themselves (x, y, z, cell,
/// feature, distance, vtkValidPointMask) point:NAME or cell:NAME. Errors: those of read_field_file; a name that there
/// is already; a number of rows that is that of neither nodes nor cells, or, where it is not said which, of both.
Status add_fields(const std::vector<FieldFile>& files, Mesh& mesh);

/// The fields chosen by name, in that order; all if no name is given, those of nodes first. A name may be several, with
/// commas between them. point:NAME and cell:NAME say which. The mesh must stay. Error: there is no such field, with a
/// list of those there are; one is chosen twice.
Result<std::vector<FieldChoice>> choose_fields(const Mesh& mesh, const std::vector<std::string>& names);

}  // namespace barycert::cli

/// Fields of a mesh by their names.
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace barycert::sample {

/// The field of that name; nullptr if there is none.
const Field* field_named(const std::vector<Field>& fields, std::string_view name);

/// The fields of these names, those of nodes first, in the order given; all if no name is given. A name may be several,
/// with commas between them. point:NAME and cell:NAME say which where there are two. The mesh must stay. Returns an
/// Error if there is no such field, with a list of those there are, or if one is named twice.
Result<std::vector<FieldChoice>> fields_named(const Mesh& mesh, const std::vector<std::string>& names);

}  // namespace barycert::sample

/// Fields that are made of others.
#pragma once

#include <cstddef>
#include <deque>
#include <string>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace barycert::sample {

/// Takes the first `count` steps of the choice, as far as a field has what they give (see shape_of): what is left is
/// computed for each point. The choice is then of a field in `made`, whose places must stay. Preconditions: shape_of
/// accepts the choice, and the mesh is consistent; data of the field are as many as it needs.
Status make_fields(const Mesh& mesh, FieldChoice& choice, std::size_t count, std::deque<Field>& made);

/// How many steps there are up to the last mean: those that need the whole mesh.
std::size_t steps_of_whole_mesh(const FieldChoice& choice);

}  // namespace barycert::sample

/// Fields that are made of others.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace barycert::sample {

/// Takes the first `count` steps of the choice, as far as a field has what they give (see shape_of): what is left is
/// computed for each point. The choice is then of a field in `made`, whose places must stay. Preconditions: shape_of
/// accepts the choice, and the mesh is consistent; data of the field are as many as it needs.
/// `lengths`: those of fields of nodes are made as well, of what the nodes have; at a point between them the length is
/// another number than what is interpolated of these.
Status make_fields(const Mesh& mesh, FieldChoice& choice, std::size_t count, std::deque<Field>& made,
                   bool lengths = false);

/// The choices as fields that surfaces can carry, in `made` where the mesh has none, and a note of each length. Error:
/// what no field has, the gradient on cells of second order.
Status make_all_fields(const Mesh& mesh, std::vector<FieldChoice>& choices, std::deque<Field>& made, Notes& notes);

/// What `name` means, if it is one number a node or cell. Error: several numbers, or no such field.
Result<FieldChoice> number_named(const Mesh& mesh, const std::string& name);

/// How many steps there are up to the last mean: those that need the whole mesh.
std::size_t steps_of_whole_mesh(const FieldChoice& choice);

}  // namespace barycert::sample

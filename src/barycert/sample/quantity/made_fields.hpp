/// Fields that are made of others.
#pragma once

#include <cstddef>
#include <deque>
#include <span>
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

/// sqrt(sum v_i^2), within 0.51 units in the last place of the exact length where that is not subnormal, else within
/// 0.76 (its unit may be twice that of the sum's root); infinite where that exceeds the doubles. NaN if a component is
/// NaN, else infinite if one is. Subnormal and huge components are no different from others.
double euclidean_length(std::span<const double> v);

/// At each node the mean of the field over all cells that have the node, mid-edge nodes included, weighted by their
/// volumes (areas in the plane; with straight sides): sum |V_c| f_c / sum |V_c|, exact and rounded once, to nearest,
/// ties to even. Cells may have any orientation and may overlap; degenerate ones weigh nothing. NaN where a value of a
/// cell that is not degenerate is not finite, and at nodes of no other cells. Without a name.
/// Preconditions: the mesh is consistent, and the field has values for its cells.
Field nodal_mean(const Mesh& mesh, const Field& of_cells);

}  // namespace barycert::sample

/// Fields of a mesh by their names, and what is made of them: NAME, NAME.x, NAME.2, |NAME|, grad(NAME), mean(NAME); see
/// sampler.hpp.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace barycert::sample {

/// The field of that name; nullptr if there is none.
const Field* field_named(const std::vector<Field>& fields, std::string_view name);

/// The names of fields of nodes, then of fields of cells.
std::vector<std::string> all_field_names(const Mesh& mesh);

/// Calls visit(name) for each of the names between commas, until it returns false.
template <class Visit>
bool for_names(std::string_view text, Visit visit) {
    for (;;) {
        const std::size_t comma = text.find(',');
        if (!visit(std::string(text.substr(0, comma)))) return false;
        if (comma == std::string_view::npos) return true;
        text.remove_prefix(comma + 1);
    }
}

/// The name of the choice's columns.
inline const std::string& name_of(const FieldChoice& choice) {
    return choice.name.empty() ? choice.field->name : choice.name;
}

struct QuantityShape {
    bool of_cells = false;
    std::size_t components = 1;
    bool at_points = false;  ///< no field has it: it is computed for each point
};

/// Requires: the choice has a field. Error: a step that cannot follow those before it.
Result<QuantityShape> shape_of(const Mesh& mesh, const FieldChoice& choice);

/// The fields of these names, or what expressions make of them; a field that has the whole text as its name goes
/// before. Fields of nodes come first, then fields of cells, then quantities computed for each point; all fields if no
/// name is given. A name may be several, with commas between them. The mesh must stay. Returns an Error if there is no
/// such field, with a list of those there are, or if one is named twice.
Result<std::vector<FieldChoice>> quantities_named(const Mesh& mesh, const std::vector<std::string>& names);

/// The expression with another innermost name, if it is one of `name` (of cell:NAME, point:NAME); else nothing.
std::optional<std::string> with_other_name(std::string_view expression, std::string_view name, std::string_view other);

// Fields that are made of others.

/// Takes the first `count` steps of the choice, as far as a field has what they give (see shape_of): what is left is
/// computed for each point. The choice is then of a field in `made`, whose places must stay. Requires: shape_of
/// accepts the choice, and the mesh is consistent; data of the field are as many as it needs.
/// `lengths`: those of fields of nodes are made as well, of what the nodes have; at a point between them the length is
/// another number than what is interpolated of these.
void make_fields(const Mesh& mesh, FieldChoice& choice, std::size_t count, std::deque<Field>& made,
                 bool lengths = false);

/// The choices as fields that surfaces can carry, in `made` where the mesh has none, and a note of each length. Error:
/// what no field has, the gradient on cells of second order.
Status make_all_fields(const Mesh& mesh, std::vector<FieldChoice>& choices, std::deque<Field>& made, Notes& notes);

/// Returns the choice that `name` means, if it is one number a node or cell. Error: several numbers, or no such field.
Result<FieldChoice> number_named(const Mesh& mesh, const std::string& name);

/// sqrt(sum v_i^2), within 0.51 units in the last place of the exact length where that is not subnormal, else within
/// 0.76 (its unit may be twice that of the sum's root); infinite where that exceeds the doubles. NaN if a component is
/// NaN, else infinite if one is. Subnormal and huge components are no different from others.
double euclidean_length(std::span<const double> v);

/// At each node the mean of the field over all cells that have the node, mid-edge nodes included, weighted by their
/// volumes (areas in the plane; with straight sides): sum |V_c| f_c / sum |V_c|, exact and rounded once, to nearest,
/// ties to even. Cells may have any orientation and may overlap; degenerate ones weigh nothing. NaN where a value of a
/// cell that is not degenerate is not finite, and at nodes of no other cells. Without a name.
/// Requires: the mesh is consistent, and the field has values for its cells.
Field nodal_mean(const Mesh& mesh, const Field& of_cells);

}  // namespace barycert::sample

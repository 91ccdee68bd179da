/// Fields of a mesh by their names, and what is made of them: NAME, NAME.x, NAME.2, |NAME|, grad(NAME), mean(NAME); see
/// sampler.hpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace barycert::sample {

/// The field of that name; nullptr if there is none.
const Field* field_named(const std::vector<Field>& fields, std::string_view name);

/// True, and the choice made, if there is a field of that name; point:NAME and cell:NAME say where.
bool choose_field(const Mesh& mesh, std::string_view name, FieldChoice& chosen);

/// Those of nodes, then those of cells.
std::vector<std::string> all_field_names(const Mesh& mesh);

/// That there is no such field, which may be meant, and which there are.
Error no_such_field(const Mesh& mesh, const std::string& name);

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

/// What the steps of a choice give.
struct QuantityShape {
    bool of_cells = false;
    std::size_t components = 1;
    bool at_points = false;  ///< no field has it: it is computed for each point
};

/// Precondition: the choice has a field. Error: a step that cannot follow those before it.
Result<QuantityShape> shape_of(const Mesh& mesh, const FieldChoice& choice);

/// The fields of these names, or what expressions make of them; a field that has the whole text as its name goes
/// before. What lies in nodes comes first, then what lies in cells, then what is computed for each point; all fields if
/// no name is given. A name may be several, with commas between them. The mesh must stay. Returns an Error if there is
/// no such field, with a list of those there are, or if one is named twice.
Result<std::vector<FieldChoice>> quantities_named(const Mesh& mesh, const std::vector<std::string>& names);

/// The expression with another innermost name, if it is one of `name` (of cell:NAME, point:NAME); else nothing.
std::optional<std::string> with_other_name(std::string_view expression, std::string_view name, std::string_view other);

}  // namespace barycert::sample

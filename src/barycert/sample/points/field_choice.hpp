/// Fields of a mesh by their names.
#pragma once

#include <cstddef>
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

/// The fields of these names, those of nodes first, in the order given; all if no name is given. A name may be several,
/// with commas between them. point:NAME and cell:NAME say which where there are two. The mesh must stay. Returns an
/// Error if there is no such field, with a list of those there are, or if one is named twice.
Result<std::vector<FieldChoice>> fields_named(const Mesh& mesh, const std::vector<std::string>& names);

}  // namespace barycert::sample

/// What is made of fields, by name: NAME, NAME.x, NAME.2, |NAME|, grad(NAME), mean(NAME); see sampler.hpp.
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

/// What the steps of a choice give.
struct QuantityShape {
    bool of_cells = false;
    std::size_t components = 1;
    bool at_points = false;  ///< no field has it: it is computed for each point
};

/// Precondition: the choice has a field. Error: a step that cannot follow those before it.
Result<QuantityShape> shape_of(const Mesh& mesh, const FieldChoice& choice);

/// As fields_named, with expressions for names; a field that has the whole text as its name goes before. What lies in
/// nodes comes first, then what lies in cells, then what is computed for each point. The mesh must stay.
Result<std::vector<FieldChoice>> quantities_named(const Mesh& mesh, const std::vector<std::string>& names);

/// The expression with another innermost name, if it is one of `name` (of cell:NAME, point:NAME); else nothing.
std::optional<std::string> with_other_name(std::string_view expression, std::string_view name, std::string_view other);

}  // namespace barycert::sample

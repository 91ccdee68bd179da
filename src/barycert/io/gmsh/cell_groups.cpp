#include "barycert/io/gmsh/msh_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <variant>

#include "barycert/base/text.hpp"
#include "barycert/io.hpp"

namespace barycert::io {
namespace {

/// The values of a field, if each is an integer of 32 bits (and no -0, which would not come back).
std::optional<std::vector<std::int32_t>> integers(const Field* field) {
    if (field == nullptr || field->components != 1) return std::nullopt;
    std::vector<std::int32_t> values;
    values.reserve(field->data.size());
    for (const double x : field->data) {
        if (!(std::fabs(x) <= INT32_MAX) || x != std::trunc(x) || (x == 0 && std::signbit(x))) return std::nullopt;
        values.push_back(static_cast<std::int32_t>(x));
    }
    return values;
}

bool all_are(const std::vector<std::int32_t>& values, std::int32_t value) {
    return std::all_of(values.begin(), values.end(), [&](std::int32_t v) { return v == value; });
}

const Field* find_field(const Mesh& mesh, const char* name) {
    for (const Field& field : mesh.cell_fields) {
        if (field.name == name) return &field;
    }
    return nullptr;
}

template <class T>
const std::vector<T>* find_label(const Mesh& mesh, const char* name) {
    for (const Column& column : mesh.cell_labels) {
        if (column.name == name && column.size() == mesh.cell_count())
            return std::get_if<std::vector<T>>(&column.values);
    }
    return nullptr;
}

/// Those of the file the mesh came from, where they can be tags.
std::vector<std::int64_t> element_tags(const Mesh& mesh) {
    if (const auto* const label = find_label<std::int64_t>(mesh, "gmsh:tag"); label != nullptr) {
        std::vector<std::int64_t> sorted = *label;
        std::sort(sorted.begin(), sorted.end());
        const bool differ = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
        if (differ && !sorted.empty() && sorted.front() >= 1 && sorted.back() <= INT32_MAX) return *label;
    }
    std::vector<std::int64_t> tags(mesh.cell_count());
    for (std::size_t i = 0; i < tags.size(); ++i)
        tags[i] = std::int64_t{mesh.cell_number(static_cast<Mesh::Index>(i))} + 1;
    return tags;
}

/// Makes an entity of each pair of an entity and a group.
void split_entities(CellGroups& groups, std::size_t cells) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> parts;
    std::vector<std::int32_t> entity(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        const auto next = static_cast<std::int32_t>(parts.size()) + 1;
        entity[i] = parts.emplace(std::pair(groups.entity_of(i), groups.group_of(i)), next).first->second;
    }
    groups.entity = std::move(entity);
}

bool one_group_each(CellGroups& groups, std::size_t cells) {
    groups.physical_of.clear();
    for (std::size_t i = 0; i < cells; ++i) {
        if (groups.physical_of.emplace(groups.entity_of(i), groups.group_of(i)).first->second != groups.group_of(i))
            return false;
    }
    return true;
}

}  // namespace

Result<CellGroups> group_cells(const Mesh& mesh, bool by_entity, const std::string& path) {
    CellGroups groups;
    groups.tags = element_tags(mesh);
    const Field* physical = find_field(mesh, "gmsh:physical");
    const Field* geometrical = find_field(mesh, "gmsh:geometrical");
    // Where all cells are of no group, or of entity 1 or none, the reader makes no field.
    if (auto values = integers(physical); values && !all_are(*values, 0)) {
        groups.physical = std::move(*values);
    } else {
        physical = nullptr;
    }
    if (auto values = integers(geometrical); values && !all_are(*values, 0) && !all_are(*values, 1)) {
        groups.entity = std::move(*values);
    } else {
        geometrical = nullptr;
    }
    if (by_entity && !one_group_each(groups, mesh.cell_count())) {
        geometrical = nullptr;
        split_entities(groups, mesh.cell_count());
        one_group_each(groups, mesh.cell_count());
    }
    if (groups.physical_of.empty()) groups.physical_of[1] = 0;
    for (const Field& field : mesh.cell_fields) {
        if (&field != physical && &field != geometrical) groups.data.push_back(&field);
    }
    const auto* const names = find_label<std::string>(mesh, "gmsh:physical_name");
    for (std::size_t i = 0; names != nullptr && !groups.physical.empty() && i < names->size(); ++i) {
        const std::int32_t group = std::abs(groups.physical[i]);
        const std::string& name = (*names)[i];
        if (group == 0 || name.empty()) continue;
        if (groups.names.emplace(group, name).first->second != name ||
            name.find_first_of("\r\n") != std::string::npos) {
            return file_error(path, "a name of physical group " + std::to_string(group) + " that cannot be written",
                              "one name for all of its cells, on one line", base::quoted(name),
                              "correct the cell labels gmsh:physical_name");
        }
    }
    return groups;
}

}  // namespace barycert::io

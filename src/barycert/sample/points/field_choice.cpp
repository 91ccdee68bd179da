#include "barycert/sample/points/field_choice.hpp"

#include <algorithm>
#include <string_view>

namespace barycert::sample {
namespace {

constexpr std::string_view of_cells = "cell:", of_points = "point:";

/// True, and the choice made, if there is that field.
bool choose(const Mesh& mesh, std::string_view name, std::vector<FieldChoice>& chosen) {
    for (const std::string& full : {std::string(name), std::string(of_points) + std::string(name)}) {
        if (const Field* const field = field_named(mesh.point_fields, full)) {
            chosen.push_back({field, false});
            return true;
        }
    }
    for (const std::string& full : {std::string(name), std::string(of_cells) + std::string(name)}) {
        if (const Field* const field = field_named(mesh.cell_fields, full)) {
            chosen.push_back({field, true});
            return true;
        }
    }
    const bool cells = name.starts_with(of_cells);
    if (!cells && !name.starts_with(of_points)) return false;
    name.remove_prefix((cells ? of_cells : of_points).size());
    const Field* const field = field_named(cells ? mesh.cell_fields : mesh.point_fields, name);
    if (field != nullptr) chosen.push_back({field, cells});
    return field != nullptr;
}

std::string names_of(const std::vector<Field>& fields) {
    std::string list;
    for (const Field& f : fields) list += (list.empty() ? "" : ", ") + f.name;
    return list;
}

Error no_such_field(const Mesh& mesh, const std::string& name) {
    const std::string points = names_of(mesh.point_fields), cells = names_of(mesh.cell_fields);
    std::string remedy = "there are " + points;
    if (points.empty()) remedy = cells.empty() ? "the mesh has none: add them by --field NAME=FILE" : "there are";
    if (!cells.empty()) remedy += (points.empty() ? " " : ", and of cells ") + cells;
    return {.what = "no field of that name",
            .file = {},
            .line = 0,
            .expected = {},
            .found = '"' + name + '"',
            .remedy = remedy};
}

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

}  // namespace

const Field* field_named(const std::vector<Field>& fields, std::string_view name) {
    const auto it = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    return it == fields.end() ? nullptr : &*it;
}

Result<std::vector<FieldChoice>> fields_named(const Mesh& mesh, const std::vector<std::string>& names) {
    std::vector<FieldChoice> chosen;
    if (names.empty()) {
        for (const Field& f : mesh.point_fields) chosen.push_back({&f, false});
        for (const Field& f : mesh.cell_fields) chosen.push_back({&f, true});
        return chosen;
    }
    for (const std::string& text : names) {
        if (choose(mesh, text, chosen)) continue;  // a name may hold commas
        std::string missing;
        const bool all = for_names(text, [&](const std::string& name) {
            missing = name;
            return choose(mesh, name, chosen);
        });
        if (!all) return no_such_field(mesh, missing);
    }
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (chosen[i].field == chosen[k].field)
                return Error{.what = "a field is chosen twice",
                             .found = '"' + chosen[i].field->name + '"',
                             .remedy = "name it once in --fields"};
        }
    }
    std::stable_partition(chosen.begin(), chosen.end(), [](const FieldChoice& c) { return !c.of_cells; });
    return chosen;
}

}  // namespace barycert::sample

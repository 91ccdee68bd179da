#include "barycert/sample/points/field_choice.hpp"
#include "barycert/base/nearest_name.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace barycert::sample {
namespace {

constexpr std::string_view of_cells = "cell:", of_points = "point:";

std::string names_of(const std::vector<Field>& fields) {
    std::string list;
    for (const Field& f : fields) list += (list.empty() ? "" : ", ") + f.name;
    return list;
}

}  // namespace

const Field* field_named(const std::vector<Field>& fields, std::string_view name) {
    const auto it = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    return it == fields.end() ? nullptr : &*it;
}

bool choose_field(const Mesh& mesh, std::string_view name, FieldChoice& chosen) {
    for (const std::string& full : {std::string(name), std::string(of_points) + std::string(name)}) {
        if (const Field* const field = field_named(mesh.point_fields, full)) {
            chosen = {field, false};
            return true;
        }
    }
    for (const std::string& full : {std::string(name), std::string(of_cells) + std::string(name)}) {
        if (const Field* const field = field_named(mesh.cell_fields, full)) {
            chosen = {field, true};
            return true;
        }
    }
    const bool cells = name.starts_with(of_cells);
    if (!cells && !name.starts_with(of_points)) return false;
    name.remove_prefix((cells ? of_cells : of_points).size());
    const Field* const field = field_named(cells ? mesh.cell_fields : mesh.point_fields, name);
    if (field != nullptr) chosen = {field, cells};
    return field != nullptr;
}

std::vector<std::string> all_field_names(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const auto* fields : {&mesh.point_fields, &mesh.cell_fields}) {
        for (const Field& field : *fields) names.push_back(field.name);
    }
    return names;
}

Error no_such_field(const Mesh& mesh, const std::string& name) {
    const std::string points = names_of(mesh.point_fields), cells = names_of(mesh.cell_fields);
    std::string remedy = "there are " + points;
    if (points.empty()) remedy = cells.empty() ? "the mesh has none: add them by job.field_files NAME=FILE" : "there are";
    if (!cells.empty()) remedy += (points.empty() ? " " : ", and of cells ") + cells;
    return {.what = "no field of that name",
            .file = {},
            .line = 0,
            .expected = {},
            .found = '"' + name + '"',
            .remedy = base::did_you_mean(name, all_field_names(mesh), remedy)};
}

Result<std::vector<FieldChoice>> fields_named(const Mesh& mesh, const std::vector<std::string>& names) {
    std::vector<FieldChoice> chosen;
    const auto choose = [&](const std::string& name) {
        FieldChoice one;
        if (!choose_field(mesh, name, one)) return false;
        chosen.push_back(std::move(one));
        return true;
    };
    if (names.empty()) {
        for (const Field& f : mesh.point_fields) chosen.push_back({&f, false});
        for (const Field& f : mesh.cell_fields) chosen.push_back({&f, true});
        return chosen;
    }
    for (const std::string& text : names) {
        if (choose(text)) continue;  // a name may hold commas
        std::string missing;
        const bool all = for_names(text, [&](const std::string& name) {
            missing = name;
            return choose(name);
        });
        if (!all) return no_such_field(mesh, missing);
    }
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (chosen[i].field == chosen[k].field)
                return Error{.what = "a field is chosen twice",
                             .found = '"' + chosen[i].field->name + '"',
                             .remedy = "name it once in job.fields"};
        }
    }
    std::stable_partition(chosen.begin(), chosen.end(), [](const FieldChoice& c) { return !c.of_cells; });
    return chosen;
}

}  // namespace barycert::sample

#include "sampling_fields.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "sampling_field_file.hpp"

namespace barycert::cli {
namespace {

constexpr std::string_view of_cells = "cell:", of_points = "point:";

const Field* named(const std::vector<Field>& fields, std::string_view name) {
    const auto it = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    return it == fields.end() ? nullptr : &*it;
}

std::string count(std::size_t n, const std::string& what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// Whether the rows of the field are for cells.
Result<bool> is_of_cells(const FieldFile& file, std::size_t rows, const Mesh& mesh) {
    const std::size_t nodes = mesh.point_count(), cells = mesh.cell_count();
    const bool fits_nodes = rows == nodes && file.of != FieldFile::Of::cells;
    const bool fits_cells = rows == cells && file.of != FieldFile::Of::points;
    if (fits_nodes != fits_cells) return fits_cells;
    if (fits_nodes)
        return Error{.what = "rows of field \"" + file.name + "\" may be for nodes or for cells",
                     .file = file.path,
                     .found = "a mesh of " + std::to_string(nodes) + " nodes and as many cells",
                     .remedy = "say which: --point-field or --cell-field instead of --field"};
    std::string expected = count(nodes, "row") + ", one for each node";
    if (file.of == FieldFile::Of::cells) expected = count(cells, "row") + ", one for each cell";
    if (file.of == FieldFile::Of::either) expected += ", or " + std::to_string(cells) + ", one for each cell";
    return Error{.what = "field \"" + file.name + '"',
                 .file = file.path,
                 .expected = expected,
                 .found = count(rows, "row"),
                 .remedy = "use a file that was made for this mesh"};
}

/// What rows, grids and meshes have besides fields.
bool is_taken(const std::string& name) {
    constexpr std::array<std::string_view, 7> taken{"x", "y", "z", "cell", "feature", "distance", "vtkValidPointMask"};
    return std::find(taken.begin(), taken.end(), name) != taken.end();
}

/// True, and the choice made, if there is that field.
bool choose(const Mesh& mesh, std::string_view name, std::vector<FieldChoice>& chosen) {
    for (const std::string& full : {std::string(name), std::string(of_points) + std::string(name)}) {
        if (const Field* const field = named(mesh.point_fields, full)) {
            chosen.push_back({field, false});
            return true;
        }
    }
    for (const std::string& full : {std::string(name), std::string(of_cells) + std::string(name)}) {
        if (const Field* const field = named(mesh.cell_fields, full)) {
            chosen.push_back({field, true});
            return true;
        }
    }
    const bool cells = name.starts_with(of_cells);
    if (!cells && !name.starts_with(of_points)) return false;
    name.remove_prefix((cells ? of_cells : of_points).size());
    const Field* const field = named(cells ? mesh.cell_fields : mesh.point_fields, name);
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

Status add_fields(const std::vector<FieldFile>& files, Mesh& mesh) {
    for (const FieldFile& file : files) {
        Result<Field> field = read_field_file(file.name, file.path);
        if (!field) return field.error();
        const auto cells = is_of_cells(file, field->data.size() / static_cast<std::size_t>(field->components), mesh);
        if (!cells) return cells.error();
        std::vector<Field>& fields = *cells ? mesh.cell_fields : mesh.point_fields;
        if (named(fields, file.name) != nullptr)
            return Error{.what = "there is a field of that name already",
                         .file = file.path,
                         .found = '"' + file.name + '"',
                         .remedy = "give it another name: --field OTHER=" + file.path};
        fields.push_back(std::move(*field));
    }
    for (Field& field : mesh.point_fields) {
        if (is_taken(field.name)) field.name = std::string(of_points) + field.name;
    }
    for (Field& field : mesh.cell_fields) {
        if (named(mesh.point_fields, field.name) != nullptr || is_taken(field.name))
            field.name = std::string(of_cells) + field.name;
    }
    return Done{};
}

Result<std::vector<FieldChoice>> choose_fields(const Mesh& mesh, const std::vector<std::string>& names) {
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

}  // namespace barycert::cli

#include "barycert/pipeline/field_files.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "barycert/io/fields/field_file.hpp"
#include "barycert/sample/points/field_choice.hpp"

namespace barycert::pipeline {
namespace {

constexpr std::string_view of_cells = "cell:", of_points = "point:";

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
        return Error{.what = "rows of field \"" + file.name + "\" could belong to nodes or to cells",
                     .file = file.path,
                     .found = "a mesh of " + std::to_string(nodes) + " nodes and the same number of cells",
                     .remedy = "say which: --point-field or --cell-field instead of --field"};
    std::string expected = count(nodes, "row") + ", one for each node";
    if (file.of == FieldFile::Of::cells) expected = count(cells, "row") + ", one for each cell";
    if (file.of == FieldFile::Of::either) expected += ", or " + std::to_string(cells) + ", one for each cell";
    return Error{.what = "field \"" + file.name + '"',
                 .file = file.path,
                 .expected = expected,
                 .found = count(rows, "row"),
                 .remedy = "use a file made for this mesh"};
}

/// What rows, grids and meshes have besides fields.
bool is_taken(const std::string& name) {
    constexpr std::array<std::string_view, 7> taken{"x", "y", "z", "cell", "feature", "distance", "vtkValidPointMask"};
    return std::find(taken.begin(), taken.end(), name) != taken.end();
}

}  // namespace

Status add_fields(const std::vector<FieldFile>& files, Mesh& mesh) {
    for (const FieldFile& file : files) {
        Result<Field> field = io::read_field_file(file.name, file.path);
        if (!field) return field.error();
        const auto cells = is_of_cells(file, field->data.size() / static_cast<std::size_t>(field->components), mesh);
        if (!cells) return cells.error();
        std::vector<Field>& fields = *cells ? mesh.cell_fields : mesh.point_fields;
        if (sample::field_named(fields, file.name) != nullptr)
            return Error{.what = "a field of this name exists already",
                         .file = file.path,
                         .found = '"' + file.name + '"',
                         .remedy = "give it another name: --field OTHER=" + file.path};
        fields.push_back(std::move(*field));
    }
    for (Field& field : mesh.point_fields) {
        if (is_taken(field.name)) field.name = std::string(of_points) + field.name;
    }
    for (Field& field : mesh.cell_fields) {
        if (sample::field_named(mesh.point_fields, field.name) != nullptr || is_taken(field.name))
            field.name = std::string(of_cells) + field.name;
    }
    return Done{};
}

}  // namespace barycert::pipeline

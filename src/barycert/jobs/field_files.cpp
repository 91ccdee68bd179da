#include "barycert/jobs/field_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "barycert/io/fields/field_file.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/medit/medit_file.hpp"
#include "barycert/mesh/columns.hpp"
#include "barycert/sample/quantity/quantities.hpp"

namespace barycert::jobs {
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
        return Error{
            .what = "rows of field \"" + file.name + "\" could belong to nodes or to cells",
            .file = file.path,
            .found = "a mesh of " + std::to_string(nodes) + " nodes and the same number of cells",
            .remedy = "say which: FieldFile::Of::points or FieldFile::Of::cells instead of FieldFile::Of::either"};
    std::string expected = count(nodes, "row") + ", one for each node";
    if (file.of == FieldFile::Of::cells) expected = count(cells, "row") + ", one for each cell";
    if (file.of == FieldFile::Of::either) expected += ", or " + std::to_string(cells) + ", one for each cell";
    return Error{.what = "field \"" + file.name + '"',
                 .file = file.path,
                 .expected = expected,
                 .found = count(rows, "row"),
                 .remedy = "use a file made for this mesh"};
}

std::string names_of(const std::vector<Field>& fields) {
    std::string text;
    for (const Field& field : fields) text += (text.empty() ? "" : ", ") + base::quoted(field.name);
    return text.empty() ? "none" : text;
}

/// The points of a VTK file that has no cells, such as rows of `sample`, with their arrays.
Result<Mesh> points_as_mesh(const std::string& path, int dimension, const Error& fault) {
    if (!io::is_vtk_points_file(path)) return fault;
    Result<io::PointTable> table = io::read_vtk_table(path, true);
    if (!table) return fault;
    Mesh mesh;
    mesh.points = std::move(table->points);
    if (dimension == 2) {
        std::size_t to = 0;
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            if (i % 3 != 2) mesh.points[to++] = mesh.points[i];
        }
        mesh.points.resize(to);
        mesh.dimension = 2;
    }
    mesh.point_fields = std::move(table->fields);
    for (const Column& label : table->labels) {
        const auto* const integers = std::get_if<std::vector<std::int64_t>>(&label.values);
        if (integers == nullptr) continue;
        Field field{label.name, 1, {}};
        for (const std::int64_t i : *integers) {
            const auto x = static_cast<double>(i);
            if (x >= 0x1p63 || static_cast<std::int64_t>(x) != i) break;
            field.data.push_back(x);
        }
        if (field.data.size() == integers->size()) mesh.point_fields.push_back(std::move(field));
    }
    return mesh;
}

/// Whether it has fields of Medit, and no mesh.
bool is_solution(const std::string& path) {
    return io::has_suffix(path, ".sol") || io::has_suffix(path, ".solb");
}

/// The array file.column of the mesh in the file; file.of becomes what it is of.
Result<Field> read_array(const Mesh& mesh, FieldFile& file, Notes& notes) {
    const bool solution = is_solution(file.path);
    Result<Mesh> other = solution ? io::read_medit_fields(file.path, mesh.dimension)
                                  : read_mesh(file.path, {.faces = false, .neighbours = false});
    if (!other) other = points_as_mesh(file.path, mesh.dimension, other.error());
    if (!other) return other.error();
    if (solution) {
        notes.insert(notes.end(), other->notes.begin(), other->notes.end());
        const std::vector<std::string> names = sample::all_field_names(*other);
        if (file.column.empty() && names.size() == 1) file.column = names.front();
    }
    const bool may_be_points = file.of != FieldFile::Of::cells, may_be_cells = file.of != FieldFile::Of::points;
    const Field* const of_points = may_be_points ? sample::field_named(other->point_fields, file.column) : nullptr;
    const Field* const of_cells = may_be_cells ? sample::field_named(other->cell_fields, file.column) : nullptr;
    if (of_points != nullptr && of_cells != nullptr)
        return Error{
            .what = "there is an array of nodes and one of cells of that name",
            .file = file.path,
            .found = base::quoted(file.column),
            .remedy = "say which: FieldFile::Of::points or FieldFile::Of::cells instead of FieldFile::Of::either"};
    if (of_points == nullptr && of_cells == nullptr)
        return Error{
            .what = file.column.empty() ? "it is not said which array of the file is meant" : "no such array",
            .file = file.path,
            .expected = file.column.empty() ? "" : base::quoted(file.column),
            .found = "of nodes " + names_of(other->point_fields) + "; of cells " + names_of(other->cell_fields),
            .remedy = base::did_you_mean(file.column, sample::all_field_names(*other),
                                         "name one: job.field_files " + file.name + "=" + file.path + ":ARRAY")};
    file.of = of_points != nullptr ? FieldFile::Of::points : FieldFile::Of::cells;
    const bool same =
        solution || (other->points == mesh.points && (of_points != nullptr || other->cells == mesh.cells));
    const std::size_t components = static_cast<std::size_t>((of_points != nullptr ? of_points : of_cells)->components);
    const std::size_t rows = (of_points != nullptr ? of_points : of_cells)->data.size() / components;
    const bool fits = rows == (of_points != nullptr ? mesh.point_count() : mesh.cell_count());
    if (fits && !same)
        notes.push_back({Note::Kind::guessed,
                         "the " + std::string(of_points != nullptr ? "nodes" : "cells") +
                             " are in the order of the mesh, whose coordinates or cells are others: field " + file.name,
                         file.path, true});
    Field field = of_points != nullptr ? *of_points : *of_cells;
    field.name = file.name;
    return field;
}

const Column* label_named(const Mesh& mesh, std::string_view name) {
    for (const std::string& full : {std::string(name), std::string(of_cells) + std::string(name)}) {
        if (sample::field_named(mesh.point_fields, full) != nullptr ||
            sample::field_named(mesh.cell_fields, full) != nullptr)
            return nullptr;
    }
    for (int part = 0; part < 2; ++part) {
        for (const Column& label : mesh.cell_labels) {
            if (label.name == name || label.name == std::string(of_cells) + std::string(name)) return &label;
        }
        if (!name.starts_with(of_cells)) break;
        name.remove_prefix(of_cells.size());
    }
    return nullptr;
}

Status check_label(const Mesh& mesh, const Column& label) {
    if (label.size() != mesh.cell_count())
        return Error{.what = "a label of cells does not fit the mesh",
                     .expected = std::to_string(mesh.cell_count()) + " values",
                     .found = std::to_string(label.size()) + " of " + base::quoted(label.name)};
    const auto* const integers = std::get_if<std::vector<std::int64_t>>(&label.values);
    if (integers != nullptr && std::find(integers->begin(), integers->end(), mesh::no_label) != integers->end())
        return Error{.what = "a label of cells has the integer that stands for points outside",
                     .expected = "integers above " + std::to_string(mesh::no_label),
                     .found = base::quoted(label.name),
                     .remedy = "leave it out of job.fields"};
    return Done{};
}

}  // namespace

bool is_file_of_a_mesh(const std::string& path) {
    constexpr std::array<std::string_view, 5> of_meshes{".msh", ".mesh", ".meshb", ".node", ".ele"};
    constexpr std::array<std::string_view, 6> of_tables{".csv", ".txt", ".dat", ".xyz", ".tsv", ".npy"};
    const auto ends_as = [&](const auto& suffixes) {
        return std::any_of(suffixes.begin(), suffixes.end(),
                           [&](std::string_view suffix) { return io::has_suffix(path, suffix); });
    };
    if (io::is_vtk_points_file(path) || ends_as(of_meshes)) return true;
    std::error_code ignored;  // what is no regular file is not opened to look at it
    return !ends_as(of_tables) && std::filesystem::is_regular_file(path, ignored) && io::mesh_format(path);
}

bool is_name_of_rows(const std::string& name) {
    constexpr std::array<std::string_view, 7> taken{"x", "y", "z", "cell", "feature", "distance", "vtkValidPointMask"};
    return std::find(taken.begin(), taken.end(), name) != taken.end();
}

Result<Field> read_field(const Mesh& mesh, FieldFile& file, Notes& notes) {
    if (is_file_of_a_mesh(file.path) || is_solution(file.path)) return read_array(mesh, file, notes);
    return io::read_field_file(file.name, file.path, file.column, notes);
}

Result<FieldPlace> add_field(const FieldFile& file, Mesh& mesh, bool replace) {
    FieldFile of = file;
    Result<Field> field = read_field(mesh, of, mesh.notes);
    if (!field) return field.error();
    const auto cells = is_of_cells(of, field->data.size() / static_cast<std::size_t>(field->components), mesh);
    if (!cells) return cells.error();
    std::vector<Field>& fields = *cells ? mesh.cell_fields : mesh.point_fields;
    const std::string full = std::string(*cells ? of_cells : of_points) + file.name;
    for (std::size_t i = 0; replace && i < fields.size(); ++i) {
        if (fields[i].name != file.name && fields[i].name != full) continue;
        field->name = fields[i].name;
        fields[i] = std::move(*field);
        return FieldPlace{*cells, i};
    }
    if (sample::field_named(fields, file.name) != nullptr)
        return Error{.what = "a field of this name exists already",
                     .file = file.path,
                     .found = '"' + file.name + '"',
                     .remedy = "give it another name: job.field_files OTHER=" + file.path};
    fields.push_back(std::move(*field));
    return FieldPlace{*cells, fields.size() - 1};
}

void give_each_a_name(Mesh& mesh) {
    for (Field& field : mesh.point_fields) {
        if (is_name_of_rows(field.name)) field.name = std::string(of_points) + field.name;
    }
    for (Field& field : mesh.cell_fields) {
        if (sample::field_named(mesh.point_fields, field.name) != nullptr || is_name_of_rows(field.name))
            field.name = std::string(of_cells) + field.name;
    }
    for (Column& label : mesh.cell_labels) {
        if (sample::field_named(mesh.point_fields, label.name) != nullptr ||
            sample::field_named(mesh.cell_fields, label.name) != nullptr || is_name_of_rows(label.name))
            label.name = std::string(of_cells) + label.name;
    }
}

Status add_fields(const std::vector<FieldFile>& files, Mesh& mesh) {
    for (const FieldFile& file : files) {
        if (const Result<FieldPlace> added = add_field(file, mesh, false); !added) return added.error();
    }
    give_each_a_name(mesh);
    return Done{};
}

Result<std::vector<const Column*>> take_labels(const Mesh& mesh, std::vector<std::string>& names) {
    std::vector<const Column*> taken;
    if (mesh.cell_labels.empty()) return taken;
    std::vector<std::string> rest;
    for (const std::string& text : names) {
        if (const Column* const label = label_named(mesh, text)) {
            taken.push_back(label);
            continue;
        }
        std::string others;
        std::size_t begin = 0, labels = 0;
        for (bool more = true; more;) {
            const std::size_t comma = text.find(',', begin);
            const std::string part = text.substr(begin, comma - begin);
            more = comma != std::string::npos;
            begin = comma + 1;
            if (const Column* const label = label_named(mesh, part)) {
                taken.push_back(label);
                ++labels;
            } else {
                others += (others.empty() ? "" : ",") + part;
            }
        }
        if (labels == 0) others = text;
        if (labels == 0 || !others.empty()) rest.push_back(std::move(others));
    }
    for (std::size_t i = 0; i < taken.size(); ++i) {
        if (std::find(taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(i), taken[i]) !=
            taken.begin() + static_cast<std::ptrdiff_t>(i))
            return Error{.what = "a label of cells is named twice",
                         .found = base::quoted(taken[i]->name),
                         .remedy = "name it once in job.fields"};
        if (Status fits = check_label(mesh, *taken[i]); !fits) return fits.error();
    }
    names = std::move(rest);
    return taken;
}

void note_labels(const Mesh& mesh, const std::vector<std::string>& names, Notes& notes) {
    if (mesh.cell_labels.empty() || !names.empty()) return;
    std::string text = mesh.cell_labels.size() == 1 ? "label of cells " : "labels of cells ";
    for (std::size_t i = 0; i < mesh.cell_labels.size(); ++i) text += (i == 0 ? "" : ", ") + mesh.cell_labels[i].name;
    notes.push_back({Note::Kind::left_out, text + "; name fields and labels in job.fields to have them"});
}

}  // namespace barycert::jobs

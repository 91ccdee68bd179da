#include "app/jobs/field_files.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/job.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "io/fields/field_file.hpp"
#include "io/in_space.hpp"
#include "io/medit/medit.hpp"
#include "io/mesh_format.hpp"
#include "io/paths.hpp"
#include "io/point_table.hpp"
#include "io/tetgen/node_table.hpp"
#include "io/vtk/numbers.hpp"
#include "mesh/columns.hpp"
#include "mesh/part.hpp"
#include "mesh/pulling.hpp"
#include "mesh/sample/quantity/quantities.hpp"

namespace barycert::jobs {

using base::FormatKind;
using base::Use;
namespace {

constexpr std::string_view cell_prefix = "cell:", point_prefix = "point:";
constexpr const char* say_which =
    "say which: FieldFile::Of::points or FieldFile::Of::cells instead of FieldFile::Of::either";

bool is_of_cells(const FieldFile& file, std::size_t rows, std::size_t nodes, std::size_t cells) {
    const bool fits_nodes = rows == nodes && file.of != FieldFile::Of::cells;
    const bool fits_cells = rows == cells && file.of != FieldFile::Of::points;
    if (fits_nodes != fits_cells) return fits_cells;
    if (fits_nodes)
        refuse_member("field.ambiguous", "job.field_files", file.path,
                      "rows of field \"" + file.name + "\" could belong to nodes or to cells", "",
                      "a mesh of " + std::to_string(nodes) + " nodes and the same number of cells", say_which);
    std::string expected = counted(nodes, "row") + ", one for each node";
    if (file.of == FieldFile::Of::cells) expected = counted(cells, "row") + ", one for each cell";
    if (file.of == FieldFile::Of::either) expected += ", or " + std::to_string(cells) + ", one for each cell";
    refuse_member("field.size", "job.field_files", file.path, "field \"" + file.name + '"', expected,
                  counted(rows, "row"), "use a file made for this mesh");
}

[[noreturn]] void refuse_second(const FieldFile& file) {
    refuse_member("field.duplicate", "job.field_files", file.path, "a field of this name exists already", "",
                  '"' + file.name + '"', "give it another name: job.field_files OTHER=" + file.path);
}

std::string names_of(const std::vector<Field>& fields) {
    return listed(fields, [](const Field& field) { return base::quoted(field.name); });
}

/// The points of a VTK file that has no cells, such as rows of `sample`, with their arrays.
Result<Mesh> points_as_mesh(const std::string& path, int dimension, const Error& fault) {
    if (!io::is_vtk_file(path)) return fault;
    Result<io::PointTable> table = io::read_vtk_table(path, true);
    if (!table) return fault;
    Mesh mesh;
    mesh.points = std::move(table->points);
    mesh.dimension = dimension;
    if (dimension == 2) {
        const std::size_t count = mesh.points.size() / 3;
        for (std::size_t i = 1; i < count; ++i) std::copy_n(&mesh.points[3 * i], 2, &mesh.points[2 * i]);
        mesh.points.resize(2 * count);
    }
    mesh.point_fields = std::move(table->fields);
    for (const Column& label : table->labels) {
        const auto* const integers = std::get_if<std::vector<std::int64_t>>(&label.values);
        if (integers == nullptr) continue;
        Field field{label.name, 1, {}};
        const auto add = [&](std::int64_t i) { return io::convert_number(i, field.data.emplace_back()); };
        if (std::ranges::all_of(*integers, add)) mesh.point_fields.push_back(std::move(field));
    }
    return mesh;
}

bool is_file_of_a_mesh(const std::string& path) {
    if (base::is_read_as(path, Use::mesh)) return true;
    std::error_code ignored;  // what is no regular file is not opened to look at it
    return !base::is_read_as(path, Use::field) && std::filesystem::is_regular_file(path, ignored) &&
           io::mesh_format(path);
}

/// The array file.column of a mesh or surface, named as the field; file.of becomes what it is of.
Field array_named(const auto& from, FieldFile& file) {
    std::vector<std::string> all;
    for (const auto* fields : {&from.point_fields, &from.cell_fields}) {
        for (const Field& field : *fields) all.push_back(field.name);
    }
    const Field* const of_nodes =
        file.of == FieldFile::Of::cells ? nullptr : sample::field_named(from.point_fields, file.column);
    const Field* const of_cells =
        file.of == FieldFile::Of::points ? nullptr : sample::field_named(from.cell_fields, file.column);
    if (of_nodes != nullptr && of_cells != nullptr)
        refuse_member("field.ambiguous", "job.field_files", file.path,
                      "there is an array of nodes and one of cells of that name", "", base::quoted(file.column),
                      say_which);
    if (of_nodes == nullptr && of_cells == nullptr)
        refuse_member(file.column.empty() ? ErrorCode("field.ambiguous") : ErrorCode("field.unknown"),
                      "job.field_files", file.path,
                      file.column.empty() ? "it is not said which array of the file is meant" : "no such array",
                      file.column.empty() ? "" : base::quoted(file.column),
                      "of nodes " + names_of(from.point_fields) + "; of cells " + names_of(from.cell_fields),
                      base::did_you_mean(file.column, all,
                                         "name one: job.field_files " + file.name + "=" + file.path + ":ARRAY"));
    file.of = of_nodes != nullptr ? FieldFile::Of::points : FieldFile::Of::cells;
    Field field = of_nodes != nullptr ? *of_nodes : *of_cells;
    field.name = file.name;
    return field;
}

/// Fields of Medit; the only one is meant if none is named.
Mesh read_solution(FieldFile& file, int dimension, Notes& notes) {
    Mesh fields = io::read_medit_fields(file.path, dimension).value();
    notes.insert(notes.end(), fields.notes.begin(), fields.notes.end());
    const std::vector<std::string> names = sample::all_field_names(fields);
    if (file.column.empty() && names.size() == 1) file.column = names.front();
    return fields;
}

/// The array file.column of the mesh in the file; file.of becomes what it is of.
Field read_array(const Mesh& mesh, FieldInput& file, Notes& notes) {
    const bool solution = file.source == FieldSource::solution;
    const auto read = [&] {
        Result<Mesh> whole = read_mesh(file.path, {.faces = false, .neighbours = false});
        return (whole ? std::move(whole) : points_as_mesh(file.path, mesh.dimension, whole.error())).value();
    };
    const Mesh other = solution ? read_solution(file, mesh.dimension, notes) : read();
    Field field = array_named(other, file);
    const bool nodes = file.of == FieldFile::Of::points;
    const bool same = solution || (other.points == mesh.points && (nodes || other.cells == mesh.cells));
    const std::size_t rows = field.data.size() / static_cast<std::size_t>(field.components);
    if (rows == (nodes ? mesh.point_count() : mesh.cell_count()) && !same)
        notes.push_back({Note::Kind::guessed,
                         std::string("the ") + (nodes ? "nodes" : "cells") +
                             " are in the order of the mesh, whose coordinates or cells are others: field " + file.name,
                         file.path, true});
    return field;
}

bool has_field(const Mesh& mesh, std::string_view name) {
    return sample::field_named(mesh.point_fields, name) != nullptr ||
           sample::field_named(mesh.cell_fields, name) != nullptr;
}

/// A field of that name, with or without cell:, goes before.
const Column* label_named(const Mesh& mesh, std::string_view name) {
    const auto full = [](std::string_view of) { return std::string(cell_prefix) + std::string(of); };
    if (has_field(mesh, name) || has_field(mesh, full(name))) return nullptr;
    for (int part = 0; part < 2; ++part) {
        for (const Column& label : mesh.cell_labels) {
            if (label.name == name || label.name == full(name)) return &label;
        }
        if (!name.starts_with(cell_prefix)) break;
        name.remove_prefix(cell_prefix.size());
    }
    return nullptr;
}

void check_label(const Mesh& mesh, const Column& label) {
    if (label.size() != mesh.cell_count())
        refuse("field.size", "", "a label of cells does not fit the mesh",
               std::to_string(mesh.cell_count()) + " values",
               std::to_string(label.size()) + " of " + base::quoted(label.name));
    const auto* const integers = std::get_if<std::vector<std::int64_t>>(&label.values);
    if (integers != nullptr && std::find(integers->begin(), integers->end(), mesh::no_label) != integers->end())
        refuse_member("field.type", "job.fields", "", "a label of cells has the integer that stands for points outside",
                      "integers above " + std::to_string(mesh::no_label), base::quoted(label.name),
                      "leave it out of job.fields");
}

}  // namespace

FieldInput field_input(FieldFile file) {
    const auto source = [](const std::string& path) {
        if (base::kind_of(path) == FormatKind::medit_fields) return FieldSource::solution;
        if (is_file_of_a_mesh(path)) return FieldSource::mesh;
        return io::is_surface_file(path) ? FieldSource::surface : FieldSource::rows;
    };
    const FieldSource is = source(file.path);
    return {std::move(file), is};
}

Field read_field(const Mesh& mesh, FieldInput& file, Notes& notes) {
    if (file.source == FieldSource::mesh || file.source == FieldSource::solution) return read_array(mesh, file, notes);
    return io::read_field_file(file.name, file.path, file.column, notes).value();
}

void by_parts(const Mesh& mesh, const FieldInput& file, Field& field) {
    const std::size_t whole = mesh.whole_count() * static_cast<std::size_t>(field.components);
    if (mesh.shapes.count() != 0 && file.source != FieldSource::mesh && field.data.size() == whole)
        field = mesh::rows_of(field, mesh::whole_of_parts(mesh));
}

FieldPlace add_field(FieldInput file, Mesh& mesh, bool replace) {
    Field field = read_field(mesh, file, mesh.notes);
    const std::size_t rows = field.data.size() / static_cast<std::size_t>(field.components);
    // Files of meshes were cut like this one.
    const bool parts = file.source == FieldSource::mesh;
    const bool cells = is_of_cells(file, rows, mesh.point_count(), parts ? mesh.cell_count() : mesh.whole_count());
    if (cells) by_parts(mesh, file, field);
    std::vector<Field>& fields = cells ? mesh.cell_fields : mesh.point_fields;
    const std::string full = std::string(cells ? cell_prefix : point_prefix) + file.name;
    for (std::size_t i = 0; replace && i < fields.size(); ++i) {
        if (fields[i].name != file.name && fields[i].name != full) continue;
        field.name = fields[i].name;
        fields[i] = std::move(field);
        return {cells, i};
    }
    if (sample::field_named(fields, file.name) != nullptr) refuse_second(file);
    fields.push_back(std::move(field));
    return {cells, fields.size() - 1};
}

void give_each_a_name(std::vector<Field>& of_nodes, std::vector<Field>& of_cells) {
    for (Field& field : of_nodes) {
        if (is_name_of_rows(field.name)) field.name.insert(0, point_prefix);
    }
    for (Field& field : of_cells) {
        if (is_name_of_rows(field.name) || sample::field_named(of_nodes, field.name) != nullptr)
            field.name.insert(0, cell_prefix);
    }
}

void give_each_a_name(Mesh& mesh) {
    give_each_a_name(mesh.point_fields, mesh.cell_fields);
    for (Column& label : mesh.cell_labels) {
        if (is_name_of_rows(label.name) || has_field(mesh, label.name)) label.name.insert(0, cell_prefix);
    }
}

void add_fields(const std::vector<FieldFile>& files, Mesh& mesh) {
    for (const FieldFile& file : files) add_field(field_input(file), mesh, false);
    give_each_a_name(mesh);
}

void add_fields(const std::vector<FieldFile>& files, Surface& s) {
    for (const FieldFile& of : files) {
        FieldInput file = field_input(of);
        Field field;
        // An array is of the triangles, as they are read; rows are of the facets.
        const bool array = file.source != FieldSource::rows;
        if (file.source == FieldSource::solution) {
            field = array_named(read_solution(file, 3, s.notes), file);
        } else if (array) {
            const Surface other = read_surface(file.path).value();
            field = array_named(other, file);
            if (other.points != s.points)
                s.notes.push_back(
                    {Note::Kind::guessed,
                     "the nodes are in the order of the surface, whose coordinates are others: field " + file.name,
                     file.path, true});
        } else {
            field = io::read_field_file(file.name, file.path, file.column, s.notes).value();
        }
        const auto width = static_cast<std::size_t>(field.components);
        const bool of_cells =
            is_of_cells(file, field.data.size() / width, s.point_count(), array ? s.cell_count() : s.facet_total());
        std::vector<Field>& fields = of_cells ? s.cell_fields : s.point_fields;
        if (sample::field_named(fields, file.name) != nullptr) refuse_second(file);
        if (of_cells && !array && !s.facets.empty()) {
            std::vector<Mesh::Index> rows = s.facets;
            for (std::size_t t = 0; s.facet_count == 0 && t < rows.size(); ++t)
                rows[t] = t == 0 ? 0 : rows[t - 1] + (s.facets[t] != s.facets[t - 1] ? 1 : 0);
            field = mesh::rows_of(field, rows);
        }
        fields.push_back(std::move(field));
    }
    give_each_a_name(s.point_fields, s.cell_fields);
}

FieldChoice field_of_numbers(const Mesh& mesh, const std::string& name, std::deque<Field>& made, Notes& notes) {
    std::vector<FieldChoice> one{sample::number_named(mesh, name).value()};
    sample::make_all_fields(mesh, one, made, notes).value();
    return one.front();
}

std::vector<std::string> with_other_names(const std::vector<std::string>& names, const OtherNames& other) {
    std::vector<std::string> all;
    for (const std::string& text : names) {
        std::vector<std::string> parts;
        bool some = false;
        const auto add = [&](const std::string& name) {
            const auto others = other(name);
            some = some || others;
            const std::vector<std::string> put = others.value_or(std::vector{name});
            parts.insert(parts.end(), put.begin(), put.end());
            return true;
        };
        add(text);
        if (!some) {
            parts.clear();
            sample::for_names(text, add);
        }
        if (!some) parts = {text};
        all.insert(all.end(), parts.begin(), parts.end());
    }
    return all;
}

std::vector<const Column*> take_labels(const Mesh& mesh, std::vector<std::string>& names) {
    std::vector<const Column*> taken;
    if (mesh.cell_labels.empty()) return taken;
    names = with_other_names(names, [&](const std::string& name) -> std::optional<std::vector<std::string>> {
        const Column* const label = label_named(mesh, name);
        if (label == nullptr) return std::nullopt;
        taken.push_back(label);
        return std::vector<std::string>();
    });
    for (auto label = taken.begin(); label != taken.end(); ++label) {
        if (std::find(taken.begin(), label, *label) != label)
            refuse_member("field.duplicate", "job.fields", "", "a label of cells is named twice", "",
                          base::quoted((*label)->name), "name it once in job.fields");
        check_label(mesh, **label);
    }
    return taken;
}

}  // namespace barycert::jobs

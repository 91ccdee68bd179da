/// Fields from files, among those of the mesh; and labels of its cells, among the fields that a job names.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/figure.hpp"
#include "barycert/job.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"

namespace barycert::jobs {

/// True for names that outputs have besides fields: x, y, z, cell, feature, distance, vtkValidPointMask.
inline bool is_name_of_rows(const std::string& name) {
    constexpr std::array<std::string_view, 7> taken{"x", "y", "z", "cell", "feature", "distance", "vtkValidPointMask"};
    return std::ranges::find(taken, name) != taken.end();
}

/// What a file of a field is, as its suffix says, else its content (.dat is a table, if Tecplot's, too).
enum class FieldSource : std::uint8_t {
    rows,      ///< numbers of its own
    solution,  ///< fields of Medit, and no mesh
    mesh,      ///< arrays of nodes and cells
    surface,   ///< the same of a surface
};

/// A file of a field that knows what it is.
struct FieldInput : FieldFile {
    FieldSource source = FieldSource::rows;
};
FieldInput field_input(FieldFile file);

struct FieldPlace {
    bool of_cells = false;
    std::size_t number = 0;
};

/// The field in the file, any number of rows. file.of becomes what it is of, where the file tells.
Field read_field(const Mesh& mesh, FieldInput& file, Notes& notes);

/// Rows of whole cells become rows of their parts, but for a field from a file of a mesh, which was cut like this one.
void by_parts(const Mesh& mesh, const FieldInput& file, Field& field);

/// Adds the field of a file to the mesh, and to its notes what is to be told of it; with `replace`, in the place of one
/// of that name. Refused: a name twice; rows that fit neither nodes nor cells, or both unsaid.
FieldPlace add_field(FieldInput file, Mesh& mesh, bool replace);

/// Adds the fields of all files to the surface: a row for each node, or for each cell as users count them.
void add_fields(const std::vector<FieldFile>& files, Surface& surface);

/// So that columns have one name each, a field of cells that has the name of one of nodes is called cell:NAME from then
/// on, and a field with a name that rows have themselves point:NAME or cell:NAME.
void give_each_a_name(Mesh& mesh);
void give_each_a_name(std::vector<Field>& of_nodes, std::vector<Field>& of_cells);

void add_fields(const std::vector<FieldFile>& files, Mesh& mesh);

/// The field of nodes or cells that a name means, one number each; in `made` where the mesh has none.
FieldChoice field_of_numbers(const Mesh& mesh, const std::string& name, std::deque<Field>& made, Notes& notes);

/// The names, with those of other(name) where there are such. A text may hold several names, or a name commas.
using OtherNames = std::function<std::optional<std::vector<std::string>>(const std::string& name)>;
std::vector<std::string> with_other_names(const std::vector<std::string>& names, const OtherNames& other);

/// The labels that are named, in their order; they are removed from `names`. A field goes before a label of its name;
/// cell:NAME may stand for NAME. Refused: one named twice, that does not fit, or has mesh::no_label.
std::vector<const Column*> take_labels(const Mesh& mesh, std::vector<std::string>& names);

}  // namespace barycert::jobs

/// Fields from files, among those of the mesh; and labels of its cells (Mesh::cell_labels), among the fields that a job
/// names.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "barycert/jobs.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace barycert::jobs {

/// True for the names that rows, grids and meshes have besides fields: x, y, z, cell, feature, distance,
/// vtkValidPointMask.
bool is_name_of_rows(const std::string& name);

/// Whether fields are read from such a file as arrays of a mesh: by its suffix, else by what it is. Files that end as
/// tables do are none: .dat, which is Tecplot's, too, among them.
bool is_file_of_a_mesh(const std::string& path);

/// Where a field of the mesh is.
struct FieldPlace {
    bool of_cells = false;
    std::size_t number = 0;
};

/// The field in the file, any number of rows. file.of becomes what it is of, where the file tells. Errors: those of
/// read_field_file and read_mesh; an array that is not there.
Result<Field> read_field(const Mesh& mesh, FieldFile& file, Notes& notes);

/// Adds the field of a file to the mesh, and to its notes what is to be told of it; with `replace`, in the place of one
/// of that name. Errors: those of read_field; a name that there is already; a number of rows that is that of neither
/// nodes nor cells, or, where it is not said which, of both.
Result<FieldPlace> add_field(const FieldFile& file, Mesh& mesh, bool replace);

/// So that columns have one name each, a field of cells that has the name of one of nodes is called cell:NAME from then
/// on, and a field with a name that rows have themselves (x, y, z, cell, feature, distance, vtkValidPointMask)
/// point:NAME or cell:NAME.
void give_each_a_name(Mesh& mesh);

/// Adds the fields of all files, and gives each a name.
Status add_fields(const std::vector<FieldFile>& files, Mesh& mesh);

/// The field of nodes or cells that a name means, one number each; in `made` where the mesh has none.
Result<FieldChoice> field_of_numbers(const Mesh& mesh, const std::string& name, std::deque<Field>& made, Notes& notes);

/// The labels that are named, in their order; they are removed from `names`, in which one text may hold several names,
/// with commas between them. A field goes before a label of its name; cell:NAME may stand for NAME. Errors: a label
/// that is named twice; one that does not fit the mesh; integers among which is the one that stands for "outside".
Result<std::vector<const Column*>> take_labels(const Mesh& mesh, std::vector<std::string>& names);

/// Says which labels there are, if there are some and nothing is named.
void note_labels(const Mesh& mesh, const std::vector<std::string>& names, Notes& notes);

}  // namespace barycert::jobs

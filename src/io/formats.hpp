/// The sources and sinks by format.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "files/suffix.hpp"

namespace barycert::io {

using base::FormatKind;

/// The format of rows or points by the suffix: csv, npy, node or vtu; "-" is CSV. Error: another suffix.
Result<FormatKind> format_of_table(const std::string& path);

/// The same for points: .txt .dat .xyz .tsv are CSV, as pipes and devices; first bytes tell a file without a suffix.
Result<FormatKind> format_of_points(const std::string& path);

using base::has_one_of;
using base::has_suffix;
using base::lower;
using base::stem_of;
using base::suffix_of;
using base::whole_number;
using base::without_gz;

[[noreturn]] inline void refuse_line(ErrorCode code, std::string file, std::size_t line, std::string what,
                                     std::string expected = {}, std::string found = {}, std::string remedy = {}) {
    throw Exception(
        {code, std::move(what), std::move(file), line, std::move(expected), std::move(found), std::move(remedy)});
}
[[noreturn]] inline void refuse_file(ErrorCode code, std::string file, std::string what, std::string expected = {},
                                     std::string found = {}, std::string remedy = {}) {
    refuse_line(code, std::move(file), 0, std::move(what), std::move(expected), std::move(found), std::move(remedy));
}

/// read() in the environment of exact results. Error: what it throws as an Exception; memory is short.
template <class Read>
auto read_guarded(const std::string& path, const Read& read) -> decltype(Result(read())) try {
    const ExactEnvironment environment;
    return read();
} catch (const Exception& problem) {
    return problem.error();
} catch (const std::bad_alloc&) {
    return base::too_little_memory(path);
}

/// Calls f(); returns what it throws as an Exception as a Status.
template <class F>
Status status_of(const F& f) try {
    f();
    return Done{};
} catch (const Exception& problem) {
    return problem.error();
}

/// The line of a text in which `at` lies, from 1.
inline std::size_t line_of(std::string_view text, const char* at) {
    return static_cast<std::size_t>(std::count(text.data(), at, '\n')) + 1;
}

inline bool exists(const std::string& path) {
    return base::file_exists(path);
}

/// Whether it is the standard input, a pipe or a device.
bool is_read_once(const std::string& path);

/// The path, or with .gz at its end where there is only such a file.
inline std::string plain_or_packed(const std::string& path) {
    return !exists(path) && exists(path + ".gz") ? path + ".gz" : path;
}

Error unknown_suffix(const std::string& path, std::string what, std::string expected, std::string remedy);

inline bool is_vtk_file(std::string_view path) {
    return base::is_vtk(base::kind_of(path));
}

// As open_points and open_table. Errors are thrown as Exceptions.
using Source = std::unique_ptr<PointSource>;
Source open_csv_source(const std::string& path, int dimension, const PointOptions& options);
Source open_npy_source(const std::string& path, int dimension, const PointOptions& options);
Source open_node_source(const std::string& path, int dimension, const PointOptions& options);

std::unique_ptr<TableSink> open_csv_sink(const std::string& path, const TableFormat& format);
std::unique_ptr<TableSink> open_npy_sink(const std::string& path, const TableFormat& format);

/// Refuses rows whose spans and columns do not fit together and the format, and the feature degenerate.
Status check_rows(const TableView& rows, const TableFormat& format, const std::string& path);

/// Data of a file of triangles off the plane z = 0 that the mesh in the plane, of their x and y, does not have.
struct InSpace {
    std::vector<double> points;       ///< 3 coordinates a node; empty: it is a mesh in the plane
    std::vector<Mesh::Index> facets;  ///< as of Surface
};
/// By the end of the path: one of polygons, or .vtp.
bool is_surface_file(const std::string& path);
Result<Mesh> read_mesh_in_space(const std::string& path, const ReadOptions& options, InSpace* space);
Result<Mesh> read_vtk_in_space(const std::string& path, const ReadOptions& options, InSpace* space);
Result<Mesh> read_gmsh_in_space(const std::string& path, const GmshReadOptions& options, InSpace* space);

/// The number of the step that is chosen. Error: there is none such.
Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path);

Error no_series(const std::string& path);

enum class MeshFormat : std::uint8_t {
    tetgen,  ///< and Triangle: several files of one stem
    vtk,
    gmsh,
    medit,
    by_meshio,  ///< converted: io/converted
};

/// Returns the format of a mesh to read: by its first bytes, else the end of its name. Error: none is recognised, or
/// one that is not read.
Result<MeshFormat> mesh_format(const std::string& path);

std::string meshio_format(const std::string& path);

/// Returns the format of a mesh to write: by the end of its name. Error: no such format.
Result<MeshFormat> mesh_output_format(const std::string& path);

/// Tells that so many cells of the mesh are taken by their corners, if there are such.
void note_by_corners(std::size_t cells, const std::string& path, Mesh& mesh);

/// As mesh::cut_into_simplices(), and notes it; nothing without shapes. Throws: a polyhedron that is not closed.
void cut_into_simplices(Mesh& mesh, const std::string& path);

/// Adds to `notes`, once, which of these names are lost in a .node or .ele file: it has attribute0, attribute1, ...
void note_lost_names(const std::vector<std::string>& columns, const char* file, Notes& notes);

/// One that is not read as a mesh, by the end of the path; nullptr if it is none of these.
const base::Format* other_format_by_suffix(std::string_view path);

/// By its first bytes; nullptr if they could be anything. `strict`: only what cannot be taken for another file.
const base::Format* other_format_by_content(std::string_view head, std::string_view path, bool strict);

std::string_view first_word(std::string_view text, char comment);

/// Returns the error that the file is not read, with a remedy.
Error other_format_error(const base::Format& format, const std::string& path);

/// The command that makes one grid of the pieces of a file, in backquotes.
std::string one_grid_command(const std::string& path);

/// How to cut the cells of a file of VTK into simplices.
std::string to_simplices(const std::string& path);

/// Whether all points lie in that plane; what to do where it is not z = 0. `path`: if it holds linear triangles.
bool in_plane(std::span<const double> points, double z = 0);
std::string plane_remedy(std::span<const double> points, const std::string& path);

/// The command that writes a file of Gmsh anew, in version 4.1; in backquotes.
std::string gmsh_command(const std::string& path);

/// "a file of Gmsh (.msh), ...": what is read as a mesh.
inline std::string formats_read() {
    return "a file of " + base::families_read(base::Use::mesh) + ", or one that meshio reads";
}

/// Reads a mesh by way of meshio, whose name of the format is `format`: nodes and cells in its order, which is told
/// with its version and what it printed. Error: run_meshio(); meshio cannot read the file; read_vtk(); what comes back
/// differs from what meshio counted.
Result<Mesh> read_converted(const std::string& path, const std::string& format, InSpace* space);

/// By the first bytes of a file, behind a byte-order mark.
bool is_medit(std::string_view head);

/// Reads .mesh and .meshb of version 1 to 4.
///
/// - Tetrahedra make a mesh of dimension 3, and its Triangles are the faces, with their references as markers. Where
///   there are no cells of dimension 3, triangles make one of dimension 2; then z is 0, if there is one. If all are of
///   order 2 (TetrahedraP2, TrianglesP2), their mid-edge nodes are told by the points.
/// - Hexahedra, Prisms, Pyramids, Quadrilaterals, and cells of several sections or of a higher order are taken by their
///   corners and cut into simplices; cells count on from section to section.
/// - References of nodes are point markers, those of cells the cell field "medit:ref"; absent where all are 0.
/// - SolAt... are fields, as in read_medit_fields.
/// - What else there is is left out, with a Note.
///
/// Error: what the format does not have; a coordinate not finite; an unknown node; no cells; polygons off the plane.
Result<Mesh> read_medit(const std::string& path, const ReadOptions& options, InSpace* space = nullptr);

/// Notes and fields of .sol and .solb files, solution0, solution1, ..., for a mesh of that dimension, in an empty one.
Result<Mesh> read_medit_fields(const std::string& path, int dimension);

/// The path and, of XDMF, the file of numbers that lies beside it.
std::vector<std::string> converted_files(const std::string& path);

/// Points that are in memory, with what their file says of each.
struct PointTable : PointData {
    std::vector<std::string> unread;  ///< columns that nobody asked for, by name
    bool of_nodes = false;            ///< of a .node file
};

/// The nodes of a .node file as points, and the name of the file that was read.
struct NodeTable {
    PointTable points;
    std::string file;
};
NodeTable read_node_table(const std::string& path, int dimension, const PointOptions& options);

/// As open_points chooses among columns: the coordinates x, y[, z]; NAME, or NAME.0, NAME.1, ... of each field; labels.
Source points_of_table(PointTable table, const std::string& file, int dimension, const PointOptions& options);

/// Points and point arrays: integers of one component and texts as labels. Without `arrays` those of XML are unread.
Result<PointTable> read_vtk_table(const std::string& path, bool arrays,
                                  NonfinitePoints nonfinite = NonfinitePoints::error);

/// One field from a file of its own: any number of rows, all of as many components.
///
/// Text: a row a line, numbers between blanks, tabs, commas or semicolons, rounded to nearest; nan and inf are taken as
/// they are. Blank lines, and what follows a #, are passed over. With `column`, CSV, whose first line settles the
/// separator as in files of points: the column of that name or number (from 1), or NAME.0, NAME.1, ... NPY (by the
/// suffix): an array of shape (rows,) or (rows, components) of floats or integers, of either byte order and either
/// order of axes; with `column` a field of a structured array, or the number of a column from 1. Errors: a word that is
/// no number; rows of different lengths; an integer that is no double; no such column or array.
Result<Field> read_field_file(const std::string& name, const std::string& path, const std::string& column,
                              Notes& notes);

}  // namespace barycert::io

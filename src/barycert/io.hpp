/// Files in and out: meshes of TetGen and Triangle, streams of points, rows of results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "barycert/vtk.hpp"

namespace barycert {

// Meshes.

struct ReadOptions {
    bool faces = true;       ///< read STEM.face if it is there, and Medit's triangles beside tetrahedra
    bool neighbours = true;  ///< read STEM.neigh if it is there
    int threads = 0;         ///< 0: as many as the machine has
    StepChoice step = {};    ///< of a series; Error: one is chosen, and there is no series
};

/// Reads a mesh: TetGen's or Triangle's files by their stem or any one of them; a file of Gmsh, .msh (gmsh.hpp), or
/// Medit, .mesh and .meshb; and VTK's .vtu, .vtk, .vtp, .pvtu, .vtm, .pvd and .vtu.series (vtk.hpp). The format is told
/// by the first bytes, or else by the suffix. Returns an Error if it cannot be read: a file of another format is named
/// as what it is, with the command that converts it.
Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options = {});

/// The paths of all files that read_mesh(path) may read.
std::vector<std::string> mesh_files(const std::string& path);

/// STEM of STEM.node, STEM.ele, STEM.face or STEM.neigh; any other path as it is.
std::string tetgen_stem(const std::string& path);

/// The paths of the files that a mesh may be in, by its stem or any one of them: STEM.node, .ele, .face, .neigh.
std::vector<std::string> tetgen_files(const std::string& path);

/// Reads STEM.node and STEM.ele. `path` is the stem or the path of any one of its files.
Result<Mesh> read_tetgen(const std::string& path, const ReadOptions& options = {});

struct WriteOptions {
    std::string comment = {};     ///< TetGen's files: the last line of each, after "# "; empty: none
    VtkData data = VtkData::raw;  ///< VTK's files
};

/// Writes STEM.node and STEM.ele, and STEM.face and STEM.neigh where the mesh has faces and neighbours. Every double
/// reads back to the same bits. No file is left half-written.
Status write_tetgen(const Mesh& mesh, const std::string& stem, const WriteOptions& options = {});

/// Writes the mesh as its path ends: .msh (gmsh.hpp), .vtu and .vtk (vtk.hpp), and TetGen's files by .node, .ele or a
/// stem. Error: another suffix; as these writers.
Status write_mesh(const Mesh& mesh, const std::string& path, const WriteOptions& options = {});

/// The paths of the files that write_mesh may write, or replace: the path itself, or STEM.node, .ele, .face and .neigh.
/// Error: another suffix.
Result<std::vector<std::string>> written_mesh_files(const std::string& path);

// Streams of points: CSV, NPY and .node files, block by block, so that memory does not grow with their number; the
// nodes of meshes.
//
// Coordinates are finite doubles (but see PointOptions) in the file's own unit; decimal numbers are rounded to nearest,
// ties to even. What cannot be read without a guess is an Error, with file, line (of text), what was expected and
// found, a remedy.
//
// Which columns are the coordinates: those that PointOptions names; or x, y, z; Points:0, Points:1, Points:2; or
// Points_0, Points_1, Points_2, in any case and any place; or, in a file that names none, all columns, if they are as
// many as the dimension. Beside a mesh in the plane a column z must be 0 throughout.
//
// CSV    (also .txt .dat .xyz .tsv, and what comes from a pipe) One point a line, in UTF-8. The first line settles the
// separator: the first of semicolon, comma and tab that
//        it holds outside quotes, or else blanks. It is a header if it names the coordinates, or if none of its fields
//        is a number. Every line has as many fields as the first. Fields may stand in double quotes. Blank lines, and
//        lines that begin with #, are passed over. Lines end in LF or CR LF; the last may lack its end, but not where
//        the file would end within a value that is read: 0.2 may be the beginning of 0.25. At most 1 MiB a line. A
//        named pipe is waited for.
// NPY    Versions 1 to 3; numbers of any integer or floating type up to 64 bits, of either byte order. One array of
//        shape (n, columns), in C or Fortran order, or a structured one of shape (n,): a field of several numbers is
//        the columns NAME.0, NAME.1, ... An integer that no double represents is an Error.
// .node  TetGen's and Triangle's grammar, see io/tetgen/tetgen_reader.cpp. Columns: attribute0, attribute1, ...,
// marker. meshes Any file that read_mesh takes. Columns: the fields of nodes, and marker. All of it is in memory.

/// Which columns of a file of points are taken for what.
struct PointOptions {
    /// Those of the coordinates, in the order of the axes: names, or numbers from 1. One text may hold several, with
    /// commas between them. Empty: see above.
    std::vector<std::string> columns = {};

    /// Those that are carried through: names, or "all" of the others; NEW=NAME gives a column another name. Columns of
    /// files that name none are column1, column2, ... One text may hold several, with commas between them.
    std::vector<std::string> keep = {};

    /// nan: points that are not finite are given as they are, and an empty field of a CSV file as NaN. Not for nodes of
    /// meshes, and not for a z that must be 0.
    NonfinitePoints nonfinite_points = NonfinitePoints::error;

    /// Of CSV: columns that are carried through become integers or numbers, if all their values are; texts otherwise.
    /// The file is read twice, and must not be a pipe. Without it they are texts, as they stand in the file.
    bool typed = false;
};

/// Points, block by block.
class PointSource {
public:
    virtual ~PointSource();

    /// Coordinates a point: 2 or 3, as asked for when opened.
    virtual int dimension() const = 0;

    /// The number of points, where it is known before the end.
    virtual std::optional<std::uint64_t> count() const = 0;

    /// Appends the coordinates of up to `max_points` points to `out`, point after point, and returns how many: fewer
    /// than `max_points` only at the end, 0 after it. On an Error the points before the fault may have been appended;
    /// the source gives nothing but that Error from then on.
    virtual Result<std::size_t> read(std::size_t max_points, std::vector<double>& out) = 0;

    /// The columns that are carried through.
    virtual std::vector<ColumnFormat> carried() const { return {}; }

    /// Puts the carried columns of the points of the last read() into `columns`, a value a point; afterwards they are
    /// the source's no more. The memory of what was in `columns` may be used again.
    virtual void take_carried(std::vector<Column>& columns) { columns.clear(); }

    /// What of the file is left out, converted or guessed. Known when opened.
    virtual Notes notes() const { return {}; }
};

/// Opens the points of a CSV, NPY or .node file, of a mesh, or of VTK's files with or without cells (read_vtk_points in
/// vtk.hpp); "-" is CSV from the standard input. `dimension`: 2 or 3. Returns an Error if the file cannot be read, is
/// of an unknown kind, or has another dimension, or if there are no such columns.
Result<std::unique_ptr<PointSource>> open_points(const std::string& path, int dimension,
                                                 const PointOptions& options = {});

/// Points from memory, as they are. An incomplete last point is left out.
std::unique_ptr<PointSource> memory_points(std::vector<double> points, int dimension);

// Sampled values, row by row, into CSV and NPY files that appear whole or not at all.
//
// CSV  A header line x,y[,z],cell,feature,NAME...[,distance][,CARRIED...], then a line a row. Numbers are in the
// shortest
//      decimal form that reads back to the same bits; nan, inf, -inf. Names and texts that hold a comma, a quote or a
//      line end, or that begin or end with a blank, are quoted, and quotes in them doubled.
// NPY  One structured array: x, y[, z] float64, cell int64, feature bytes of 8, each column float64, [distance
//      float64], carried columns int64, float64, or text: U, characters, if ColumnFormat::max_characters is not 0, else
//      S, bytes; all little-endian. Names must differ from one another; UTF-8.

/// What a file of rows has: points, cell, feature, the columns of the fields, and perhaps distances.
struct TableFormat {
    int dimension = 3;
    std::vector<TableField> fields = {};
    bool distances = false;                  ///< a column `distance` after the fields
    std::vector<ColumnFormat> carried = {};  ///< columns that are carried through: the last ones
    VtkData vtk_data = VtkData::raw;         ///< of a .vtu file

    std::vector<std::string> columns() const { return column_names(fields); }
};

/// Takes rows, block by block: a file, a picture, a mesh. Without a commit() nothing appears, except on the standard
/// output.
class TableSink {
public:
    virtual ~TableSink();

    /// Appends the rows. Error: disk full and the like, or spans whose sizes do not fit together; then nothing appears.
    virtual Status write(const TableView& rows) = 0;

    /// Makes the file appear, if nothing failed. Nothing may be written after it.
    virtual Status commit() = 0;
};

/// Opens a CSV, NPY or .vtu file by the suffix of the path; "-" is CSV on the standard output. Returns an Error if the
/// suffix is another one, the path cannot be written, or NPY names would be refused by NumPy.
Result<std::unique_ptr<TableSink>> open_table(const std::string& path, const TableFormat& format);

}  // namespace barycert

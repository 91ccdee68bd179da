/// Streams of points: CSV and NPY files, block by block, so that memory does not grow with their number; the nodes of
/// .node files and meshes.
///
/// Coordinates are finite doubles (but see PointOptions); decimal numbers are rounded to nearest, ties to even. A file
/// that cannot be read without a guess is an Error.
///
/// The coordinates are the columns that PointOptions names; or x, y, z; Points:0, Points:1, Points:2; or Points_0,
/// Points_1, Points_2, in any case and any place; or, in a file that names none, all columns, if they are as many as
/// the dimension. Beside a mesh in the plane a column z must be 0 throughout.
///
/// CSV    (also .txt .dat .xyz .tsv, and what comes from a pipe) One point a line, in UTF-8. The first line settles the
///        separator: the first of semicolon, comma and tab that it holds outside quotes, or else blanks. It is a header
///        if it names the coordinates, or if none of its fields is a number. Every line has as many fields. Fields may
///        stand in double quotes. Blank lines, and lines that begin with #, are passed over. Lines end in LF or CR LF;
///        the last may lack its end, but not where the file would end within a value that is read: 0.2 may be the
///        beginning of 0.25. At most 1 MiB a line. A named pipe is waited for.
/// NPY    Versions 1 to 3; numbers of any integer or floating type up to 64 bits, of either byte order. One array of
///        shape (n, columns), in C or Fortran order, or a structured one of shape (n,): a field of several numbers is
///        the columns NAME.0, NAME.1, ... An integer that no double represents is an Error.
/// .node  TetGen's and Triangle's grammar, see io/tetgen/tetgen_reader.cpp. Columns: attribute0, attribute1, ..., and
///        marker. All of it is in memory.
/// meshes Any file that read_mesh takes. Columns: the fields of nodes, and marker. All of it is in memory.
///
/// Example:
///
///     std::unique_ptr<PointSource> points = open_points("points.csv", 3).value();
///     std::vector<double> block;
///     while (points->read(1000, block).value() != 0) block.clear();  // x, y, z of up to 1000 points
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"

namespace barycert {

/// Which columns of a file of points are taken for what.
struct PointOptions {
    /// Columns of the coordinates, in the order of the axes: names, or numbers from 1. One text may hold several, with
    /// commas between them. Empty: see above.
    std::vector<std::string> columns = {};

    /// Columns to copy into the rows, likewise; "all" copies all but the coordinates; NEW=NAME renames one. Columns of
    /// files that name none are column1, column2, ...
    std::vector<std::string> keep = {};

    /// nan: points that are not finite are passed on as they are, and an empty field of a CSV file is NaN. Nodes of
    /// meshes, and a z that must be 0, stay errors.
    NonfinitePoints nonfinite_points = NonfinitePoints::error;

    /// For CSV: carried columns become integers or numbers, if all their values are; texts otherwise. The file is read
    /// twice, and must not be a pipe. If false, carried columns are texts, as they stand in the file.
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

    /// Appends the coordinates of up to `max_points` points to `out` and returns how many: fewer only at the end, 0
    /// after it. On an Error the points before the fault may have been appended; it comes again from then on.
    virtual Result<std::size_t> read(std::size_t max_points, std::vector<double>& out) = 0;

    /// The columns that are carried through.
    virtual std::vector<ColumnFormat> carried() const { return {}; }

    /// Moves the carried columns of the points of the last read() to `columns`, a value a point.
    virtual void take_carried(std::vector<Column>& columns) { columns.clear(); }

    /// Returns what of the file is left out, converted or guessed. Known when opened.
    virtual Notes notes() const { return {}; }
};

/// Opens the points of a CSV, NPY or .node file, of a mesh, or of VTK's files with or without cells (read_vtk_points);
/// "-" is CSV from the standard input. `dimension`: 2 or 3. Error: the file cannot be read, is of an unknown kind, or
/// has another dimension; there are no such columns.
Result<std::unique_ptr<PointSource>> open_points(const std::string& path, int dimension,
                                                 const PointOptions& options = {});

/// Points from memory, as they are. An incomplete last point is left out.
std::unique_ptr<PointSource> memory_points(std::vector<double> points, int dimension);

}  // namespace barycert

/// Streams of points: CSV, NPY and .node files, block by block, so that memory does not grow with their number.
///
/// Coordinates are finite doubles in the file's own unit; decimal numbers are rounded to nearest, ties to even.
/// What cannot be read without a guess is an Error, with file, line (of text), what was expected and found, a remedy.
///
/// CSV    One point a line, in UTF-8. The first line settles the separator: the first of semicolon, comma and tab that
///        it holds outside quotes, or else blanks. It is a header if it names the coordinates: x, y, z; Points:0,
///        Points:1, Points:2; or Points_0, Points_1, Points_2, in any case and any place. Other columns are passed
///        over. Without a header the first columns are the coordinates. Every line has as many fields as the first.
///        Fields may stand in double quotes. Blank lines, and lines that begin with #, are passed over. Lines end in
///        LF or CR LF; the last may lack its end, but not where the file would end within a coordinate: 0.2 may be the
///        beginning of 0.25. At most 1 MiB a line. A named pipe is waited for.
/// NPY    Versions 1 to 3; one array of shape (n, dimension), float64 or float32 of either byte order, in C or Fortran
///        order.
/// .node  TetGen's and Triangle's grammar, see mesh/tetgen_reader.cpp; attributes and markers are passed over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "barycert/core/result.hpp"

namespace barycert::points {

/// Points, block by block.
class Source {
public:
    virtual ~Source();

    /// Coordinates a point: 2 or 3, as asked for when opened.
    virtual int dimension() const = 0;

    /// The number of points, where it is known before the end.
    virtual std::optional<std::uint64_t> count() const = 0;

    /// Appends the coordinates of up to `most` points to `out`, point after point, and tells how many: fewer than
    /// `most` only at the end, 0 after it. On an Error the points before the fault may have been appended; the source
    /// gives nothing but that Error from then on.
    virtual Result<std::size_t> read(std::size_t most, std::vector<double>& out) = 0;
};

enum class Format : std::uint8_t { csv, npy, node, vtu };

/// By the suffix, in any case: .csv .npy .node .vtu; "-" is CSV. Error: another suffix; it lists the known ones.
Result<Format> format_of(const std::string& path);

/// The points of a CSV, NPY or .node file; "-" is CSV from the standard input. `dimension`: 2 or 3. A file of another
/// dimension is an Error; but of a CSV only the columns that are asked for are read.
/// Error also: a VTU file, which takes the library barycert::vtk.
Result<std::unique_ptr<Source>> open_source(const std::string& path, int dimension);

/// Points from memory, as they are. An incomplete last point is left out.
std::unique_ptr<Source> memory_source(std::vector<double> points, int dimension);

}  // namespace barycert::points

/// Sampled values, row by row, into CSV and NPY files that appear whole or not at all.
///
/// CSV  A header line x,y[,z],cell,feature,NAME...[,distance], then a line a row. Numbers are in the shortest decimal
///      form that reads back to the same bits; nan, inf, -inf. Names that hold a comma, a quote or a line end are
///      quoted, and quotes in them doubled.
/// NPY  One structured array: x, y[, z] float64, cell int64, feature bytes of 8, each column float64, [distance
///      float64]; all little-endian. Names must differ from one another; UTF-8.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barycert/core/result.hpp"
#include "barycert/core/simplex.hpp"

namespace barycert::points {

/// A block of rows, one a point (or a point and a cell that holds it).
struct Rows {
    int dimension = 3;
    std::span<const double> points = {};       ///< dimension a row
    std::span<const std::int32_t> cells = {};  ///< one a row; 0-based, -1 outside
    std::span<const Feature> features = {};    ///< one a row: interior, face, edge, vertex, outside
    std::span<const double> values = {};       ///< as many a row as the format has columns, row after row
    std::span<const double> distances = {};    ///< one a row where the format has distances, else empty
};

struct RowFormat {
    int dimension = 3;
    std::vector<std::string> columns = {};  ///< names of the values of a row
    bool distances = false;                 ///< a last column `distance`
};

/// A file of rows. Without a commit() nothing appears, except on the standard output.
class Sink {
public:
    virtual ~Sink();

    /// Appends the rows. Error: disk full and the like, or spans whose sizes do not fit together; then nothing appears.
    virtual Status write(const Rows& rows) = 0;

    /// Makes the file appear, if nothing failed. Nothing may be written after it.
    virtual Status commit() = 0;
};

/// A CSV or NPY file, by the suffix of the path; "-" is CSV on the standard output.
/// Error: another suffix; a path that cannot be written; for NPY, names that NumPy would refuse.
Result<std::unique_ptr<Sink>> open_sink(const std::string& path, const RowFormat& format);

}  // namespace barycert::points

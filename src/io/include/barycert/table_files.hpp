/// Sampled values, row by row, into CSV and NPY files that appear whole or not at all.
///
/// CSV  A header line x,y[,z],cell,feature,NAME...[,distance][,CARRIED...], then a line a row. Numbers are in their
///      shortest form that reads back to the same bits; nan, inf, -inf. Names and texts that hold a comma, a quote or a
///      line end, or that begin or end with a blank, are quoted, and quotes in them doubled.
/// NPY  One structured array: x, y[, z] float64, cell int64, feature bytes of 8, each column float64, [distance
///      float64], carried columns int64, float64, or text: U, characters, if ColumnFormat::max_characters is not 0,
///      else S, bytes; all little-endian. Names must differ from one another; UTF-8.
///
/// Example:
///
///     #include "barycert/locator.hpp"
///     Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     const Table rows = Locator::build(mesh).value().locate(std::vector<double>{0.2, 0.2}).value();
///     const std::unique_ptr<TableSink> sink = open_table("rows.csv", {.dimension = 2}).value();
///     sink->write(rows.view()).value();
///     sink->commit().value();
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"

namespace barycert {

/// Columns of a file of rows: points, cell, feature, the columns of the fields, and perhaps distances.
struct TableFormat {
    int dimension = 3;
    std::vector<TableField> fields = {};
    bool distances = false;                  ///< a column `distance` after the fields
    std::vector<ColumnFormat> carried = {};  ///< columns that are carried through: the last ones
    VtkData vtk_data = VtkData::raw;         ///< of a .vtu file

    std::vector<std::string> columns() const { return column_names(fields); }
};

/// Takes rows, block by block: a file, a picture, a mesh. Without a commit() nothing appears but on standard output.
class TableSink {
public:
    virtual ~TableSink();

    /// Appends the rows. Error: disk full and the like, or spans whose sizes do not fit together; then nothing appears.
    virtual Status write(const TableView& rows) = 0;

    /// Makes the file appear, if nothing failed. Nothing may be written after it.
    virtual Status commit() = 0;
};

/// Opens a CSV, NPY or .vtu file by the suffix of the path; "-" is CSV on the standard output. Error: another suffix;
/// the path cannot be written; NumPy would refuse a name.
Result<std::unique_ptr<TableSink>> open_table(const std::string& path, const TableFormat& format);

}  // namespace barycert

/// Rows as users know them: cells by the numbers that they have in their file, the labels of the owners, and columns of
/// the points.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/jobs/sampled_mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// Of columns that are carried through, those that rows get: without those that have the name of another column of the
/// rows, as rows that another run wrote have, which `left_out` tells.
struct KeptColumns {
    std::vector<bool> kept;  ///< one a column; empty: all
    std::vector<ColumnFormat> columns;
    Notes left_out;
};
KeptColumns keep_all(const SampledMesh& mesh, const TableFormat& format, const std::vector<ColumnFormat>& carried,
                     const std::string& file);

/// The columns of rows: those of the mesh, labels that the job asked for, and `carried` ones; the report gets the names
/// of what is carried. Error: a column that is carried through has the name of another one.
Result<TableFormat> user_format(SampledMesh& mesh, TableFormat format, const std::vector<ColumnFormat>& carried);

/// Takes rows whose cells are those of the mesh, and gives the sink what users are to see: of carried columns those
/// that are `kept`. The mesh must stay. The sink itself where that is the same.
std::unique_ptr<TableSink> user_rows(const SampledMesh& mesh, std::unique_ptr<TableSink> sink,
                                     std::vector<bool> kept = {});

/// An output of rows; a terminal shows names and texts without control characters.
Result<std::unique_ptr<TableSink>> open_rows(const std::string& path, const TableFormat& format);

}  // namespace barycert::jobs

/// Which columns of a file of results say what, and their values as claims.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/verify_job.hpp"

namespace barycert::jobs {

/// Names of columns; empty: none.
struct ClaimedColumns {
    std::vector<FieldChoice> fields;  ///< those of which all components were found, in their order
    std::vector<std::string> values;  ///< for each component of these
    std::string cell, mask;

    /// All of them, each once.
    std::vector<std::string> names() const;
};

/// Chooses among the columns that the results have. Adds to `notes` which fields and columns are not compared. Refused:
/// a column that the job names is not there, or nothing is left to compare.
ClaimedColumns claimed_columns(const VerifyJob& job, const Mesh& mesh, const std::vector<FieldChoice>& fields,
                               const std::vector<ColumnFormat>& formats, Notes& notes);

struct Claims {
    std::vector<std::int64_t> cells;
    std::vector<std::uint8_t> inside;
    std::vector<double> values;
};

/// Returns the claims of the columns. Cells are indices in the mesh: those that the file numbers otherwise are
/// translated, and those that the mesh does not have are beyond its last one. Error, with rows counted from
/// `first_row`: a text that is no number, a cell that is no integer. An empty text is NaN.
Claims claims_of(const ClaimedColumns& which, const std::vector<Column>& columns, const Mesh& mesh,
                 const VerifyJob& job, std::uint64_t first_row);

}  // namespace barycert::jobs

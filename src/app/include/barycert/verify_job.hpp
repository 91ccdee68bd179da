/// The job that compares the results in a file, written by any tool, with the exact results.
///
/// Example:
///
///     VerifyJob job;
///     job.mesh = "part.1";
///     job.results = "probed.csv";
///     job.limits = {parse_verify_limit("wrong_value>10").value()};
///     const bool failed = !verify_files(job).value().exceeded().empty();
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/result.hpp"
#include "barycert/verify.hpp"

namespace barycert {

/// A rule of --fail-on: more such rows than that fail.
struct VerifyLimit {
    RowVerdict verdict = RowVerdict::missed;
    std::uint64_t most = 0;
};

/// The kinds of rows that limits are of.
inline constexpr std::array<RowVerdict, 4> kinds_of_wrong{RowVerdict::missed, RowVerdict::invented,
                                                          RowVerdict::wrong_cell, RowVerdict::wrong_value};

/// NAME or NAME>NUMBER, with NAME missed, invented, wrong_cell or wrong_value.
Result<VerifyLimit> parse_verify_limit(std::string_view text);

struct VerifyJob : MeshJob {
    std::vector<std::string> fields = {};  ///< names, see Sampler::build; empty: those that the results have
    /// Points with columns, as for open_points: .csv .npy .vtu .vtp .vti .vtk ...; "-" is CSV from stdin.
    std::string results;
    std::vector<std::string> columns = {};  ///< those of the coordinates: PointOptions::columns

    /// Columns of values by those of the sampler (T, v.0, ...). Others are looked for under their own name, and as
    /// NAME:0 and NAME_0, as ParaView writes them.
    std::map<std::string, std::string> values = {};
    /// The column that names cells, from cell_base. Empty: `cell`, if there is one; "none": none.
    std::string cell_column;
    int cell_base = 0;
    /// The column that is 0 outside. Empty: vtkValidPointMask, if there is one; "none": none.
    std::string mask_column;

    VerifyOptions options = {};            ///< but for tolerance
    std::optional<double> tolerance = {};  ///< not set: 1e-9, or 1e-6 where values are single precision throughout
    std::vector<VerifyLimit> limits = {};  ///< empty: none of any kind
};

/// Results of a verification, from which its reports are made.
struct VerifyReport : MeshReport {
    std::string results;
    CellInterpolation interpolation = CellInterpolation::linear;  ///< by which values are right
    bool certified = false;
    std::uint64_t contested_cells = 0;
    std::vector<std::string> columns;      ///< of the sampler: what was compared
    std::vector<std::string> found_in;     ///< the column of the results for each
    std::string cell_column, mask_column;  ///< empty: none
    std::vector<double> ranges;            ///< what errors are relative to
    std::vector<RelativeTo> relative_to;   ///< what these are
    double tolerance = 0;
    bool exact = false;
    std::optional<double> outside_value;
    Verdicts verdicts;                ///< cells of examples are the file's own numbers
    std::vector<VerifyLimit> limits;  ///< of the job, or 0 of every kind
    std::string program;
    JobSeconds seconds;

    /// Whether rows could be of that kind: wrong_cell takes a column of cells, wrong_value one of values.
    bool compared(RowVerdict verdict) const {
        if (verdict == RowVerdict::wrong_cell) return !cell_column.empty();
        return verdict != RowVerdict::wrong_value || !columns.empty();
    }
    std::vector<VerifyLimit> exceeded() const {
        std::vector<VerifyLimit> all = limits;
        std::erase_if(all, [&](const VerifyLimit& l) { return verdicts.of(l.verdict) <= l.most; });
        return all;
    }
};

/// Returns an Error if an input cannot be read, the results have no column that could be compared, or there is a limit
/// on what is not compared: nothing could exceed it.
Result<VerifyReport> verify_files(const VerifyJob& job);

}  // namespace barycert

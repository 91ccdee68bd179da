/// A whole job: the results that some tool wrote into a file, held against the exact ones.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/notes.hpp"
#include "barycert/pipeline.hpp"
#include "barycert/verify.hpp"

namespace barycert {

struct VerifyJob {
    std::string mesh;      ///< as for read_mesh
    StepChoice step = {};  ///< of a series
    std::vector<FieldFile> field_files = {};
    Curved curved = Curved::straight;      ///< what becomes of curved cells
    std::vector<std::string> fields = {};  ///< names, see Sampler::build; empty: those that the results have

    /// Points with columns, as for open_points: .csv .npy .vtu .vtp .vti .vtk ...; "-" is CSV from stdin.
    std::string results;
    std::vector<std::string> columns = {};  ///< those of the coordinates: PointOptions::columns

    /// Columns of values by the columns of the sampler (T, v.0, ...). Those that are not named here are looked for
    /// under their own name, and as NAME:0 and NAME_0, as ParaView writes them.
    std::map<std::string, std::string> values = {};
    /// The column that names cells, from cell_base. Empty: `cell`, if there is one; "none": none.
    std::string cell_column;
    int cell_base = 0;
    /// The column that is 0 outside. Empty: vtkValidPointMask, if there is one; "none": none.
    std::string mask_column;

    VerifyOptions options = {};
    bool tolerance_given = false;  ///< else 1e-6 is taken where values are single precision throughout

    /// Where the caller will write reports, after what it calls them: as SamplingJob::report.
    std::vector<std::pair<std::string, std::string>> reports = {};
    std::string program = "barycert";  ///< how the user calls the program, for commands in messages
    std::function<void(const JobProgress&)> progress = {};
};

/// What a verification did: what its reports are made of.
struct VerifySummary {
    std::string mesh, results;
    std::uint64_t nodes = 0, cells = 0;
    int dimension = 3, threads = 1;
    CurvedCells curved;  ///< of the mesh: results are held against straight sides
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

    Verdicts verdicts;  ///< cells of examples are the file's own numbers
    Notes notes;
    std::string program;
    SampleSeconds seconds;
};

/// A rule of --fail-on: more such rows than that fail.
struct VerifyLimit {
    RowVerdict verdict = RowVerdict::missed;
    std::uint64_t most = 0;
};

/// NAME or NAME>NUMBER, with NAME missed, invented, wrong_cell or wrong_value.
Result<VerifyLimit> parse_verify_limit(std::string_view text);

/// The names that it takes.
std::vector<std::string> verify_limit_names();

/// Every kind, 0 of it: what fails without a rule.
std::vector<VerifyLimit> strict_limits();

/// Whether rows could be of that kind: wrong_cell takes a column of cells, wrong_value one of values.
bool compared(const VerifySummary& summary, RowVerdict verdict);

/// Error: a limit on what was not compared. Nothing could fail.
Status check_limits(const VerifySummary& summary, const std::vector<VerifyLimit>& limits);

/// Those that are exceeded.
std::vector<VerifyLimit> exceeded(const Verdicts& verdicts, const std::vector<VerifyLimit>& limits);

/// Returns an Error if an input cannot be read, or the results have no column that could be compared.
Result<VerifySummary> verify_files(const VerifyJob& job);

}  // namespace barycert

/// Reports of audits as text, JSON and pictures; the catalogue and the families likewise.
///
/// Example:
///
///     const AuditReport report = run_audit({.kernels = kernels_matching("*"), .families = all_families()},
///     {}).value(); const std::string json = audit_json(report), table = audit_text(report, {});
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/baseline.hpp"
#include "barycert/family.hpp"
#include "barycert/gaps.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mutants.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"

namespace barycert {

// Measurements of `./run flags` and `./run systems`, for the page of an audit: formulas under compiler flags, and other
// systems compared with exact answers. Both write JSON, which is read here.

/// Formulas in rows, sets of compiler flags in columns.
struct FlagsMatrix {
    struct Column {
        std::string compiler, label, flags;
    };
    /// Answers of a formula under a set of flags; `cases` is 0 where it was not run. `changed`: other than the strict
    /// build's by a bit or more; `newly_wrong` and `newly_right`: wrong here and not there, and the reverse.
    struct Cell {
        std::uint64_t cases = 0, changed = 0, wrong = 0, newly_wrong = 0, newly_right = 0;
    };
    struct KernelAnswers {
        std::string kernel;
        std::vector<Cell> cells;  ///< one a column
    };
    std::uint64_t seed = 0, count = 0;  ///< cases of each family
    std::size_t families = 0;
    std::vector<std::string> compilers;  ///< by name and version
    std::vector<Column> columns;
    std::vector<KernelAnswers> rows;
};

/// Answers of systems to points, compared with the exact owners and values.
struct SystemsLeague {
    struct Standing {
        std::string name = {}, version = {};
        int dimension = 3;
        std::string not_run = {};  ///< why; then there are no counts
        std::uint64_t points = 0, inside = 0, outside = 0;
        std::uint64_t inside_called_outside = 0, outside_called_inside = 0;
        std::optional<std::uint64_t> wrong_owner = {};  ///< not containing the point; nothing if it names none
        std::optional<double> max_value_error = {};  ///< in parts of the field's range; nothing if it gives no values
        std::optional<double> ns = {};               ///< a random point
        std::vector<std::string> failures = {};      ///< meshes without answers or times, and why
    };
    std::uint64_t seed = 0, count = 0;  ///< points of each set on each mesh
    std::vector<Standing> standings;
};

using OtherResults = std::variant<FlagsMatrix, SystemsLeague>;

/// Reads a file of `./run flags --json` or `./run systems --json`. Errors: the file cannot be read, is no JSON, or
/// is neither of the two; a member is missing, or does not fit the others.
Result<OtherResults> read_other_results(const std::string& path);

// Reports as text for a terminal or a log.

/// At most 100 columns, names aside: who is wrong, how often and by how much, a line a kernel, worst first. For one
/// kernel: its families, its findings and the commands that replay them. With style.wide all counts, the families, each
/// kernel's worst witness with its command, however wide.
std::string audit_text(const AuditReport& report, const TerminalStyle& style);

/// One witness: the case, the exact answer, and next to it that of the kernel that it names; with `all`, or if it names
/// none, of all kernels, that one first.
std::string witness_text(const Replay& replay, const TerminalStyle& style, bool all = true);

/// The catalogue and the families, one paragraph each.
std::string kernels_text(const std::vector<Kernel>& kernels);
std::string families_text(const std::vector<Family>& families);

// The audit as one HTML page, for people: to read, to print, to pass on.

/// Further contents of a page beside the report.
struct AuditPage {
    TerminalStyle style = {};               ///< for the commands that replay witnesses
    std::string command_line = {};          ///< the one that made the page; empty: not told
    std::vector<SignPicture> signs = {};    ///< see sign_pictures(); empty: no pictures
    std::vector<MeshMap> maps = {};         ///< see mesh_maps()
    std::vector<OtherResults> others = {};  ///< see read_other_results()
};

/// The verdict; the table of kernels; accuracy against speed; pictures of signs; maps of meshes; sizes of errors;
/// families; witnesses with commands; what other programs measured; how it was made. UTF-8, self-contained: it asks for
/// nothing from anywhere; a script sorts the table and copies commands, and without it the page reads the same.
/// Well-formed XML, too. Errors: a picture cannot be made.
Result<std::string> audit_html(const AuditReport& report, const AuditPage& page);

// Reports as JSON. Every member is documented in doc/json.md.

/// One number for reports and witness files: `barycert replay` reads both.
inline constexpr int audit_schema = witness_schema;

/// The whole audit, witnesses included.
std::string audit_json(const AuditReport& report);

/// The catalogue and the families, as `barycert kernels --json` and `barycert families --json` print them.
std::string kernels_json(const std::vector<Kernel>& kernels);
std::string families_json(const std::vector<Family>& families);

/// The errors of kernels against the condition numbers of cells, as an SVG of its own. Across: log2 of the condition
/// number; upwards: the error in units of 2^-53, worst and median of a bin, as bits. The line drawn as prediction is
/// error = 2^-53 * kappa.
///
/// Which kernels: those on tetrahedra if any has cases to show, else those on triangles; of these those with an error
/// beyond half of 2^-53; if more than six, without variants (names with a second dot); if still more than six, six of
/// them, evenly from the least to the largest worst factor.
std::string condition_plot(const AuditReport& report);

// A worst-case search, and the mutation score of the families.

/// The table of faults; below it the plainest case of each, with the command that replays it if a file of witnesses is
/// named.
std::string search_text(const SearchReport& report, const TerminalStyle& style);

/// `barycert replay` reads it, too: it has the plain witnesses as its "witnesses".
std::string search_json(const SearchReport& report);

/// A table: a row a mutant, with the family that tells it best; below it the families.
std::string mutants_text(const MutantReport& report, const TerminalStyle& style);
std::string mutants_json(const MutantReport& report);

// Drift over the size of a triangle, and rules of texel addressing.

/// A table: a row a size, a column a kernel.
std::string drift_text(const DriftReport& report, const TerminalStyle& style);
std::string drift_json(const DriftReport& report);

/// An SVG of its own, both axes logarithmic: across the size in pixels, upwards the largest error in ulps. At most six
/// kernels, the first of the report.
std::string drift_plot(const DriftReport& report);

/// A table: a row a rule; below it the witnesses.
std::string texels_text(const std::vector<TexelResult>& results, const TerminalStyle& style);
std::string texels_json(const std::vector<TexelResult>& results);

/// Rules on triangles in space, in a table a question: a row a rule; below them the rules, with the families that show
/// their faults.
std::string surfaces_text(const SurfaceAudit& audit, const TerminalStyle& style);
std::string surfaces_json(const SurfaceAudit& audit);
std::string surfaces_html(const SurfaceAudit& audit);

/// The same of inverse maps, in one table.
std::string inverses_text(const InverseAudit& audit, const TerminalStyle& style);
std::string inverses_json(const InverseAudit& audit);
std::string inverses_html(const InverseAudit& audit);

/// Gaps and overlaps between the cells of a mesh, in a table: a row a kernel and rule; below it the first witnesses of
/// the kernels.
std::string gaps_text(const GapsReport& report, const TerminalStyle& style);
std::string gaps_json(const GapsReport& report);

// Outcomes of an audit, for the systems that run it (see report.hpp).
//
// An outcome fails where a rule of --fail-on is broken, or a figure is worse than the baseline's. Findings that
// break no rule are told and do not fail.

/// The outcomes of an audit. `comparison` may be null. `artifacts`: kernel to file, of kernels from libraries.
CiReport audit_outcomes(const AuditReport& report, const std::vector<Threshold>& rules,
                        const BaselineComparison* comparison, const std::map<std::string, std::string>& artifacts);

/// Describes what got worse and better, some lines of each, and what could not be compared.
std::string baseline_text(const BaselineComparison& comparison, const std::string& path);

}  // namespace barycert

/// Reports of jobs as text, JSON and HTML, and for continuous integration. Functions return strings, and write nothing.
///
/// Example:
///
///     #include "barycert/sample_job.hpp"
///     SampleJob job;
///     job.mesh = "part.1";
///     job.points = "points.csv";
///     job.output = "rows.csv";
///     const std::string text = sample_text(sample_files(job).value(), false);
#pragma once

#include <string>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/mesh.hpp"
#include "barycert/render_job.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/verify_job.hpp"

namespace barycert {

/// How text looks on the user's terminal, and what commands in it begin with.
struct TerminalStyle {
    bool colour = false;
    std::string command = "barycert";  ///< how the user calls the program, for commands to repeat
    /// The argument that replays a witness, appended to "barycert replay": a file name, or empty to name the family and
    /// case instead.
    std::string witness_path = {};
    std::vector<std::string> mesh_arguments = {};     ///< as the user gave them, repeated in replay commands
    std::vector<std::string> library_arguments = {};  ///< likewise: the user's kernel libraries
    std::string kernel_arguments = {};  ///< likewise: options of how these are run and judged, " --in-process ..."
    bool wide = false;                  ///< the audit's whole table, whatever its width
};

/// One line: version, rounding, SIMD target, compiler.
std::string environment_line(const Environment& environment);

/// nan, error, fill=V, nearest, nearest=DISTANCE, extrapolate: as on the command line.
std::string policy_text(const OutsidePolicy& policy);

// The report on a mesh as text for a terminal or a log.

/// The verdict in one line; below it what was checked, what was found and what to do about it, pairs of cells that meet
/// where they must not, measures, notes. At most 100 columns, names of files aside. `mesh` is what the report is of,
/// `name` what the user calls it.
std::string check_text(const CheckReport& report, const Mesh& mesh, const std::string& name,
                       const TerminalStyle& style);

/// Describes what was done, the verdict on the copy, and what remains.
std::string fix_text(const FixedMesh& fixed, const TerminalStyle& style);

// The report on a mesh as JSON. Every member is documented in doc/json.md.

inline constexpr int check_schema = 1;

/// `name`: what the user calls the mesh.
std::string check_json(const CheckReport& report, const std::string& name, const Environment& environment,
                       const FixedMesh* fixed = nullptr);

/// The report on a mesh as one HTML page, for people: to read, to print, to pass on.
///
/// The verdict; what was checked and found, with places and remedies; histograms of the measures; the worst cells and
/// those with problems drawn, and where in the mesh they are. UTF-8, self-contained: style and pictures are in the
/// page, which asks for nothing from anywhere and runs no scripts. It is well-formed XML, too. Some hundred kilobytes
/// at most, whatever the size of the mesh. `mesh` is what the report is of, `mesh_name` what the user calls it.
///
/// Cost: some passes over the mesh, and its boundary once more. Parts of broken meshes that have no place are not
/// drawn.
std::string check_html(const CheckReport& report, const Mesh& mesh, const std::string& mesh_name,
                       const FixedMesh* fixed = nullptr);
/// The histograms of its measures as the bytes of a picture, by the suffix of `path`: .png, .pdf, else SVG. Error:
/// there are none; a side of more than 32767 pixels.
Result<std::string> check_plot(const CheckReport& report, const std::string& mesh_name, const std::string& path);
/// The page of a surface or a PLC, with draw_checked() if it can be drawn.
std::string check_html(const CheckReport& report, const Surface& surface, const std::string& name);

// Reports on a run of sampling, for people and as JSON. Every member is documented in doc/json.md.

/// A few lines of at most 120 columns, names of files aside.
std::string sample_text(const SampleReport& summary, bool colour);

inline constexpr int sample_schema = 1;

std::string sample_json(const SampleReport& summary, const Environment& environment);

// Reports on a verification of results, for people and as JSON and HTML. JSON is documented in doc/json.md.

inline constexpr int verify_schema = 1;

/// The verdict, a table, errors, the worst rows with commands. At most 120 columns, names and rows aside.
std::string verify_text(const VerifyReport& summary, bool colour);
std::string verify_json(const VerifyReport& summary, const Environment& environment);
/// One self-contained page without scripts, for screens of any width, light and dark, and for paper; it is well-formed
/// XML, too.
std::string verify_html(const VerifyReport& summary, const Environment& environment);

/// Histograms of the errors of each column, in ulps and in parts of its range, as check_plot.
Result<std::string> verify_plot(const VerifyReport& summary, const std::string& path);

// Reports on a run of cutting, for people and as JSON.

/// A few lines of at most 120 columns, names of files and fields aside.
std::string contour_text(const ContourReport& summary, bool colour);

inline constexpr int contour_schema = 1;

std::string contour_json(const ContourReport& summary, const Environment& environment);

// Reports on a picture, for people; and as JSON, whose members are documented in doc/json.md.

/// A few lines of at most 120 columns, names aside.
std::string render_text(const RenderReport& summary, bool colour);

inline constexpr int render_schema = 1;

std::string render_json(const RenderReport& summary, const Environment& environment);

// Reports on a run for the systems that run it: JUnit's XML, SARIF 2.1.0, annotations of GitHub's workflows.
//
// All three say the same outcomes. One fails where the program's exit code says so and nowhere else: a mesh that is
// not certified, rows that are wrong, a broken rule of --fail-on. Other findings are told and do not fail.

struct CiOutcome {
    enum class State : unsigned char { passed, noted, failed };
    std::string subject;  ///< a kernel, a mesh, a file of results
    std::string name;     ///< what was asked: a rule, a condition, a family, a class of finding
    std::string rule;     ///< the class or figure, a handle that stays the same from run to run
    std::string meaning;  ///< of the rule, one sentence
    State state = State::passed;
    std::string message;   ///< one line; empty if passed
    std::string artifact;  ///< the file that the subject comes from; may be empty
};

struct CiReport {
    std::string command;  ///< "barycert audit"
    std::string kind;     ///< what subjects are, as SARIF calls it: function, resource
    Environment environment;
    double seconds = 0;
    std::vector<CiOutcome> outcomes = {};  ///< those of one subject together

    bool failed() const;
};

/// The conditions of the certificate that hold, and the defects by kind, each with its first places. `name` is what the
/// user calls the mesh, `artifact` the file that it is in.
CiReport check_outcomes(const CheckReport& report, const Mesh& mesh, const std::string& name,
                        const std::string& artifact, const Environment& environment);

/// Kinds of wrong rows with their number and the worst; those fail of which there are more than a limit says.
CiReport verify_outcomes(const VerifyReport& summary, const Environment& environment);

/// A suite a subject, a case an outcome. Valid by the schema of Jenkins (junit-10.xsd).
std::string ci_junit(const CiReport& report);

/// Static Analysis Results Interchange Format 2.1.0: a result for each outcome that failed (error) or is noted (note).
std::string ci_sarif(const CiReport& report);

/// A line `::error title=...::...` for each outcome that failed.
std::string ci_annotations(const CiReport& report);

}  // namespace barycert

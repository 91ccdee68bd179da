// barycert verify: results of any tool, held against the exact ones.

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/verification.hpp"
#include "command.hpp"
#include "files.hpp"
#include "progress.hpp"
#include "sampling_options.hpp"

namespace barycert::cli {
namespace {

struct VerifyArguments {
    VerifyJob job;
    std::vector<std::string> values;   ///< FIELD=COLUMN
    std::vector<std::string> fail_on;  ///< KIND or KIND=COUNT
    bool quiet = false;
};

struct Limit {
    const char* name;
    std::uint64_t Verdicts::*count;
};
constexpr std::array<Limit, 4> limits{{{"missed", &Verdicts::missed},
                                       {"invented", &Verdicts::invented},
                                       {"wrong-cell", &Verdicts::wrong_cell},
                                       {"wrong-value", &Verdicts::wrong_value}}};

/// KIND=COUNT: more than COUNT such rows fail.
std::pair<const Limit*, std::uint64_t> limit_of(const std::string& text) {
    const std::size_t sign = text.find('=');
    const std::string kind = text.substr(0, sign);
    const auto* const limit =
        std::find_if(limits.begin(), limits.end(), [&](const Limit& l) { return l.name == kind; });
    const auto count = sign == std::string::npos ? std::optional<double>(0) : base::parse_double(text.substr(sign + 1));
    if (limit == limits.end() || !count || !(*count >= 0) || std::floor(*count) != *count || *count > 0x1p53)
        throw CLI::ValidationError(
            "--fail-on", "expected missed, invented, wrong-cell or wrong-value, perhaps =COUNT, found \"" + text + '"');
    return {limit, static_cast<std::uint64_t>(*count)};
}

bool fails(const VerifyArguments& a, const Verdicts& v) {
    if (a.fail_on.empty()) return v.wrong() != 0;
    return std::any_of(a.fail_on.begin(), a.fail_on.end(), [&](const std::string& text) {
        const auto [limit, count] = limit_of(text);
        return v.*limit->count > count;
    });
}

int run_verify(VerifyArguments& a) {
    Progress progress(!a.quiet && stderr_is_terminal());
    a.job.progress = [&](const JobProgress& p) {
        p.done == 0 ? progress.stage(p.stage) : progress.count(p.stage, p.done);
    };
    a.job.program = command_name();
    const Result<VerifySummary> summary = verify_files(a.job);
    progress.clear();
    if (!summary) return fail(summary.error());
    if (!a.quiet) tell_important(summary->notes);
    std::vector<Status> written;
    if (!a.job.report.empty())
        written.push_back(write_output(a.job.report, verify_json(*summary, measure_environment())));
    if (!a.job.html.empty()) written.push_back(write_output(a.job.html, verify_html(*summary, measure_environment())));
    if (!a.quiet && a.job.report != "-" && a.job.html != "-")
        written.push_back(write_output("-", verify_text(*summary, colour_on_stdout())));
    for (const Status& status : written) {
        if (!status) return fail(status.error());
    }
    return fails(a, summary->verdicts) ? exit_findings : exit_clean;
}

}  // namespace

void add_verify(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand("verify",
                                   "Compare results of any tool with the exact ones: cells, inside or outside, values");
    sub->footer(
        "RESULTS: points with columns, as written by barycert sample, ParaView, pyvista, pandas or NumPy. A row is "
        "outside\n"
        "if vtkValidPointMask is 0, else if the cell is negative, else if all values are NaN. Any cell that contains "
        "the\n"
        "point is a right cell. Errors of values are told in ulps and in parts of the range of the field (max - min).\n"
        "Exit codes: 0 all rows are right, 1 some are wrong (see --fail-on), 2 usage or input error.");
    const auto a = std::make_shared<VerifyArguments>();
    file_option(*sub, "MESH", a->job.mesh, mesh_help)->required();
    file_option(*sub, "--results", a->job.results,
                "Points with results: .csv .npy .vtu .vtp .vti .vtk; - is CSV from stdin")
        ->required();
    add_field_files(*sub, a->job.field_files, "--field");
    sub->add_option("--fields", a->job.fields, "Fields to compare: A,B,...; default: those that the results have")
        ->allow_extra_args(false)
        ->type_name("NAMES");
    sub->add_option_function<std::vector<std::string>>(
           "--value",
           [a](const std::vector<std::string>& all) {
               for (const std::string& text : all) {
                   const std::size_t sign = text.find('=');
                   if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
                       throw CLI::ValidationError("--value", "expected FIELD=COLUMN, found \"" + text + '"');
                   a->job.values[text.substr(0, sign)] = text.substr(sign + 1);
               }
           },
           "The column of the results for a value of the mesh (T, v.0, ...)")
        ->allow_extra_args(false)
        ->type_name("FIELD=COLUMN");
    sub->add_option("--columns", a->job.columns, "Columns of the coordinates: names, or numbers from 1; default: x,y,z")
        ->allow_extra_args(false)
        ->type_name("A,B,C");
    sub->add_option("--cell-column", a->job.cell_column,
                    "Column with the cell of each point; default: cell; none: none")
        ->type_name("NAME");
    sub->add_option("--cell-base", a->job.cell_base, "Number of the first cell in that column")
        ->capture_default_str()
        ->check(CLI::Range(0, 1).description(""))
        ->type_name("0|1");
    sub->add_option("--mask-column", a->job.mask_column,
                    "Column that is 0 outside; default: vtkValidPointMask; none: none")
        ->type_name("NAME");
    sub->add_option("--outside-value", a->job.options.outside_value,
                    "A row whose values are all this number is outside (tools that turn outside into 0)")
        ->type_name("NUMBER");
    auto* const tolerance =
        sub->add_option("--tolerance", a->job.options.tolerance,
                        "Largest error of a right value, in parts of the range of its field; default: 1e-9, or 1e-6 "
                        "where all values are single precision")
            ->check(CLI::NonNegativeNumber.description(""))
            ->type_name("T");
    sub->add_flag("--exact", a->job.options.exact, "Right is only the exact value, rounded once, to the last bit")
        ->excludes(tolerance);
    sub->add_option("--examples", a->job.options.examples, "Number of rows shown of each kind of error")
        ->capture_default_str()
        ->check(CLI::Range(0, 100000).description(""))
        ->type_name("N");
    sub->add_option_function<std::vector<std::string>>(
           "--fail-on",
           [a](const std::vector<std::string>& all) {
               for (const std::string& text : all) {
                   limit_of(text);
                   a->fail_on.push_back(text);
               }
           },
           "Exit with 1 only if there are more than COUNT (default 0) such rows: missed, invented, wrong-cell, "
           "wrong-value")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("KIND[=COUNT]");
    sub->add_option("--threads", a->job.options.threads, "Number of threads; 0: all")
        ->capture_default_str()
        ->check(CLI::Range(0, 4096).description(""))
        ->type_name("N");
    file_option(*sub, "--json", a->job.report, "Write the report as JSON; - is stdout");
    file_option(*sub, "--html", a->job.html, "Write the report as an HTML page; - is stdout");
    sub->add_flag("--quiet", a->quiet, "Print no report and no progress");
    sub->callback([=, &exit_code] {
        a->job.tolerance_given = tolerance->count() != 0;
        exit_code = run_verify(*a);
    });
}

}  // namespace barycert::cli

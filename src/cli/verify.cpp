// barycert verify: results of any tool, held against the exact ones.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/jobs.hpp"
#include "barycert/report.hpp"
#include "ci.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "sampling_options.hpp"

namespace barycert::cli {
namespace {

struct VerifyArguments {
    VerifyJob job;
    std::vector<std::string> fail_on;
    std::string json, html;
    CiOptions ci;
    bool quiet = false;
};

/// Tells which limits of --fail-on are exceeded.
void tell_failures(const VerifyReport& summary, const std::vector<VerifyLimit>& failures) {
    for (const VerifyLimit& limit : failures)
        tell(fmt::format("fails: {}: {} = {}, limit {}\n", base::printable(summary.results), handle(limit.verdict),
                         summary.verdicts.of(limit.verdict), limit.most));
}

int run_verify(VerifyArguments& a) {
    std::vector<VerifyLimit> limits;
    for (const std::string& text : a.fail_on) {
        const Result<VerifyLimit> limit = parse_verify_limit(text);
        if (!limit) return fail(limit.error());
        limits.push_back(*limit);
    }
    const bool table = !a.quiet && a.json != "-" && a.html != "-" && !a.ci.on_stdout();
    std::vector<base::NamedFile> outputs{{"--json", a.json}, {"--html", a.html}};
    add_ci_outputs(a.ci, table, outputs);
    for (const base::NamedFile& file : outputs) a.job.reports.emplace_back(file.what, file.path);
    Progress progress(!a.quiet && stderr_is_terminal());
    a.job.progress = [&](const JobProgress& p) {
        p.done == 0 ? progress.stage(p.stage) : progress.count(p.stage, p.done);
    };
    a.job.program = command_name();
    const Result<VerifyReport> summary = verify_files(a.job);
    progress.clear();
    if (!summary) return fail(summary.error());
    if (const Status ok = check_limits(*summary, limits); !ok) return fail(ok.error());
    if (!a.quiet && !table) tell_curved(summary->curved);
    if (!a.quiet) tell_important(summary->notes);
    const Environment environment = measure_environment();
    std::vector<Status> written;
    if (!a.json.empty()) written.push_back(write_output(a.json, verify_json(*summary, environment)));
    if (!a.html.empty()) written.push_back(write_output(a.html, verify_html(*summary, environment)));
    if (table) written.push_back(write_output("-", verify_text(*summary, colour_on_stdout())));
    if (limits.empty()) limits = strict_limits();
    write_ci(a.ci, verify_outcomes(*summary, limits, environment), written);
    if (const Status ok = all_written(written); !ok) return fail(ok.error());
    const std::vector<VerifyLimit> failures = exceeded(summary->verdicts, limits);
    if (!a.fail_on.empty()) tell_failures(*summary, failures);
    return failures.empty() ? exit_clean : exit_findings;
}

}  // namespace

void add_verify(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand("verify",
                                   "Compare results of any tool with the exact ones: cells, inside or outside, values");
    sub->footer(
        "RESULTS: points with columns, as written by barycert sample, ParaView, pyvista, pandas or NumPy. A row is "
        "inside\n"
        "or outside by vtkValidPointMask if there is one, else by the cell (negative: outside), else by the values "
        "(all\n"
        "NaN: outside). Any cell that contains "
        "the\n"
        "point is a right cell. Errors of values are told in ulps and in parts of the range of the field (max - min).\n"
        "Exit codes: 0 all rows are right, 1 some are wrong (see --fail-on), 2 usage or input error.");
    const auto a = std::make_shared<VerifyArguments>();
    file_option(*sub, "MESH", a->job.mesh, mesh_help)->required();
    step_options(*sub, a->job.step);
    file_option(*sub, "--results", a->job.results,
                "Points with results: .csv .txt .npy .vtu .vtp .vti .vtk; - is CSV from stdin")
        ->required();
    add_field_files(*sub, a->job.field_files, "--field");
    sub->add_option(
           "--fields", a->job.fields,
           "Fields to compare, or what is made of them, as sample names it: A,B.x,|C|,...; default: those that the "
           "results have")
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
    nonfinite_option(*sub, a->job.options.nonfinite_points);
    auto* const tolerance =
        sub->add_option("--tolerance", a->job.options.tolerance,
                        "Largest error of a right value, in parts of the range of its field (where that is 0 of the "
                        "magnitude, and of 1 where the field is 0); default: 1e-9, or 1e-6 where all values are single "
                        "precision")
            ->check(finite_at_least(0))
            ->type_name("T");
    sub->add_flag("--exact", a->job.options.exact, "Right is only the exact value, rounded once, to the last bit")
        ->excludes(tolerance);
    sub->add_option("--examples", a->job.options.examples, "Number of rows shown of each kind of error")
        ->capture_default_str()
        ->check(CLI::Range(0, 100000).description(""))
        ->type_name("N");
    sub->add_option(
           "--fail-on", a->fail_on,
           "Exit with 1 only if there are more than NUMBER (0 if omitted) such rows; KIND is missed, invented, "
           "wrong_cell or wrong_value; several with commas, or repeated")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("KIND[>NUMBER]");
    curved_option(*sub, a->job.curved);
    threads_option(*sub, a->job.options.threads);
    file_option(*sub, "--json", a->json, "Write the report as JSON; - is stdout");
    file_option(*sub, "--html", a->html, "Write the report as an HTML page; - is stdout");
    add_ci_options(*sub, a->ci, "kinds of wrong rows (see --fail-on)");
    sub->add_flag("--quiet", a->quiet, "Print no report and no progress");
    sub->callback([=, &exit_code] {
        a->job.tolerance_given = tolerance->count() != 0;
        exit_code = run_verify(*a);
    });
}

}  // namespace barycert::cli

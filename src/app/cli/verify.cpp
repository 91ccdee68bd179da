// barycert verify: results of any tool, held against the exact ones.

#include "barycert/verify.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/verify_job.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"

namespace barycert::cli {
namespace {

int run_verify(Arguments<VerifyJob>& a) {
    a.reports.begin(a.job);
    return a.reports.end(verify_files(a.job), [&](const VerifyReport& r) {
        const Environment environment = measure_environment();
        const std::vector<VerifyLimit> failures = r.exceeded();
        Told told{.files = {{"--json", [&r, environment] { return verify_json(r, environment); }},
                            {"--html", [&r, environment] { return verify_html(r, environment); }},
                            {"--plot", [&a, &r] { return verify_plot(r, a.reports.path("--plot")); }}},
                  .text = [&r](bool colour) { return verify_text(r, colour); },
                  .ci = [&r, environment] { return verify_outcomes(r, environment); },
                  .notes = r.notes,
                  .curved = {r.curved},
                  .clean = failures.empty()};
        if (a.job.limits.empty()) return told;
        for (const VerifyLimit& limit : failures)
            told.failures += failure(fmt::format("{}: {}", base::printable(r.results), handle(limit.verdict)),
                                     std::to_string(r.verdicts.of(limit.verdict)), std::to_string(limit.most));
        return told;
    });
}

}  // namespace

void add_verify(const Options& program) {
    const auto& [o, a] = program.command(
        "verify", "Compare results of any tool with the exact ones: cells, inside or outside, values",
        R"(RESULTS: points with columns, as written by barycert sample, ParaView, pyvista, pandas or NumPy. A row is inside
or outside by vtkValidPointMask if there is one, else by the cell (negative: outside), else by the values (all
NaN: outside). Any cell that contains the
point is a right cell. Errors of values are told in ulps and in parts of the range of the field (max - min).
Exit codes: 0 all rows are right, 1 some are wrong (see --fail-on), 2 usage or input error.)",
        run_verify);
    VerifyJob& job = a.job;
    o.mesh(job.mesh);
    o.step(job.step);
    o.text("--results", job.results,
           "Points with results: " + base::suffix_list_read(base::Use::points) + "; - is CSV from stdin")
        ->required();
    o.field_files(job.field_files, "--field");
    o.text("--fields", job.fields,
           "Fields to compare, or what is made of them, as sample names it: A,B.x,|C|,...; default: those that the "
           "results have",
           "NAMES");
    constexpr const char* value = "FIELD=COLUMN";
    o.each("--value", value, "The column of the results for a value of the mesh (T, v.0, ...)",
           [&job](const std::string& text) {
               auto [field, column] = assignment("--value", value, text);
               job.values[field] = std::move(column);
           });
    o.text("--columns", job.columns, "Columns of the coordinates: names, or numbers from 1; default: x,y,z", "A,B,C");
    o.text("--cell-column", job.cell_column, "Column with the cell of each point; default: cell; none: no column",
           "NAME");
    o.integer("--cell-base", job.cell_base, 0, 1, "Number of the first cell in that column", "0|1");
    o.text("--mask-column", job.mask_column, "Column that is 0 outside; default: vtkValidPointMask; none: no column",
           "NAME");
    o.app()
        .add_option("--outside-value", job.options.outside_value,
                    "A row whose values are all this number is outside (tools that turn outside into 0)")
        ->type_name("NUMBER");
    o.nonfinite(job.options.nonfinite_points);
    auto* const tolerance =
        o.number("--tolerance", job.tolerance, 0,
                 "Largest error of a right value, in parts of the range of its field (where that is 0 of the "
                 "magnitude, and of 1 where the field is 0); default: 1e-9, or 1e-6 where all values are single "
                 "precision",
                 "T");
    o.flag("--exact", job.options.exact, "Right is only the exact value, rounded once, to the last bit")
        ->excludes(tolerance);
    o.integer<std::size_t>("--examples", job.options.examples, 0, 100000, "Number of rows shown of each kind of error");
    o.each("--fail-on", "KIND[>NUMBER]",
           "Exit with 1 only if there are more than NUMBER (0 if omitted) such rows; KIND is missed, invented, "
           "wrong_cell or wrong_value; several with commas, or repeated",
           [&job](const std::string& text) { job.limits.push_back(parse_verify_limit(text).value()); })
        ->delimiter(',');
    o.curved(job.curved);
    o.cell_interpolation(job.cell_interpolation);
    o.threads(job.options.threads);
    a.reports.file(o, "--json", "Write the report as JSON; - is stdout");
    a.reports.file(o, "--html", "Write the report as an HTML page; - is stdout");
    a.reports.picture(o, "--plot", "Draw histograms of the errors, in ulps and in parts of the range");
    a.reports.ci(o, "kinds of wrong rows (see --fail-on)");
    a.reports.quiet(o, "Print no report and no progress");
}

}  // namespace barycert::cli

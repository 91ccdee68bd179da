#include "contour_options.hpp"

#include <CLI/CLI.hpp>

#include <cmath>

#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/report.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "sampling_options.hpp"

namespace barycert::cli {

std::optional<std::vector<double>> finite_numbers(std::string_view text, char separator) {
    std::vector<double> all;
    for (;;) {
        const std::size_t end = text.find(separator);
        const std::optional<double> x = base::parse_double(text.substr(0, end));
        if (!x || !std::isfinite(*x)) return std::nullopt;
        all.push_back(*x);
        if (end == std::string_view::npos) return all;
        text.remove_prefix(end + 1);
    }
}

void add_contour_options(CLI::App& sub, ContourJob& job, bool& quiet) {
    step_options(sub, job.step);
    add_field_files(sub, job.field_files, "--field-file");
    sub.add_option("--fields", job.fields, "Fields to carry along: A,B,...; default: all")
        ->allow_extra_args(false)
        ->type_name("NAMES");
    curved_option(sub, job.curved);
    threads_option(sub, job.threads);
    vtk_data_option(sub, job.vtk_data);
    file_option(sub, "--json", job.report, "Write the summary as JSON; - is stdout");
    sub.add_flag("--quiet", quiet, "Print no summary and no progress");
}

Status check_picture_only(const CLI::App& sub, const std::string& output, const std::vector<const char*>& options) {
    for (const char* const name : options) {
        if (sub.get_option(name)->count() > 0 && !output.empty() && !io::has_suffix(output, ".png"))
            return Error{.what = std::string(name) + " is for pictures", .remedy = "leave it out, or name a .png file"};
    }
    return Done{};
}

int run_contour(ContourJob& job, bool quiet) {
    Progress progress(!quiet && stderr_is_terminal());
    job.progress = [&](const JobProgress& p) {
        p.done == 0 ? progress.stage(p.stage) : progress.count(p.stage, p.done);
    };
    job.program = command_name();
    const Result<ContourReport> summary = contour_files(job);
    progress.clear();
    if (!summary) return fail(summary.error());
    Status json = Done{}, told = Done{};
    if (!quiet) tell_important(summary->notes);
    if (!job.report.empty()) json = write_output(job.report, contour_json(*summary, measure_environment()));
    if (!quiet && job.report == "-") tell(contour_text(*summary, false));
    if (!quiet && job.report != "-") told = write_output("-", contour_text(*summary, colour_on_stdout()));
    if (!json) return fail(json.error());
    return told ? exit_clean : fail(told.error());
}

}  // namespace barycert::cli

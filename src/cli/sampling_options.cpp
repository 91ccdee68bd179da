#include "sampling_options.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/report.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace barycert::cli {
namespace {

/// The number after `word=`; nothing if the text is something else.
std::optional<double> number_after(std::string_view word, std::string_view text) {
    if (!text.starts_with(word) || text.substr(word.size(), 1) != "=") return std::nullopt;
    return base::parse_double(text.substr(word.size() + 1));
}

OutsidePolicy policy_of(const std::string& text) {
    if (text == "nan") return {};
    if (text == "error") return {.kind = Outside::error};
    if (text == "extrapolate") return {.kind = Outside::extrapolate};
    if (text == "nearest") return {.kind = Outside::nearest};
    if (const auto value = number_after("fill", text)) return {.kind = Outside::fill, .fill = *value};
    if (const auto limit = number_after("nearest", text); limit && std::isfinite(*limit) && *limit >= 0)
        return {.kind = Outside::nearest, .limit = *limit};
    const std::string word = text.substr(0, text.find('='));
    const bool known = word == "fill" || word == "nearest";
    const std::string meant =
        known ? (text == "fill" ? "say with what" : '"' + text.substr(text.find('=') + 1) + "\" is no such number") +
                    ": " + word + "=0.5"
              : base::did_you_mean(word, {"nan", "error", "fill", "nearest", "extrapolate"});
    throw CLI::ValidationError("--outside",
                               "expected nan, error, fill=NUMBER, nearest, nearest=DISTANCE (at least 0) or "
                               "extrapolate, found \"" +
                                   text + '"' + (meant.empty() ? "" : "; " + meant));
}

/// Whether the text is NAME@PATTERN, and where the pattern begins; a name may have an @, and a file an =.
std::optional<FieldFile> series_of(FieldFile::Of of, const std::string& text) {
    const std::size_t sign = text.find('@'), equals = text.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) return std::nullopt;
    const bool of_steps = text.find('*', sign) != std::string::npos || text.find(".pvd", sign) != std::string::npos ||
                          text.find(".series", sign) != std::string::npos;
    if (equals != std::string::npos && (equals < sign || !of_steps)) return std::nullopt;
    return FieldFile{of, text.substr(0, sign), text.substr(sign + 1)};
}

FieldFile field_file_of(const std::string& option, FieldFile::Of of, const std::string& text) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
        throw CLI::ValidationError(option, "expected NAME=FILE, found \"" + text + '"');
    FieldFile file{of, text.substr(0, sign), text.substr(sign + 1)};
    // FILE:COLUMN, where the file is the shortest beginning that there is; a file may have a colon in its name, and a
    // column, too.
    std::error_code ignored;
    const auto is_there = [&](const std::string& path) { return std::filesystem::exists(path, ignored); };
    std::size_t colon = is_there(file.path) ? std::string::npos : file.path.find(':');
    while (colon != std::string::npos && !is_there(file.path.substr(0, colon))) colon = file.path.find(':', colon + 1);
    if (colon == std::string::npos && !is_there(file.path)) colon = file.path.rfind(':');  // for the message
    if (colon != std::string::npos && colon != 0 && colon + 1 != file.path.size()) {
        file.column = file.path.substr(colon + 1);
        file.path.resize(colon);
    }
    return file;
}

Status write_reports(const SamplingJob& job, bool quiet, const SampleReport& summary) {
    Status json = Done{};
    if (!job.report.empty()) json = write_output(job.report, sample_json(summary, measure_environment()));
    if (quiet) return json;
    tell_important(summary.notes);
    if (job.output == "-" || job.report == "-") {
        tell(sample_text(summary, false));
        return json;
    }
    Status told = write_output("-", sample_text(summary, colour_on_stdout()));
    return json ? told : json;
}

}  // namespace

void add_field_files(CLI::App& sub, std::vector<FieldFile>& files, const std::string& either,
                     std::vector<FieldFile>* series) {
    struct Option {
        std::string name;
        FieldFile::Of of;
        std::string help;
    };
    for (const Option& o :
         {Option{either, FieldFile::Of::either,
                 std::string("Add a field: one row of numbers per node or per cell (text with blanks or commas, or "
                             ".npy); FILE:COLUMN: a column of a CSV or structured .npy file, or an array of another "
                             "mesh") +
                     (series == nullptr
                          ? ""
                          : "; NAME@'step-*.npy': a series, one file a step in natural order, or a .pvd "
                            "or .vtu.series file. {step} in --output: a file for each step; else columns NAME@STEP")},
          Option{"--point-field", FieldFile::Of::points, "Like " + either + "; the rows belong to nodes"},
          Option{"--cell-field", FieldFile::Of::cells, "Like " + either + "; the rows belong to cells"}}) {
        sub.add_option_function<std::vector<std::string>>(
               o.name,
               [&files, series, o](const std::vector<std::string>& all) {
                   for (const std::string& text : all) {
                       const auto steps = series == nullptr ? std::nullopt : series_of(o.of, text);
                       if (steps) {
                           series->push_back(*steps);
                       } else {
                           files.push_back(field_file_of(o.name, o.of, text));
                       }
                   }
               },
               o.help)
            ->allow_extra_args(false)
            ->type_name(series == nullptr ? "NAME=FILE[:COLUMN]" : "NAME=FILE[:COLUMN]|NAME@PATTERN[:COLUMN]");
    }
}

void nonfinite_option(CLI::App& sub, NonfinitePoints& value) {
    choice_option<NonfinitePoints>(
        sub, "--nonfinite-points", value, {{"error", NonfinitePoints::error}, {"nan", NonfinitePoints::nan}},
        "Points with a coordinate that is NaN, infinite or an empty field. error: the run ends (default); nan: they "
        "are outside, with NaN for values whatever points outside get, and counted");
}

void add_sampling_options(CLI::App& sub, SamplingJob& a, bool& quiet) {
    step_options(sub, a.step, &a.all_steps);
    add_field_files(sub, a.field_files, "--field", &a.series);
    sub.add_option(
           "--fields", a.fields,
           "Fields to sample: A,B,...; columns have this order, fields of nodes before fields of cells, and these "
           "before "
           "lengths; cell:A is the cell field A if there is also a node field "
           "A; default: all. Of each, or of these again: A.x or A.0, a component; |A|, the length; grad(A), the "
           "gradient in the owner; mean(A), cell data averaged to nodes by volume, then interpolated")
        ->allow_extra_args(false)
        ->type_name("NAMES");
    file_option(sub, "--weights", a.weights,
                "Write the correctly rounded weight of each node for each point, .npz: a sparse matrix for "
                "scipy.sparse.load_npz, to be multiplied with any field of the nodes");
    choice_option<Rounding>(sub, "--rounding", a.options.rounding,
                            {{"correct", Rounding::correct}, {"plain", Rounding::plain}},
                            "correct: the exact value, rounded once (default); plain: computed in double");
    sub.add_option_function<std::string>(
           "--outside", [&a](const std::string& text) { a.options.outside = policy_of(text); },
           "Value of points outside every cell: nan (default); error: fail; fill=NUMBER; nearest[=DISTANCE]: the value "
           "at the nearest point of the mesh, NaN beyond DISTANCE; extrapolate: the function of the nearest cell")
        ->type_name("nan|error|fill=V|nearest[=D]|extrapolate");
    curved_option(sub, a.curved);
    threads_option(sub, a.options.threads);
    vtk_data_option(sub, a.vtk_data);
    file_option(sub, "--json", a.report, "Write the summary as JSON; - is stdout");
    sub.add_flag("--quiet", quiet, "Print no summary, no notes and no progress");
}

int run_sampling(SamplingJob& job, bool quiet, const std::function<Result<SampleReport>()>& run) {
    // Rows on the same terminal would run into the progress.
    const bool rows_on_terminal = job.output == "-" && isatty(STDOUT_FILENO) == 1;
    Progress progress(!quiet && stderr_is_terminal() && !rows_on_terminal);
    job.progress = [&](const JobProgress& p) {
        p.done == 0 ? progress.stage(p.stage) : progress.count(p.stage, p.done);
    };
    job.program = command_name();
    job.count_degenerate = !quiet || !job.report.empty();
    const Result<SampleReport> summary = run();
    progress.clear();
    if (!summary) return fail(summary.error());
    const Status written = write_reports(job, quiet, *summary);
    return written ? exit_clean : fail(written.error());
}

}  // namespace barycert::cli

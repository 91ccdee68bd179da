// Series: fields of which there is a file for each step.

#include "barycert/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "app/jobs/job_files.hpp"
#include "barycert/job.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/named_file.hpp"
#include "io/paths.hpp"
#include "io/series_steps.hpp"

namespace barycert::jobs {
namespace {

using base::step_place, base::time_place;

/// Sorts runs of digits by their value, all else by its bytes; texts that differ in leading zeros alone by length.
auto natural_order(const std::string& text) {
    std::vector<std::tuple<char, std::size_t, std::string>> parts;  // any digit, and the length of the number and it
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
        if (end == at) {
            parts.emplace_back(text[at++], 0, "");
            continue;
        }
        const std::size_t begin = std::min(text.find_first_not_of('0', at), end);
        parts.emplace_back('0', end - begin, text.substr(begin, end - begin));
        at = end;
    }
    return std::tuple(std::move(parts), text.size(), text);
}

/// The step of one series. The array has the name of the field, unless another one is given.
Step step_of(const std::string& label, FieldFile series, const std::string& path) {
    series.path = path;
    FieldInput file = field_input(std::move(series));
    if (file.column.empty() && file.source == FieldSource::mesh) file.column = file.name;
    return {.label = label, .files = {std::move(file)}};
}

/// FILE and COLUMN of FILE:COLUMN, split at the last colon; nothing where there is none.
std::optional<FieldFile> without_column(FieldFile series) {
    const std::size_t colon = series.path.rfind(':');
    if (colon == std::string::npos || colon + 1 == series.path.size()) return std::nullopt;
    series.column = series.path.substr(colon + 1);
    series.path.resize(colon);
    return series;
}

/// The steps of a .pvd or .vtu.series file, by their times.
std::vector<Step> steps_of_file(const FieldFile& series) {
    const std::vector<SeriesStep> steps = read_series(series.path).value();
    std::vector<Step> found;
    for (const SeriesStep& step : steps) {
        const std::string label = base::shortest(step.time);
        const bool twice = std::ranges::find(found, label, &Step::label) != found.end();
        if (step.files.size() != 1 || twice)
            refuse("series.step", series.path, "step " + label + " of the series \"" + series.name + '"', "one file",
                   twice ? "another one of the same time" : std::to_string(step.files.size()) + " files",
                   "gather the parts of a step in a .pvtu file");
        found.push_back(step_of(label, series, step.files.front()));
        found.back().time = label;
    }
    if (found.empty()) refuse("series.step", series.path, "no step in the series \"" + series.name + '"');
    return found;
}

/// Label and path of each file that the pattern matches.
std::vector<Step> matches_of(const FieldFile& series) {
    const std::string& pattern = series.path;
    const auto stars = std::count(pattern.begin(), pattern.end(), '*');
    if (stars != 1)
        refuse("series.place", pattern, "pattern of the series \"" + series.name + '"',
               "one *, where the files of the steps differ, such as 'step-*.npy', or a .pvd or .vtu.series file",
               std::to_string(stars),
               "quote the pattern, so that the shell leaves it as it is; for one file write NAME=FILE");
    // FOLDER/BEFORE*AFTER/REST: entries of one folder are looked at.
    const std::size_t star = pattern.find('*'), slash = pattern.rfind('/', star), next = pattern.find('/', star);
    const std::string folder = slash == std::string::npos ? "" : pattern.substr(0, slash + 1);
    const std::string before = pattern.substr(folder.size(), star - folder.size());
    const std::string after = pattern.substr(star + 1, next == std::string::npos ? next : next - star - 1);
    const std::string rest = next == std::string::npos ? "" : pattern.substr(next);
    std::vector<Step> found;
    std::error_code failed;
    for (const std::string& entry : base::names_in_folder(folder.empty() ? "." : folder, failed)) {
        if (entry.size() < before.size() + after.size() || !entry.starts_with(before) || !entry.ends_with(after) ||
            (before.empty() && entry.starts_with('.')))
            continue;
        const std::string path = fmt::format("{}{}{}", folder, entry, rest);
        if (!rest.empty() && !io::exists(path)) continue;
        found.push_back(
            step_of(entry.substr(before.size(), entry.size() - before.size() - after.size()), series, path));
    }
    const auto split = without_column(series);
    if (found.empty() && failed.value() == 0 && series.column.empty() && split && split->path.size() > star)
        return matches_of(*split);
    if (found.empty() || failed)
        refuse("file.missing", pattern, "no file of the series \"" + series.name + '"',
               "at least one file for the pattern", failed ? failed.message() : "none",
               "check the folder and the pattern");
    std::ranges::sort(found, {}, [](const Step& step) { return natural_order(step.label); });
    return found;
}

bool names_steps(const std::string& path) {
    return base::is_read_as(path, base::Use::steps);
}

/// Refuses a word in braces that is nearly one of the places of steps.
void check_places(const std::string& output) {
    for (std::size_t open = output.find('{'); open != std::string::npos; open = output.find('{', open + 1)) {
        const std::string word = output.substr(open + 1, output.find('}', open) - open - 1);
        const std::string meant = base::nearest_name(word, {"step", "time"});
        if (!meant.empty())
            refuse_member("series.place", "job.output", output, "a place that is not known in job.output",
                          "{step} or {time}", '{' + word + '}', "did you mean {" + meant + "}?");
    }
}

std::vector<Step> steps_of_series(const std::vector<FieldFile>& series) {
    std::vector<Step> steps;
    for (const FieldFile& one : series) {
        // FILE.pvd, or FILE.pvd:COLUMN; also of .vtu.series.
        const auto file = names_steps(one.path) ? one : without_column(one);
        std::vector<Step> found = file && names_steps(file->path) ? steps_of_file(*file) : matches_of(one);
        if (steps.empty()) {
            steps = std::move(found);
            continue;
        }
        for (std::size_t i = 0; i < std::max(found.size(), steps.size()); ++i) {
            const auto name = [i](const std::vector<Step>& all) {
                return i < all.size() ? "step \"" + all[i].label + '"' : "no further step";
            };
            // Both are sorted alike: the first that differ are not in the other one.
            if (name(steps) != name(found))
                refuse("series.differs", one.path,
                       "the series \"" + one.name + "\" and \"" + series.front().name + "\" have different steps",
                       name(steps), name(found), "name files that differ alike");
            steps[i].files.push_back(std::move(found[i].files.front()));
        }
    }
    return steps;
}

}  // namespace

std::vector<Step> find_steps(const SamplingJob& job) {
    const bool place = has_step_place(job.output), series = names_steps(job.mesh);
    if ((series || !job.series.empty()) && !place) check_places(job.output);
    // The steps of which of them? And which mesh would be that of a step of the fields?
    const bool both = !job.series.empty() && (job.all_steps || (place && series && !job.step.made()));
    if (!job.series.empty() && !both) return steps_of_series(job.series);
    if (both)
        refuse_member("option.conflict", "job.step", job.mesh, "all steps of the mesh, and of series of fields", "", "",
                      "choose one step of the mesh: job.step N");
    if (job.all_steps && !series) throw Exception(io::no_series(job.mesh));
    if (job.all_steps && !place)
        refuse_member("series.place", "job.output", job.output, "no name for the output of each step",
                      "{step} or {time} in job.output", "", "such as job.output 'rows-{step}.csv'");
    std::vector<Step> steps;
    if (!place || !series) return steps;
    const std::vector<SeriesStep> all = read_series(job.mesh).value();
    const std::size_t chosen = io::chosen_step(all, job.step, job.mesh).value();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (job.step.made() && i != chosen) continue;
        // Before there is an output of any step.
        for (const std::string& file : all[i].files) {
            if (!io::exists(file))
                refuse_member("file.missing", "job.step", file,
                              "no such file, which step " + std::to_string(i) + " of the series names", "", "",
                              "restore it, or choose one step: job.step N");
        }
        steps.push_back({.label = std::to_string(i), .time = base::shortest(all[i].time), .of_mesh = i});
    }
    return steps;
}

std::string output_of_step(const std::string& output, const Step& step) {
    std::string path = output;
    for (const auto& [place, text] : {std::pair(step_place, step.label), std::pair(time_place, step.time)}) {
        if (!text.empty()) base::replace_all(path, place, text);
    }
    return path;
}

}  // namespace barycert::jobs

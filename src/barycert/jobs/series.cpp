#include "barycert/jobs/series.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/vtk/collection.hpp"
#include "barycert/jobs/field_files.hpp"
#include "barycert/jobs/job_files.hpp"

namespace barycert::jobs {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Runs of digits by their value, all else by its bytes; texts that differ in leading zeros alone by length.
bool naturally_before(std::string_view a, std::string_view b) {
    std::size_t i = 0, k = 0;
    while (i < a.size() && k < b.size()) {
        if (!is_digit(a[i]) || !is_digit(b[k])) {
            if (a[i] != b[k]) return a[i] < b[k];
            ++i;
            ++k;
            continue;
        }
        const auto number = [](std::string_view text, std::size_t& at) {
            while (at < text.size() && text[at] == '0') ++at;
            const std::size_t begin = at;
            while (at < text.size() && is_digit(text[at])) ++at;
            return text.substr(begin, at - begin);
        };
        const std::string_view x = number(a, i), y = number(b, k);
        if (x.size() != y.size()) return x.size() < y.size();
        if (x != y) return x < y;
    }
    if (i < a.size() || k < b.size()) return k < b.size();
    return a.size() != b.size() ? a.size() < b.size() : a < b;
}

/// A step of one series.
using LabelledFile = std::pair<std::string, FieldFile>;

/// The array has the name of the field, unless another one is given.
LabelledFile labelled(const std::string& label, const FieldFile& series, const std::string& path) {
    LabelledFile step{label, series};
    step.second.path = path;
    if (series.column.empty() && is_file_of_a_mesh(path)) step.second.column = series.name;
    return step;
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
Result<std::vector<LabelledFile>> steps_of_file(const FieldFile& series) {
    const auto steps = read_series(series.path);
    if (!steps) return steps.error();
    std::vector<LabelledFile> found;
    for (const SeriesStep& step : *steps) {
        const std::string label = base::shortest(step.time);
        const bool twice =
            std::any_of(found.begin(), found.end(), [&](const LabelledFile& other) { return other.first == label; });
        if (step.files.size() != 1 || twice)
            return refusal(series.path, "step " + label + " of the series \"" + series.name + '"', "one file",
                           twice ? "another one of the same time" : std::to_string(step.files.size()) + " files",
                           "gather the parts of a step in a .pvtu file");
        found.push_back(labelled(label, series, step.files.front()));
    }
    if (found.empty()) return refusal(series.path, "no step in the series \"" + series.name + '"');
    return found;
}

/// Label and path of each file that the pattern matches.
Result<std::vector<LabelledFile>> matches_of(const FieldFile& series) {
    const std::string& pattern = series.path;
    const auto stars = std::count(pattern.begin(), pattern.end(), '*');
    if (stars != 1)
        return refusal(
            pattern, "pattern of the series \"" + series.name + '"',
            "one *, where the files of the steps differ, such as 'step-*.npy', or a .pvd or .vtu.series file",
            std::to_string(stars),
            "quote the pattern, so that the shell leaves it as it is; for one file write NAME=FILE");
    // FOLDER/BEFORE*AFTER/REST: entries of one folder are looked at.
    const std::size_t star = pattern.find('*'), slash = pattern.rfind('/', star), next = pattern.find('/', star);
    const std::string folder = slash == std::string::npos ? "" : pattern.substr(0, slash + 1);
    const std::string before = pattern.substr(folder.size(), star - folder.size());
    const std::string after = pattern.substr(star + 1, next == std::string::npos ? next : next - star - 1);
    const std::string rest = next == std::string::npos ? "" : pattern.substr(next);
    std::vector<LabelledFile> found;
    std::error_code failed, unknown;
    for (const std::string& entry : base::names_in_folder(folder.empty() ? "." : folder, failed)) {
        if (entry.size() < before.size() + after.size() || !entry.starts_with(before) || !entry.ends_with(after) ||
            (before.empty() && entry.starts_with('.')))
            continue;
        const std::string path = fmt::format("{}{}{}", folder, entry, rest);
        if (!rest.empty() && !fs::exists(path, unknown)) continue;
        found.push_back(
            labelled(entry.substr(before.size(), entry.size() - before.size() - after.size()), series, path));
    }
    const auto split = without_column(series);
    if (found.empty() && failed.value() == 0 && series.column.empty() && split && split->path.size() > star)
        return matches_of(*split);
    if (found.empty() || failed)
        return refusal(pattern, "no file of the series \"" + series.name + '"', "at least one file for the pattern",
                       failed ? failed.message() : "none", "check the folder and the pattern");
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return naturally_before(a.first, b.first); });
    return found;
}

bool names_steps(const std::string& path) {
    return has_suffix_of(path, ".pvd .series");
}

/// FILE.pvd, or FILE.pvd:COLUMN; also of .vtu.series.
std::optional<FieldFile> file_of_steps(const FieldFile& series) {
    if (names_steps(series.path)) return series;
    const auto split = without_column(series);
    return split && names_steps(split->path) ? split : std::nullopt;
}

/// Error: a word in braces that is nearly one of the places of steps.
Status check_places(const std::string& output) {
    for (std::size_t open = output.find('{'); open != std::string::npos; open = output.find('{', open + 1)) {
        const std::string word = output.substr(open + 1, output.find('}', open) - open - 1);
        const std::string meant = base::nearest_name(word, {"step", "time"});
        if (!meant.empty())
            return refusal(output, "a place that is not known in job.output", "{step} or {time}", '{' + word + '}',
                           "did you mean {" + meant + "}?");
    }
    return Done{};
}

}  // namespace

Result<std::vector<Step>> find_steps(const std::vector<FieldFile>& series) {
    std::vector<Step> steps;
    for (std::size_t s = 0; s < series.size(); ++s) {
        const auto file = file_of_steps(series[s]);
        auto found = file ? steps_of_file(*file) : matches_of(series[s]);
        if (!found) return found.error();
        if (s == 0) steps.resize(found->size());
        for (std::size_t i = 0; i < std::max(found->size(), steps.size()); ++i) {
            const bool both = i < found->size() && i < steps.size();
            if (s == 0) steps[i].label = (*found)[i].first;
            if (s == 0 && file) steps[i].time = steps[i].label;
            if (!both || steps[i].label != (*found)[i].first) {
                // Both are sorted alike: the first that differ are not in the other one.
                const auto name = [](bool there, const std::string& label) {
                    return there ? "step \"" + label + '"' : std::string("no further step");
                };
                return refusal(
                    series[s].path,
                    "the series \"" + series[s].name + "\" and \"" + series[0].name + "\" have different steps",
                    name(i < steps.size(), i < steps.size() ? steps[i].label : ""),
                    name(i < found->size(), i < found->size() ? (*found)[i].first : ""),
                    "name files that differ alike");
            }
            steps[i].files.push_back((*found)[i].second);
        }
    }
    return steps;
}

Result<std::vector<Step>> find_steps(const SamplingJob& job) {
    const bool place = has_step_place(job.output), series = names_steps(job.mesh);
    if ((series || !job.series.empty()) && !place) {
        if (const Status spelt = check_places(job.output); !spelt) return spelt.error();
    }
    // The steps of which of them? And which mesh would be that of a step of the fields?
    const bool both = !job.series.empty() && (job.all_steps || (place && series && !job.step.made()));
    if (!job.series.empty() && !both) return find_steps(job.series);
    if (both)
        return refusal(job.mesh, "all steps of the mesh, and of series of fields", "", "",
                       "choose one step of the mesh: job.step N");
    if (job.all_steps && !series) return io::no_series(job.mesh);
    if (job.all_steps && !place)
        return refusal(job.output, "no name for the output of each step", "{step} or {time} in job.output", "",
                       "such as job.output 'rows-{step}.csv'");
    if (!place || !series) return std::vector<Step>();
    const auto all = read_series(job.mesh);
    if (!all) return all.error();
    const Result<std::size_t> chosen = io::chosen_step(*all, job.step, job.mesh);
    if (!chosen) return chosen.error();
    std::vector<Step> steps;
    for (std::size_t i = 0; i < all->size(); ++i) {
        if (job.step.made() && i != *chosen) continue;
        // Before there is an output of any step.
        for (const std::string& file : (*all)[i].files) {
            if (std::error_code failed; !fs::exists(file, failed))
                return refusal(file, "no such file, which step " + std::to_string(i) + " of the series names", "", "",
                               "restore it, or choose one step: job.step N");
        }
        steps.push_back({.label = std::to_string(i), .time = base::shortest((*all)[i].time), .of_mesh = i});
    }
    return steps;
}

bool has_step_place(const std::string& output) {
    return output.find(step_place) != std::string::npos || output.find(time_place) != std::string::npos;
}

std::string output_of_step(const std::string& output, const Step& step) {
    std::string path = output;
    for (const auto& [place, text] : {std::pair(step_place, step.label), std::pair(time_place, step.time)}) {
        if (text.empty()) continue;
        for (std::size_t at = path.find(place); at != std::string::npos; at = path.find(place, at + text.size()))
            path.replace(at, place.size(), text);
    }
    return path;
}

std::string name_of_step(const std::string& name, const Step& step) {
    return name + '@' + step.label;
}

Status check_step_outputs(const std::vector<base::NamedFile>& inputs, const std::string& output,
                          const std::vector<Step>& steps) {
    // By device and inode: there may be thousands of each. What does not exist is no input.
    std::map<std::pair<dev_t, ino_t>, std::string> known;
    const auto add = [&](const std::string& path, const std::string& what) -> const std::string* {
        struct stat status {};
        if (path == "-" || ::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return nullptr;
        const auto [at, inserted] = known.emplace(std::pair(status.st_dev, status.st_ino), what);
        return inserted ? nullptr : &at->second;
    };
    for (const base::NamedFile& in : inputs) add(in.path, in.what);
    std::set<std::string> names;
    for (const Step& step : steps) {
        const std::string path = output_of_step(output, step);
        if (!names.insert(path).second)
            return refusal(path, "two steps have the same output", "", "", "put {step} into the name of job.output");
        if (const std::string* const before = add(path, "job.output of another step"))
            return refusal(path, "job.output would overwrite " + *before, "", "", "choose another name for the output");
    }
    return Done{};
}

}  // namespace barycert::jobs

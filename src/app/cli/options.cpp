#include "app/cli/options.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cli/command.hpp"
#include "app/options/command_table.hpp"
#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "io/paths.hpp"

namespace barycert::cli {
namespace {

/// Whether the text is NAME@PATTERN, and where the pattern begins; a name may have an @, and a file an =.
std::optional<FieldFile> series_of(FieldFile::Of of, Text text) {
    const std::size_t sign = text.find('@'), equals = text.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) return std::nullopt;
    const bool of_steps = text.find('*', sign) != std::string::npos || text.find(".pvd", sign) != std::string::npos ||
                          text.find(".series", sign) != std::string::npos;
    if (equals != std::string::npos && (equals < sign || !of_steps)) return std::nullopt;
    return FieldFile{of, text.substr(0, sign), text.substr(sign + 1)};
}

FieldFile field_file_of(Text option, FieldFile::Of of, Text text) {
    auto [name, rest] = assignment(option, "NAME=FILE", text);
    FieldFile file{of, std::move(name), std::move(rest)};
    // FILE:COLUMN, where the file is the shortest beginning that there is: both may have colons in their names.
    std::size_t colon = io::exists(file.path) ? std::string::npos : file.path.find(':');
    while (colon != std::string::npos && !io::exists(file.path.substr(0, colon)))
        colon = file.path.find(':', colon + 1);
    if (colon == std::string::npos && !io::exists(file.path)) colon = file.path.rfind(':');  // for the message
    if (colon != std::string::npos && colon != 0 && colon + 1 != file.path.size()) {
        file.column = file.path.substr(colon + 1);
        file.path.resize(colon);
    }
    return file;
}

}  // namespace

void refuse_option(Text option, Text expected, Text found) {
    throw CLI::ValidationError(option, fmt::format("expected {}, found \"{}\"", expected, found));
}

std::string given_option(const CLI::App& app, const std::vector<std::string_view>& names, bool others) {
    for (const CLI::Option* option : app.get_options()) {
        const bool named = std::find(names.begin(), names.end(), option->get_name()) != names.end();
        if (option->count() != 0 && named != others) return option->get_name();
    }
    return "";
}

std::pair<std::string, std::string> assignment(Text option, Text expected, Text text) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) refuse_option(option, expected, text);
    return {text.substr(0, sign), text.substr(sign + 1)};
}

CLI::Option* Options::text_like(CLI::Option* option, Text type, bool several) {
    if (several) option->allow_extra_args(false);
    if (is_type_of_files(type))
        option->check(
            {[](std::string& text) { return text.empty() ? "expected the name of a file, found \"\"" : ""; }, ""});
    return option->type_name(type);
}

CLI::Option* Options::taken(Text name, Text type, Text help, Text expected,
                            const std::function<bool(Text)>& take) const {
    const auto read = [=](Text text) {
        if (!take(text)) refuse_option(name, expected, text);
    };
    return app_->add_option_function<std::string>(name, read, with_command_name(help))->type_name(type);
}

CLI::Option* Options::each(Text name, Text type, Text help, const std::function<void(Text)>& take) const {
    const auto take_all = [take](const std::vector<std::string>& texts) {
        for (Text text : texts) take(text);
    };
    return text_like(app_->add_option_function<std::vector<std::string>>(name, take_all, with_command_name(help)), type,
                     true);
}

void Options::cell_interpolation(CellInterpolation& interpolation) const {
    choice<CellInterpolation>(
        "--interpolation", interpolation,
        {{"linear", CellInterpolation::linear}, {"multilinear", CellInterpolation::multilinear}},
        "Of cells that are no triangles or tetrahedra: linear (default) on the simplices that each is cut into, or "
        "multilinear: the isoparametric function of hexahedra, wedges, pyramids and quadrilaterals");
}

void Options::curved(Curved& curved) const {
    choice<Curved>(
        "--curved", curved,
        {{"isoparametric", Curved::isoparametric},
         {"straight", Curved::straight},
         {"refuse", Curved::refuse},
         {"exact", Curved::exact}},
        "Second-order cells with mid-edge nodes off the middle: isoparametric: take them as they are where "
        "points are located (default), elsewhere their sides as straight, and say so; exact: likewise, and nodes "
        "that are off by rounding as well; straight: everywhere; refuse: fail");
}

void Options::vtk_data(std::optional<VtkData>& data) const {
    std::vector<std::pair<std::string, std::optional<VtkData>>> choices;
    choices.reserve(std::size(vtk_data_names));
    for (const std::string_view word : vtk_data_names) choices.emplace_back(word, vtk_data_named(word));
    choice("--vtk-data", data, choices,
           "Numbers in an output of VTK's formats: raw (default), zlib, lz4, lzma (compressed), ascii (text)");
}

void Options::nonfinite(NonfinitePoints& points) const {
    choice<NonfinitePoints>(
        "--nonfinite-points", points, {{"error", NonfinitePoints::error}, {"nan", NonfinitePoints::nan}},
        "Points with a coordinate that is NaN, infinite or an empty field. error: the run ends (default); nan: they "
        "are outside, with NaN for values whatever points outside get, and counted");
}

void Options::step(StepChoice& step, bool* all) const {
    auto* const number =
        taken("--step", all != nullptr ? "N|all|last" : "N|last",
              std::string("Of a MESH that is a series (.pvd, .vtu.series, .vtp.series): the step to read, by its "
                          "number from 0; default: the first") +
                  (all == nullptr ? "" : ", or all where {step} or {time} stands in --output: a file for each"),
              std::string("a number from 0, ") + (all != nullptr ? "all or last" : "or last"), [&step, all](Text text) {
                  if (all != nullptr && text == "all") return *all = true;
                  if (text == "last") return step.last = true;
                  step.number = base::whole_number<std::size_t>(text);
                  return step.number.has_value();
              });
    parsed("--time", "T", "The step of exactly this time in the file", "a finite number", step.time, finite)
        ->excludes(number);
}

void Options::field_files(std::vector<FieldFile>& files, Text either, std::vector<FieldFile>* series) const {
    const std::string any =
        std::string(
            "Add a field: one row of numbers per node or per cell (text with blanks or commas, or .npy); FILE:COLUMN: "
            "a column of a CSV or structured .npy file, or an array of another mesh") +
        (series == nullptr ? ""
                           : "; NAME@'step-*.npy': a series, one file a step in natural order, or a .pvd or "
                             ".vtu.series file. {step} in --output: a file for each step; else columns NAME@STEP");
    const std::string type = series == nullptr ? "NAME=FILE[:COLUMN]" : "NAME=FILE[:COLUMN]|NAME@PATTERN[:COLUMN]";
    const auto add = [&](Text name, FieldFile::Of of, Text help) {
        each(name, type, help, [=, &files](Text text) {
            const auto steps = series == nullptr ? std::nullopt : series_of(of, text);
            steps ? series->push_back(*steps) : files.push_back(field_file_of(name, of, text));
        });
    };
    add(either, FieldFile::Of::either, any);
    add("--point-field", FieldFile::Of::points, "Like " + either + "; the rows belong to nodes");
    add("--cell-field", FieldFile::Of::cells, "Like " + either + "; the rows belong to cells");
}

}  // namespace barycert::cli

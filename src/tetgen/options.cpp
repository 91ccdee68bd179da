#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>

#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "options/parser.hpp"

namespace barycert {

std::string Options::tetgen_switches() const {
    if (switches) return *switches + (switches->find('n') == std::string::npos ? "n" : "");
    std::string text = "pn";
    // In full digits: TetGen reads no exponent after -q.
    if (refines()) text += fmt::format("q{:.10f}", ratio.value_or(2));
    if (min_dihedral) text += fmt::format("/{:.10f}", *min_dihedral);
    if (max_volume) text += "a" + fmt::format("{}", *max_volume);
    if (keep_boundary) text += "Y";
    if (order == 2) text += "o2";
    return text;
}

bool Options::diagnoses() const {
    return switches && switches->find('d') != std::string::npos;
}

std::string Options::described() const {
    std::string text = "barycert-tetgen " + std::filesystem::path(input).filename().string();
    if (switches) text += " --switches " + *switches;
    if (refines()) text += " --quality " + base::shortest(ratio.value_or(2));
    if (min_dihedral) text += " --min-dihedral " + base::shortest(*min_dihedral);
    if (max_volume) text += " --max-volume " + base::shortest(*max_volume);
    if (order != 1) text += fmt::format(" --order {}", order);
    if (keep_boundary) text += " --keep-boundary";
    if (index_base) text += fmt::format(" --index-base {}", *index_base);
    return text;
}

namespace {

/// STEM.1 of STEM.poly; STEM.2 of STEM.1.poly, as TetGen counts.
std::string default_output(const std::string& input) {
    std::filesystem::path stem = std::filesystem::path(input).replace_extension();
    const std::string last = stem.extension().string();
    const auto number = cli::integer_of<int>(std::string_view(last).substr(last.empty() ? 0 : 1));
    if (!number || *number < 0 || *number == std::numeric_limits<int>::max()) return stem.string() + ".1";
    return stem.replace_extension().string() + "." + std::to_string(*number + 1);
}

}  // namespace

std::optional<int> parse_options(int argc, char** argv, Options& options) {
    CLI::App app{"Meshes a PLC by TetGen: .poly .smesh .off .stl .ply .obj in; .node .ele .face .neigh out."};
    app.name("barycert-tetgen");
    add_options(app, options);
    try {
        try {
            app.parse(argc, argv);
        } catch (const CLI::RequiredError&) {
            // That there is no INPUT is told below.
        }
        if (options.input.empty()) throw std::invalid_argument("expected INPUT, a PLC");
    } catch (const CLI::Success& wish) {  // --help, --version
        const int code = app.exit(wish);
        std::cout.flush();
        if (std::cout) return code;
        throw Exception({.what = "cannot write to stdout", .found = std::strerror(errno)});
    } catch (const std::bad_alloc&) {
        throw;  // it is not about an option
    } catch (const std::exception& problem) {
        throw Exception({.what = cli::usage_error(app, problem, "run barycert-tetgen --help for the usage")});
    }
    if (options.output.empty()) options.output = default_output(options.input);
    options.output = tetgen_stem(options.output);
    return std::nullopt;
}

}  // namespace barycert

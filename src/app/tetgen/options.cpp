#include "app/tetgen/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "app/options/parser.hpp"
#include "barycert/result.hpp"
#include "barycert/tetgen_files.hpp"
#include "core/base/text.hpp"

namespace barycert {
namespace {

/// Refuses what would go wrong silently: TetGen copies numbers and its command line into buffers of fixed size,
/// ignores unknown switches, and some switches name files or outputs that do not exist here.
void check_switches(const std::string& switches) {
    const std::string known = "pqaAYMDOoSTXCdVQJBlLbxcfen";
    constexpr std::size_t longest = 200;
    if (switches.size() > longest) throw std::invalid_argument("--switches: longer than 200 characters");
    if (switches.empty()) throw std::invalid_argument("--switches: expected TetGen's switches, found nothing");
    if (switches.front() == '-') throw std::invalid_argument("--switches: expected no dash before TetGen's switches");
    if (const std::size_t bad = switches.find_first_not_of(known + "0123456789./,+-"); bad != std::string::npos)
        throw std::invalid_argument(
            fmt::format("--switches: expected letters of {} with their numbers, found '{}'; switches for other "
                        "inputs and outputs than a PLC and a mesh are not supported",
                        known, switches[bad]));
}

/// A number of [low, high]; `range` says so in the error.
double number_in(const char* option, const std::string& text, double low, double high, const char* range) {
    const std::optional<double> value = base::parse_double(text);
    if (value && *value >= low && *value <= high) return *value;
    throw std::invalid_argument(fmt::format("{}: expected {}, found {}", option, range, text));
}

/// STEM.1 of STEM.poly; STEM.2 of STEM.1.poly, as TetGen counts.
std::string default_output(const std::string& input) {
    std::filesystem::path stem = std::filesystem::path(input).replace_extension();
    const std::string last = stem.extension().string();
    const auto number = base::whole_number<int>(std::string_view(last).substr(last.empty() ? 0 : 1));
    if (!number || *number < 0 || *number == std::numeric_limits<int>::max()) return stem.string() + ".1";
    return stem.replace_extension().string() + "." + std::to_string(*number + 1);
}

}  // namespace

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

void add_options(CLI::App& app, Options& options) {
    using Text = const std::string&;
    const auto add = [&](const char* name, const char* type, const char* help, auto take) {
        return app.add_option_function<std::string>(name, std::move(take), help)->type_name(type);
    };
    const auto number = [&](const char* name, const char* type, const char* help, auto& to, double low, double high,
                            const char* range) {
        return add(name, type, help,
                   [&to, name, low, high, range](Text text) { to = number_in(name, text, low, high, range); });
    };
    constexpr double tiny = std::numeric_limits<double>::min(), unbounded = std::numeric_limits<double>::max();
    app.footer("Exit codes: 0 meshed; 2 usage or input error, or TetGen failed.");
    app.set_version_flag("--version", "barycert-tetgen " BARYCERT_VERSION " (TetGen 1.5)");
    app.add_option("INPUT", options.input, "The PLC: .poly, .smesh, .off, .stl, .ply or .obj")
        ->type_name("FILE")
        ->required();
    add("--output", "FILE", "Stem of the output files, with or without .node; default: stem of INPUT plus .1",
        [&options](Text text) {
            if (text.empty() || text == "-")
                throw std::invalid_argument("--output: expected the stem of files, found \"" + text + '"');
            options.output = text;
        });
    // A regular tetrahedron has the smallest ratio there is, 0.61, and the largest dihedral angle, 70.5 degrees.
    auto* quality =
        add("--quality", "[RATIO]", "Max radius-edge ratio, default 2 (TetGen -q)", [&options](Text text) {
            // INPUT, declared above, has been taken by now: else --quality took it, perhaps.
            if (options.input.empty() && !text.empty() && base::parse_double(text).value_or(0) == 0)
                throw std::invalid_argument("--quality: expected a number, found " + text + "; put INPUT first");
            options.ratio = text.empty() ? 2 : number_in("--quality", text, 1, 1e6, "a ratio of at least 1");
        })->expected(0, 1);
    auto* dihedral = number("--min-dihedral", "DEGREES", "Min dihedral angle to aim for, in degrees",
                            options.min_dihedral, 0, 70, "an angle from 0 to 70 degrees");
    auto* volume = number("--max-volume", "V", "Max volume of a cell (TetGen -a)", options.max_volume, tiny, unbounded,
                          "a volume greater than 0");
    auto* order = app.add_option("--order", options.order, "2: second-order cells of ten nodes (TetGen -o2)")
                      ->check(cli::one_of({"1", "2"}))
                      ->type_name("1|2");
    auto* keep = app.add_flag("--keep-boundary", options.keep_boundary, "Add no nodes on the boundary (TetGen -Y)");
    auto* raw = add("--switches", "STRING", "TetGen's own switches instead of these options, such as pq1.4a0.1",
                    [&options](Text text) {
                        check_switches(text);
                        options.switches = text;
                    });
    app.add_option("--index-base", options.index_base, "Number from 0 or 1; default: as INPUT does")
        ->check(cli::one_of({"0", "1"}))
        ->type_name("0|1");
    app.add_flag("--quiet", options.quiet, "Print no summary");
    number("--timeout", "SECONDS", "Stop after this time", options.timeout, 1e-3, 1e9, "a time of 0.001 to 1e9 s");
    for (auto* option : {quality, dihedral, volume, order, keep}) raw->excludes(option);
}

std::optional<int> parse_options(int argc, char** argv, Options& options) {
    CLI::App app{"Meshes a PLC by TetGen: .poly .smesh .off .stl .ply .obj in; .node .ele .face .neigh out."};
    app.name("barycert-tetgen");
    add_options(app, options);
    try {
        try {
            app.parse(argc, argv);
        } catch (const CLI::RequiredError&) {
            // The error is told below, where INPUT is missing.
        }
        if (options.input.empty()) throw std::invalid_argument("expected INPUT, a PLC");
    } catch (const CLI::Success& wish) {  // --help, --version
        const int code = app.exit(wish);
        std::cout.flush();
        if (std::cout) return code;
        throw Exception({.code = "file.unwritable", .what = "cannot write to stdout", .found = std::strerror(errno)});
    } catch (const std::bad_alloc&) {
        throw;  // it is not about an option
    } catch (const std::exception& problem) {
        throw Exception({.code = "option.usage",
                         .what = cli::usage_error(app, problem, "run barycert-tetgen --help for the usage")});
    }
    if (options.output.empty()) options.output = default_output(options.input);
    options.output = tetgen_stem(options.output);
    return std::nullopt;
}

}  // namespace barycert

#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>
#include <stdexcept>

#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "options/parser.hpp"

namespace barycert {
namespace {

/// Refuses what would go wrong silently: TetGen copies numbers and its command line into buffers of fixed size,
/// ignores unknown switches, and some switches name files or outputs that do not exist here.
void check_switches(const std::string& switches) {
    constexpr std::string_view known = "pqaAYMDOoSTXCdVQJBlLbxcfen";
    constexpr std::string_view numeric = "0123456789./,+-e";
    constexpr std::size_t longest = 200;
    if (switches.size() > longest) throw std::invalid_argument("--switches: longer than 200 characters");
    if (switches.empty()) throw std::invalid_argument("--switches: expected TetGen's switches, found nothing");
    if (switches.front() == '-') throw std::invalid_argument("--switches: expected no dash before TetGen's switches");
    for (const char c : switches) {
        if (known.find(c) != std::string_view::npos || numeric.find(c) != std::string_view::npos) continue;
        throw std::invalid_argument(
            fmt::format("--switches: expected letters of {} with their numbers, found '{}'; switches for other "
                        "inputs and outputs than a PLC and a mesh are not supported",
                        known, c));
    }
}

}  // namespace

std::string Options::tetgen_switches() const {
    if (switches) return *switches + (switches->find('n') == std::string::npos ? "n" : "");
    std::string text = "pn";
    // In full digits: TetGen reads no exponent after -q.
    if (quality) text += fmt::format("q{:.10f}", ratio);
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
    if (!switches && quality) text += " --quality " + base::shortest(ratio);
    if (min_dihedral) text += " --min-dihedral " + base::shortest(*min_dihedral);
    if (max_volume) text += " --max-volume " + base::shortest(*max_volume);
    if (order != 1) text += fmt::format(" --order {}", order);
    if (keep_boundary) text += " --keep-boundary";
    if (index_base) text += fmt::format(" --index-base {}", *index_base);
    return text;
}

std::string default_output(const std::string& input) {
    std::filesystem::path stem = std::filesystem::path(input).replace_extension();
    const std::string last = stem.extension().string();
    int number = 0;
    if (last.size() > 1) {
        const auto [end, error] = std::from_chars(last.data() + 1, last.data() + last.size(), number);
        const bool counted = error == std::errc{} && end == last.data() + last.size() && number >= 0 &&
                             number < std::numeric_limits<int>::max();
        if (counted)
            stem.replace_extension();
        else
            number = 0;
    }
    return stem.string() + "." + std::to_string(number + 1);
}

Parsed parse_options(int argc, char** argv) {
    Options options;
    OptionTable table;
    CLI::App app{"Meshes a PLC by TetGen: .poly .smesh .off .stl .ply in; .node .ele .face .neigh out."};
    app.name("barycert-tetgen");
    add_options(app, table);
    try {
        try {
            app.parse(argc, argv);
        } catch (const CLI::RequiredError&) {
            // That there is no INPUT is told below, and whether --quality took it.
        }
        options.input = table.input;
        options.output = table.output;
        options.order = table.order == "2" ? 2 : 1;
        options.keep_boundary = table.keep_boundary;
        options.quiet = table.quiet;
        const auto given = [&](const char* name) { return app.get_option(name)->count() > 0; };
        // A number of [low, high], if the option is given; `range` says so in the error.
        const auto number = [&](const char* option, const std::string& text, double low, double high,
                                const char* range) -> std::optional<double> {
            if (!given(option)) return std::nullopt;
            const std::optional<double> value = base::parse_double(text);
            if (value && *value >= low && *value <= high) return value;
            throw std::invalid_argument(fmt::format("{}: expected {}, found {}", option, range, text));
        };
        if (table.input.empty() && base::parse_double(table.ratio).value_or(0) == 0 && !table.ratio.empty()) {
            throw std::invalid_argument("--quality: expected a number, found " + table.ratio + "; put INPUT first");
        }
        if (options.input.empty()) throw std::invalid_argument("expected INPUT, a PLC");
        constexpr double unbounded = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::min();
        // A regular tetrahedron has the smallest ratio there is, 0.61, and the largest dihedral angle, 70.5 degrees.
        options.quality = given("--quality") || given("--min-dihedral") || given("--max-volume");
        if (!table.ratio.empty())
            options.ratio = number("--quality", table.ratio, 1, 1e6, "a ratio of at least 1").value();
        options.min_dihedral = number("--min-dihedral", table.min_dihedral, 0, 70, "an angle from 0 to 70 degrees");
        options.max_volume = number("--max-volume", table.max_volume, tiny, unbounded, "a volume greater than 0");
        if (given("--output") && (table.output.empty() || table.output == "-"))
            throw std::invalid_argument("--output: expected the stem of files, found \"" + table.output + '"');
        options.timeout = number("--timeout", table.timeout, 1e-3, 1e9, "a time of 0.001 to 1e9 s").value_or(0);
        if (given("--index-base")) options.index_base = table.index_base == "1" ? 1 : 0;
        if (given("--switches")) {
            check_switches(table.switches);
            options.switches = table.switches;
        }
    } catch (const CLI::Success& wish) {  // --help, --version
        const int code = app.exit(wish);
        std::cout.flush();
        if (std::cout) return {.options = {}, .exit_code = code};
        fmt::print(stderr, "error: cannot write to stdout: found {}\n", std::strerror(errno));
        return {.options = {}, .exit_code = 2};
    } catch (const std::bad_alloc&) {
        throw;  // it is not about an option
    } catch (const std::exception& problem) {
        fmt::print(stderr, "error: {}\n",
                   base::printable(cli::usage_error(app, problem, "run barycert-tetgen --help for the usage")));
        return {.options = {}, .exit_code = 2};
    }
    if (options.output.empty()) options.output = default_output(options.input);
    options.output = tetgen_stem(options.output);
    return {.options = std::move(options), .exit_code = {}};
}

}  // namespace barycert

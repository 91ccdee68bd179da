#include "options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "barycert/base/text.hpp"

namespace barycert::cli {

void refuse_option(const std::string& option, const std::string& expected, std::string_view found) {
    throw CLI::ValidationError(option, fmt::format("expected {}, found \"{}\"", expected, found));
}

void threads_option(CLI::App& sub, int& threads) {
    sub.add_option("--threads", threads, "Number of threads; 0: all")
        ->capture_default_str()
        ->check(CLI::Range(0, 4096).description(""))
        ->type_name("N");
}

void vtk_data_option(CLI::App& sub, std::optional<VtkData>& data) {
    std::vector<std::pair<std::string, std::optional<VtkData>>> choices;
    choices.reserve(std::size(vtk_data_names));
    for (const std::string_view word : vtk_data_names) choices.emplace_back(word, vtk_data_named(word));
    choice_option(sub, "--vtk-data", data, choices,
                  "Numbers in an output of VTK's formats: raw (default), zlib, lz4, lzma (compressed), ascii (text)");
}

void curved_option(CLI::App& sub, Curved& curved) {
    choice_option<Curved>(sub, "--curved", curved, {{"straight", Curved::straight}, {"refuse", Curved::refuse}},
                          "Second-order cells with mid-edge nodes off the middle: straight: take their sides as "
                          "straight, and say so (default); refuse: fail");
}

std::optional<std::int64_t> count_of(std::string_view text) {
    std::int64_t n = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc{} || end != text.data() + text.size() || n < 1) return std::nullopt;
    return n;
}

std::optional<double> finite(std::string_view text) {
    const auto x = base::parse_double(text);
    return x && std::isfinite(*x) ? x : std::nullopt;
}

std::optional<double> positive(std::string_view text) {
    const auto x = finite(text);
    return x && *x > 0 ? x : std::nullopt;
}

namespace {

CLI::Validator finite_number(double least, bool itself) {
    return {[=](std::string& text) {
                const auto x = finite(text);
                if (x && (*x > least || (itself && *x == least))) return std::string();
                return fmt::format("expected a finite number {} {}, found \"{}\"", itself ? "of at least" : "above",
                                   base::shortest(least), text);
            },
            ""};
}

}  // namespace

CLI::Validator finite_at_least(double least) {
    return finite_number(least, true);
}

CLI::Validator finite_above(double least) {
    return finite_number(least, false);
}

}  // namespace barycert::cli

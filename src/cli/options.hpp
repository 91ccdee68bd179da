/// Kinds of options: numbers between separators. One of a few words: options/choice.hpp.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/table.hpp"
#include "options/choice.hpp"

namespace barycert::cli {

/// Throws what the parser of options tells.
[[noreturn]] void refuse_option(const std::string& option, const std::string& expected, std::string_view found);

/// The parts of the text between separators, each read by `read`, which returns nothing for what it does not take.
template <class Number, class Read>
std::vector<Number> numbers_of(const std::string& option, std::string_view text, char separator, Read read,
                               const char* expected) {
    std::vector<Number> all;
    for (std::string_view rest = text;;) {
        const std::size_t end = rest.find(separator);
        const std::optional<Number> x = read(rest.substr(0, end));
        if (!x) refuse_option(option, expected, text);
        all.push_back(*x);
        if (end == std::string_view::npos) return all;
        rest.remove_prefix(end + 1);
    }
}

/// --threads
void threads_option(CLI::App& sub, int& threads);

/// --vtk-data, how the numbers of VTK's files are written.
void vtk_data_option(CLI::App& sub, std::optional<VtkData>& data);

/// --curved, what becomes of curved cells.
void curved_option(CLI::App& sub, Curved& curved);

/// An integer of at least 1.
std::optional<std::int64_t> count_of(std::string_view text);

std::optional<double> finite(std::string_view text);
std::optional<double> positive(std::string_view text);

/// Takes finite numbers of at least `least`, or above it.
CLI::Validator finite_at_least(double least);
CLI::Validator finite_above(double least);

}  // namespace barycert::cli

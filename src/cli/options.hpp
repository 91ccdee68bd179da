/// Kinds of options: one of a few words, numbers between separators.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/vtk_data.hpp"

namespace barycert::cli {

/// An option of a few words, each of which stands for a value.
template <class Value>
void choice_option(CLI::App& sub, const std::string& name, Value& value, const std::map<std::string, Value>& words,
                   const std::string& type, const std::string& help) {
    const auto set = [&value, words](const std::string& word) { value = words.at(word); };
    sub.add_option_function<std::string>(name, set, help)->check(CLI::IsMember(words).description(""))->type_name(type);
}

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

/// --vtk-data, how the numbers of VTK's files are written.
void vtk_data_option(CLI::App& sub, std::optional<VtkData>& data);

/// An integer of at least 1.
std::optional<std::int64_t> count_of(std::string_view text);

std::optional<double> finite(std::string_view text);
std::optional<double> positive(std::string_view text);

}  // namespace barycert::cli

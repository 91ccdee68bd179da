/// Around the parser of options: options of a few words, and what is told of those that do not exist.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <span>
#include <string>
#include <vector>

namespace barycert::cli {

/// Takes these words alone; of any other it tells them, and the nearest.
CLI::Validator one_of(const std::vector<std::string>& words);

/// "a|b|c", the type of an option that takes these words: command_table() reads them there again.
inline std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, "|"));
}

/// Returns the parser's message with a remedy: `did you mean "--output"? ` before the rest, for the first word that
/// looks like an option and is none of the command it was given to; the rest alone if there is no such word, or no
/// option near. Tells options that were given twice; `words` show which of them have two values.
std::string usage_error(const CLI::App& app, const std::exception& error, const std::string& rest,
                        std::span<const char* const> words = {});

std::vector<std::string> command_names(const CLI::App& app);

}  // namespace barycert::cli

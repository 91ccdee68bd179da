/// Options that do not exist, and those that were meant.
#pragma once

#include <exception>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

/// What the parser's message says, with a remedy: `did you mean "--output"? ` before the rest for the first word that
/// looks like an option and is none of the command it was given to; the rest alone if there is no such word, or no
/// option near. An option that is given twice is told, and with the words of the command line one that has two values.
/// A message that says what is expected of a value stands alone.
std::string usage_error(const CLI::App& app, const std::exception& error, const std::string& rest,
                        std::span<const char* const> words = {});

/// The names of the commands below one.
std::vector<std::string> command_names(const CLI::App& app);

}  // namespace barycert::cli

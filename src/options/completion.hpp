/// Completions for shells: commands, options, and their values where these are a few words or files.
#pragma once

#include <string>
#include <string_view>

#include "options/command_table.hpp"

namespace barycert::cli {

/// Each is a script for its shell, of one program.
std::string bash_completion(const CommandEntry& program);
std::string zsh_completion(const CommandEntry& program);
std::string fish_completion(const CommandEntry& program);

/// `text` in single quotes of bash and zsh.
std::string in_quotes(std::string_view text);

/// A name of a function made of the path of a command: "_barycert_render_iso".
std::string function_name(std::string_view path);

/// The beginning of a help text, as a list of completions shows it: up to the first ";", "(", ". " or ": ", in a line.
std::string summary(std::string_view text);

}  // namespace barycert::cli

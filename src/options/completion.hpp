/// Completions for shells: commands, options, and their values where these are a few words or files.
#pragma once

#include <string>

#include "options/command_table.hpp"

namespace barycert::cli {

/// Each is a script for its shell, of one program.
std::string bash_completion(const CommandEntry& program);
std::string zsh_completion(const CommandEntry& program);
std::string fish_completion(const CommandEntry& program);

}  // namespace barycert::cli

/// The options that the program's own --help lists: the judge of manual pages and completions.
#pragma once

#include <vector>

#include "process.hpp"

namespace barycert::cli_test {

struct ListedCommand {
    Words words;    ///< {"render", "iso"}; empty: the program
    Words options;  ///< "--help", "--output", ...
};

/// The program and all below it.
std::vector<ListedCommand> listed_commands();

/// Whether the shell finds that program.
bool is_there(const std::string& program);

}  // namespace barycert::cli_test

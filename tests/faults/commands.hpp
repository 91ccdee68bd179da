/// One command a subcommand, and what it needs, for all that can fail under it.
#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "tests/app/cli/process.hpp"

namespace barycert::faults {

using cli_test::Words;

struct Command {
    std::string name;  ///< of the test
    Words arguments;   ///< run in a folder of its own, which holds the inputs
    int code = 0;      ///< exit code where nothing fails
    std::string program = BARYCERT_PROGRAM;
    bool forks = false;  ///< its work is done in a process that it forks

    /// Shows the command in tests.
    friend void PrintTo(const Command& c, std::ostream* out) { *out << c.name; }
};

/// Makes the inputs that the commands read: "p.csv", "map", "results.csv", "w.json", ...
void put_inputs(const test::Scratch& folder);

const std::vector<Command>& commands();

using Files = std::map<std::string, std::string>;

/// All files in a folder, by name.
Files files_of(const test::Scratch& folder);

/// A page without the ticks on the axes of its charts: an axis of times has more or fewer of them from run to run.
std::string without_ticks(std::string html);

/// `text` with each number replaced by "#" and blanks by one: runs differ in times and in the width of their columns.
std::string without_numbers(const std::string& text);

}  // namespace barycert::faults

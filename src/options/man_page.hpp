/// Manual pages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "options/command_table.hpp"

namespace barycert::cli {

struct ManPage {
    std::string file;  ///< "barycert-render-iso.1"
    std::string text;  ///< roff, with the macros of man(7)
};

/// A variable of the environment.
struct Variable {
    std::string name, text;
};

/// A page for the program and one for each command below it. `version`: "barycert 0.1.0". `environment`: what the
/// page of the program says of each variable. `date`: as YYYY-MM-DD, or empty.
std::vector<ManPage> man_pages(const CommandEntry& program, std::string_view version,
                               const std::vector<Variable>& environment, std::string_view date);

}  // namespace barycert::cli

/// The report on a mesh as text for a terminal or a log.
#pragma once

#include <string>

#include "barycert/check/check.hpp"
#include "barycert/report/terminal.hpp"

namespace barycert::report {

/// The verdict in one line; below it what was checked, what was found and what to do about it, pairs of cells that meet
/// where they must not, measures, notes. At most 100 columns, names of files aside. `mesh` is what the report is of,
/// `name` what the user calls it.
std::string terminal_check(const check::Report& report, const Mesh& mesh, const std::string& name,
                           const TerminalStyle& style);

}  // namespace barycert::report

/// The parts of the audit's text for a terminal.
#pragma once

#include <string>
#include <string_view>

#include "barycert/audit.hpp"
#include "barycert/report.hpp"

namespace barycert::report {

/// All columns, the families, a witness for each kernel: wider than most terminals.
std::string wide_text(const AuditReport& report, const TerminalStyle& style);

/// The report on the only kernel, family by family.
std::string kernel_text(const AuditReport& report, const TerminalStyle& style);

/// Text in lines of at most `width` columns, broken at the blanks that end `between`: ", " keeps names of files, which
/// may hold blanks, in one piece. What is longer stays whole.
std::string wrapped(const std::string& text, std::size_t width, std::string_view between = " ");

}  // namespace barycert::report

/// The parts of the audit's text for a terminal.
#pragma once

#include <string>

#include "barycert/audit.hpp"
#include "barycert/report.hpp"

namespace barycert::report {

/// All columns, the families, a witness for each kernel: wider than most terminals.
std::string wide_text(const AuditReport& report, const TerminalStyle& style);

/// The report on the only kernel, family by family.
std::string kernel_text(const AuditReport& report, const TerminalStyle& style);

/// Text in lines of at most `width` columns, broken at blanks; words that are longer stay whole.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace barycert::report

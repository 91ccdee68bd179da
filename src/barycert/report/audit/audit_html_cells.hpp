/// Cells of tables on the audit's HTML page: what is shown, and what the script sorts by.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "barycert/base/text.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/common/html_text.hpp"

namespace barycert::report {

inline std::string number_cell(const std::string& shown, double number, bool bad = false) {
    return fmt::format("<td class=\"n{}\" data-v=\"{}\">{}</td>", bad ? " bad" : "",
                       std::isinf(number) ? "Infinity" : base::shortest(number), html_escaped(shown));
}

/// In per cent; `red` where it is not none.
inline std::string share_cell(const Share& share, bool red) {
    const double x = share.whole == 0 ? -1 : static_cast<double>(share.part) / static_cast<double>(share.whole);
    return number_cell(percent(share), x, red && share.part != 0);
}

inline std::string count_cell(std::uint64_t n) {
    return number_cell(std::to_string(n), static_cast<double>(n));
}

}  // namespace barycert::report

/// Internal: the conditions of a certificate in words, and how often each is violated; for all reports on a mesh.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "barycert/check.hpp"

namespace barycert::report {

struct ConditionRow {
    std::string_view name;          ///< "P1" ...; empty for what follows from P1 to P4
    std::string_view text;          ///< what holds if it does
    std::uint64_t count = 0;        ///< violations
    bool at_least = false;          ///< there may be more
    std::string_view instead = {};  ///< without violations: "ok", "none came" or "not checked"
};

std::vector<ConditionRow> condition_rows(const CheckReport& report, const Mesh& mesh);

/// Some cells took no part in P2 to P5, for they have no place in space.
bool left_cells_out(const CheckReport& report);

}  // namespace barycert::report

/// Fields with values that are not finite, as text and JSON.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/check.hpp"

namespace barycert::report {

/// "field T: 3 of 50 values are not finite".
inline std::string not_finite_text(const NotFinite& f) {
    return fmt::format("field {}{}: {} of {} values {} not finite", base::printable(f.field),
                       f.of_cells ? " of cells" : "", f.count, f.values, f.count == 1 ? "is" : "are");
}

inline nlohmann::ordered_json not_finite_json(const std::vector<NotFinite>& fields) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const NotFinite& f : fields) {
        nlohmann::ordered_json j;
        j["field"] = f.field;
        j["of"] = f.of_cells ? "cells" : "nodes";
        j["count"] = f.count;
        j["values"] = f.values;
        list.push_back(std::move(j));
    }
    return list;
}

}  // namespace barycert::report

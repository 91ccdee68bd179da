/// JSON as the text of a file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace barycert::base {

/// Ends with a line break. Names of fields and files may hold any bytes, and JSON is UTF-8: what is none is replaced.
inline std::string json_text(const nlohmann::ordered_json& j, int indent) {
    return j.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace barycert::base

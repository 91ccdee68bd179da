/// Members of JSON from files: each is there and of its type, or an Exception says where it is not, and what there is
/// instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "barycert/result.hpp"

namespace barycert::audit {

/// What is there, as messages show it.
inline std::string found_json(const nlohmann::json& j) {
    constexpr std::size_t longest = 40;
    // A whole file may hang on it: no more is printed than is shown.
    if (j.is_structured()) return j.is_array() ? "an array" : "an object";
    return j.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace).substr(0, longest);
}

inline const nlohmann::json& member(const nlohmann::json& object, const std::string& key, const std::string& where) {
    if (!object.is_object() || !object.contains(key))
        throw Exception({.what = where,
                         .expected = "a member \"" + key + '"',
                         .found = object.is_object() ? "none" : found_json(object)});
    return object.at(key);
}

inline std::uint64_t count_in(const nlohmann::json& object, const std::string& key, const std::string& where) {
    const nlohmann::json& j = member(object, key, where);
    if (!j.is_number_unsigned())
        throw Exception({.what = where + ", " + key, .expected = "a count", .found = found_json(j)});
    return j.get<std::uint64_t>();
}

inline std::string text_in(const nlohmann::json& object, const std::string& key, const std::string& where) {
    const nlohmann::json& j = member(object, key, where);
    if (!j.is_string()) throw Exception({.what = where + ", " + key, .expected = "a string", .found = found_json(j)});
    return j.get<std::string>();
}

inline const nlohmann::json& list_in(const nlohmann::json& object, const std::string& key, const std::string& where) {
    const nlohmann::json& j = member(object, key, where);
    if (!j.is_array()) throw Exception({.what = where + ", " + key, .expected = "an array", .found = found_json(j)});
    return j;
}

}  // namespace barycert::audit

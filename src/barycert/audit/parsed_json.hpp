/// JSON from a file of ours.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace barycert::audit {

/// The text as JSON; discarded if it is none, or is nested deeper than any file of ours. The parser itself needs no
/// recursion, but copying and writing what it made do, and an ordered object copies its members when it grows.
template <class Json>
Json parsed_json(const std::string& text) {
    constexpr int deepest = 64;
    bool too_deep = false;
    const typename Json::parser_callback_t watch = [&](int depth, typename Json::parse_event_t, Json&) {
        too_deep = too_deep || depth > deepest;
        return !too_deep;
    };
    Json json = Json::parse(text, watch, false);
    return too_deep ? Json(Json::value_t::discarded) : json;
}

}  // namespace barycert::audit

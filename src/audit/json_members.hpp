/// JSON from files of ours. Members are there and of their type, or an Exception says where one is not, and what there
/// is instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "barycert/result.hpp"
#include "barycert/witness.hpp"
#include "files/input_file.hpp"

namespace barycert::audit {

/// The value that was found, as messages show it.
inline std::string found_json(const nlohmann::json& j) {
    constexpr std::size_t longest = 40;
    // A whole file may hang on it: no more is printed than is shown.
    if (j.is_structured()) return j.is_array() ? "an array" : "an object";
    return j.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace).substr(0, longest);
}

[[noreturn]] inline void refuse(const std::string& where, const std::string& expected, const std::string& found) {
    throw Exception({.code = "witness.member", .what = where, .expected = expected, .found = found});
}

inline const nlohmann::json& member(const nlohmann::json& object, const std::string& key, const std::string& where) {
    if (!object.is_object() || !object.contains(key))
        refuse(where, "a member \"" + key + '"', object.is_object() ? "none" : found_json(object));
    return object.at(key);
}

/// The same of a type.
inline const nlohmann::json& member(const nlohmann::json& object, const std::string& key, const std::string& where,
                                    bool (nlohmann::json::*is_type)() const noexcept, const char* expected) {
    const nlohmann::json& j = member(object, key, where);
    if (!(j.*is_type)()) refuse(where + ", " + key, expected, found_json(j));
    return j;
}

inline std::uint64_t count_in(const nlohmann::json& object, const std::string& key, const std::string& where) {
    return member(object, key, where, &nlohmann::json::is_number_unsigned, "a count").get<std::uint64_t>();
}

inline std::string text_in(const nlohmann::json& object, const std::string& key, const std::string& where) {
    return member(object, key, where, &nlohmann::json::is_string, "a string").get<std::string>();
}

inline const nlohmann::json& list_in(const nlohmann::json& object, const std::string& key, const std::string& where) {
    return member(object, key, where, &nlohmann::json::is_array, "an array");
}

/// null where nothing could be measured.
inline std::optional<double> figure_in(const nlohmann::json& object, const std::string& key, const std::string& where) {
    const nlohmann::json& j = member(object, key, where);
    if (j.is_null()) return std::nullopt;
    if (!j.is_number() || !(j.get<double>() >= 0)) refuse(where + ", " + key, "a number >= 0 or null", found_json(j));
    return j.get<double>();
}

/// A kind of file, in the words of errors.
struct JsonFile {
    const char *cannot_read, *is_none, *name, *remedy;
    const char *how_made = "", *remedy_of_members = "";
};

/// Returns make(the file's JSON). Error: the file cannot be read, is no JSON or nested deeper than any file of ours,
/// has another schema, or `make` throws an Exception.
template <class Make>
auto made_of_json(const std::string& path, const JsonFile& file, Make make)
    -> Result<decltype(make(nlohmann::json()))> {
    using nlohmann::json;
    const Result<std::string> text = base::read_file(path, base::longest_pipe, base::Text::json);
    if (!text) {
        Error error = text.error();
        error.what = file.cannot_read;
        error.remedy += file.how_made;
        return error;
    }
    // The parser itself needs no recursion, but copying and writing what it made do.
    constexpr int deepest = 64;
    bool too_deep = false;
    const json::parser_callback_t watch = [&](int depth, json::parse_event_t, json&) {
        too_deep = too_deep || depth > deepest;
        return !too_deep;
    };
    const json all = json::parse(*text, watch, false);
    if (too_deep || all.is_discarded())
        return file_error("file.syntax", path, file.is_none, "JSON", "something else", file.remedy);
    try {
        if (const json& schema = member(all, "schema", file.name); schema != witness_schema)
            refuse("unknown schema", std::to_string(witness_schema), found_json(schema));
        return make(all);
    } catch (const Exception& e) {
        Error error = e.error();
        error.file = path;
        error.remedy = file.remedy_of_members;
        return error;
    }
}

/// One witness, as witness files and reports have it (witness_file.cpp).
nlohmann::ordered_json witness_json(const Witness& witness);

}  // namespace barycert::audit

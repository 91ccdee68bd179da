#include "barycert/raster/scene_json.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "barycert/base/text.hpp"

namespace barycert::raster {
namespace {

constexpr const char* remedy = "doc/rendering.md describes scene files";

/// What stands there, in a few words.
std::string brief(const nlohmann::json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

/// As a part of a JSON pointer.
std::string escaped(const std::string& name) {
    std::string out;
    for (const char c : name) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
}

}  // namespace

void SceneValue::fail(const std::string& expected) const {
    throw Exception({.what = place_.empty() ? "the scene" : place_,
                     .file = path_,
                     .expected = expected,
                     .found = brief(value_),
                     .remedy = remedy});
}

void SceneValue::fail(const Error& error) const {
    Error told = error;
    if (told.file.empty()) {
        told.file = path_;
        told.what = place_ + ": " + told.what;
    }
    throw Exception(told);
}

void SceneValue::allow_only(std::initializer_list<const char*> names) const {
    if (!value_.is_object()) fail("an object");
    for (const auto& [name, value] : value_.items()) {
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        std::string all;
        for (const char* known : names) all += (all.empty() ? "" : ", ") + std::string(known);
        throw Exception({.what = place_ + '/' + escaped(name),
                         .file = path_,
                         .expected = "one of the members " + all,
                         .found = base::quoted(name),
                         .remedy = remedy});
    }
}

SceneValue SceneValue::member(const char* name) const {
    if (!has(name)) {
        throw Exception({.what = place_.empty() ? "the scene" : place_,
                         .file = path_,
                         .expected = std::string("a member \"") + name + '"',
                         .found = "none",
                         .remedy = remedy});
    }
    return {value_.at(name), place_ + '/' + name, path_};
}

SceneValue SceneValue::entry(std::size_t i) const {
    return {value_.at(i), place_ + '/' + std::to_string(i), path_};
}

std::size_t SceneValue::size() const {
    if (!value_.is_array()) fail("an array");
    return value_.size();
}

double SceneValue::number() const {
    const std::optional<double> x = value_.is_string()   ? base::parse_double(value_.get<std::string>())
                                    : value_.is_number() ? std::optional<double>(value_.get<double>())
                                                         : std::nullopt;
    if (!x || !std::isfinite(*x)) fail("a finite number");
    return *x;
}

std::int64_t SceneValue::integer(std::int64_t low, std::int64_t high) const {
    const bool unsigned_number = value_.is_number_unsigned();
    if (unsigned_number || value_.is_number_integer()) {
        const bool fits = !unsigned_number || value_.get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX);
        if (fits && value_.get<std::int64_t>() >= low && value_.get<std::int64_t>() <= high)
            return value_.get<std::int64_t>();
    }
    fail("an integer from " + std::to_string(low) + " to " + std::to_string(high));
}

std::string SceneValue::text() const {
    if (!value_.is_string()) fail("text");
    return value_.get<std::string>();
}

std::vector<double> SceneValue::numbers(std::size_t count) const {
    if (!value_.is_array() || value_.size() != count) fail("an array of " + std::to_string(count) + " numbers");
    std::vector<double> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(entry(i).number());
    return all;
}

}  // namespace barycert::raster

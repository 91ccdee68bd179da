/// The members of a scene file, each read with its place: a JSON pointer such as /camera/eye/1 (RFC 6901).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/result.hpp"

namespace barycert::raster {

/// What stands there, in a few words.
inline std::string brief(const nlohmann::json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

/// As a part of a JSON pointer.
inline std::string escaped(const std::string& name) {
    std::string out;
    for (const char c : name) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
}

/// A value of the file and where it stands. Functions that find something else than they ask for throw Exception.
class SceneValue {
public:
    using Json = nlohmann::json;

    SceneValue(const Json& value, std::string place, const std::string& path)
        : value_(value), place_(std::move(place)), path_(path) {}

    /// Every member is one of these.
    void allow_only(std::initializer_list<const char*> names) const {
        if (!value_.is_object()) fail("an object");
        for (const auto& [name, value] : value_.items()) {
            if (std::find(names.begin(), names.end(), name) != names.end()) continue;
            std::string all;
            for (const char* known : names) all += (all.empty() ? "" : ", ") + std::string(known);
            refuse(place_ + '/' + escaped(name), "one of the members " + all, base::quoted(name));
        }
    }

    bool has(const char* name) const { return value_.contains(name); }
    SceneValue member(const char* name) const {
        if (!has(name)) refuse(place(), std::string("a member \"") + name + '"', "none");
        return {value_.at(name), place_ + '/' + name, path_};
    }
    SceneValue entry(std::size_t i) const { return {value_.at(i), place_ + '/' + std::to_string(i), path_}; }

    /// Of an array: the number of entries.
    std::size_t size() const {
        if (!value_.is_array()) fail("an array");
        return value_.size();
    }
    bool is_array() const { return value_.is_array(); }

    /// A finite number; also as text, in decimal or hexadecimal.
    double number() const {
        const std::optional<double> x = value_.is_string()   ? base::parse_double(value_.get<std::string>())
                                        : value_.is_number() ? std::optional<double>(value_.get<double>())
                                                             : std::nullopt;
        if (!x || !std::isfinite(*x)) fail("a finite number");
        return *x;
    }
    std::int64_t integer(std::int64_t low, std::int64_t high) const {
        const bool unsigned_number = value_.is_number_unsigned();
        if (unsigned_number || value_.is_number_integer()) {
            const bool fits = !unsigned_number || value_.get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX);
            if (fits && value_.get<std::int64_t>() >= low && value_.get<std::int64_t>() <= high)
                return value_.get<std::int64_t>();
        }
        fail("an integer from " + std::to_string(low) + " to " + std::to_string(high));
    }
    std::string text() const {
        if (!value_.is_string()) fail("text");
        return value_.get<std::string>();
    }

    /// An array of `count` numbers.
    std::vector<double> numbers(std::size_t count) const {
        if (!value_.is_array() || value_.size() != count) fail("an array of " + std::to_string(count) + " numbers");
        std::vector<double> all;
        for (std::size_t i = 0; i < count; ++i) all.push_back(entry(i).number());
        return all;
    }

    /// One of a few words.
    template <class T>
    T choice(const std::map<std::string, T>& words) const {
        if (value_.is_string()) {
            const auto word = words.find(value_.get<std::string>());
            if (word != words.end()) return word->second;
        }
        std::string all;
        for (const auto& [word, meaning] : words) all += (all.empty() ? "\"" : ", \"") + word + '"';
        fail("one of " + all);
    }

    /// The same of a member, into `to`, if there is that member.
    template <class T>
    void choose(const char* name, const std::map<std::string, T>& words, T& to) const {
        if (has(name)) to = member(name).choice(words);
    }

    [[noreturn]] void fail(const std::string& expected) const { refuse(place(), expected, brief(value_)); }

    /// An Error of what was made of this value.
    [[noreturn]] void fail(const Error& error) const {
        Error told = error;
        if (told.file.empty()) {
            told.file = path_;
            told.what = place_ + ": " + told.what;
        }
        throw Exception(told);
    }

private:
    std::string place() const { return place_.empty() ? "the scene" : place_; }

    [[noreturn]] void refuse(std::string what, std::string expected, std::string found) const {
        throw Exception({std::move(what), path_, 0, std::move(expected), std::move(found),
                         "doc/rendering.md describes scene files"});
    }

    const Json& value_;
    std::string place_;
    const std::string& path_;
};

}  // namespace barycert::raster

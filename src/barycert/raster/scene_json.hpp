/// The members of a scene file, each read with its place: a JSON pointer such as /camera/eye/1 (RFC 6901).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::raster {

/// A value of the file and where it stands. Functions that find something else than they ask for throw Exception.
class SceneValue {
public:
    using Json = nlohmann::json;

    SceneValue(const Json& value, std::string place, const std::string& path)
        : value_(value), place_(std::move(place)), path_(path) {}

    /// Every member is one of these.
    void allow_only(std::initializer_list<const char*> names) const;

    bool has(const char* name) const { return value_.contains(name); }
    SceneValue member(const char* name) const;
    SceneValue entry(std::size_t i) const;

    /// Of an array: the number of entries.
    std::size_t size() const;
    bool is_array() const { return value_.is_array(); }

    /// A finite number; also as text, in decimal or hexadecimal.
    double number() const;
    std::int64_t integer(std::int64_t low, std::int64_t high) const;
    std::string text() const;

    /// An array of `count` numbers.
    std::vector<double> numbers(std::size_t count) const;

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

    [[noreturn]] void fail(const std::string& expected) const;

    /// An Error of what was made of this value.
    [[noreturn]] void fail(const Error& error) const;

private:
    const Json& value_;
    std::string place_;
    const std::string& path_;
};

}  // namespace barycert::raster

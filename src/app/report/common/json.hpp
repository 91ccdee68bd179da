/// Records of keys and values for programs, in the order of a report. JSON knows neither NaN nor infinity.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>

#include "barycert/certificate.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/result.hpp"

namespace barycert::report {

using Json = nlohmann::ordered_json;

/// null where there is no figure. null would hide an infinity: the largest double stands for it.
inline Json figure(double x) {
    constexpr double max = std::numeric_limits<double>::max();
    if (std::isnan(x)) return nullptr;
    return std::clamp(x, -max, max);
}

/// The same for figures that are never below 0: a negative number says that there is none.
inline Json magnitude(double x) {
    return x >= 0 ? figure(x) : nullptr;
}

inline void put(Json& /*record*/) {}

template <class Value, class... Rest>
void put(Json& record, std::string_view key, const Value& value, const Rest&... rest);

/// Adds what `members` adds: see MEMBERS.
template <std::invocable<Json&> Members, class... Rest>
void put(Json& record, const Members& members, const Rest&... rest) {
    members(record);
    put(record, rest...);
}

/// Adds keys and their values in turn: doubles as figure() has them, enumerators by name, null for an empty optional.
template <class Value, class... Rest>
void put(Json& record, std::string_view key, const Value& value, const Rest&... rest) {
    Json& member = record[std::string(key)];
    if constexpr (std::is_same_v<Value, double>)
        member = figure(value);
    else if constexpr (std::is_enum_v<Value>)
        member = name(value);
    else if constexpr (requires { value.has_value(); })
        member = value.has_value() ? Json(*value) : Json(nullptr);
    else
        member = value;
    put(record, rest...);
}

/// {"a": 1, "b": 2} is record("a", 1, "b", 2).
template <class... KeysAndValues>
Json record(const KeysAndValues&... all) {
    Json j;
    put(j, all...);
    return j;
}

Json list(const auto& items, auto convert) {
    Json j = Json::array();
    for (const auto& item : items) j.push_back(convert(item));
    return j;
}

/// An argument of put() and record(): members of `object` under their own names, which nothing but a macro knows.
#define MEMBERS(object, ...)                                               \
    [&](barycert::report::Json& record_of_members) {                       \
        const auto& with_members = object;                                 \
        NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(PUT_MEMBER, __VA_ARGS__)) \
    }
#define PUT_MEMBER(member) barycert::report::put(record_of_members, #member, with_members.member);

/// How a type of namespace barycert is written, alone and in lists.
#define JSON_OF(Type, ...)                                      \
    inline void to_json(report::Json& record, const Type& of) { \
        report::put(record, MEMBERS(of, __VA_ARGS__));          \
    }

}  // namespace barycert::report

namespace barycert {

JSON_OF(Environment, version, rounding, flush_to_zero, contraction, excess_precision, simd, fma, compiler,
        hardware_threads)
JSON_OF(Note, kind, text, file)

inline void to_json(report::Json& record, const CurvedCells& c) {
    report::put(record, MEMBERS(c, cells, max_deviation, rounded_cells, max_rounded, mapped));
    if (c.by_corners != 0) report::put(record, MEMBERS(c, by_corners));
}

inline void to_json(report::Json& record, const NotFinite& f) {
    report::put(record, MEMBERS(f, field), "of", f.of_cells ? "cells" : "nodes", MEMBERS(f, count, values));
}

}  // namespace barycert

/// What programs read: records of keys and values, in the order of a report. JSON knows neither NaN nor infinity.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>

#include "barycert/check.hpp"
#include "barycert/environment.hpp"
#include "barycert/result.hpp"

namespace barycert::report {

using Json = nlohmann::ordered_json;

/// null where there is no figure. null would hide an infinity: the largest double stands for it.
inline Json figure(double x) {
    constexpr double max = std::numeric_limits<double>::max();
    if (std::isnan(x)) return nullptr;
    return std::clamp(x, -max, max);
}

/// Of figures that are never below 0: a negative number says that there is none.
inline Json magnitude(double x) {
    return x >= 0 ? figure(x) : nullptr;
}

inline void put(Json& /*record*/) {}

/// Adds keys and their values to a record, in turn: doubles as figure() has them, null for an optional without one.
template <class Value, class... Rest>
void put(Json& record, std::string_view key, const Value& value, const Rest&... rest) {
    if constexpr (std::is_same_v<Value, double>) {
        record[std::string(key)] = figure(value);
    } else if constexpr (requires { value.has_value(); }) {
        record[std::string(key)] = value.has_value() ? Json(*value) : Json(nullptr);
    } else {
        record[std::string(key)] = value;
    }
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

inline Json environment_json(const Environment& e) {
    return record("version", e.version, "rounding", e.rounding, "flush_to_zero", e.flush_to_zero, "contraction",
                  e.contraction, "excess_precision", e.excess_precision, "simd", e.simd, "fma", e.fma, "compiler",
                  e.compiler, "hardware_threads", e.hardware_threads);
}

/// What was left out, converted or guessed.
inline Json notes_json(const Notes& notes) {
    return list(notes, [](const Note& n) { return record("kind", name(n.kind), "text", n.text, "file", n.file); });
}

/// Cells that were taken with straight sides.
inline Json curved_json(const CurvedCells& c) {
    return record("cells", c.cells, "max_deviation", c.max_deviation, "rounded_cells", c.rounded_cells, "max_rounded",
                  c.max_rounded);
}

/// Fields with values that are not finite.
inline Json not_finite_json(const std::vector<NotFinite>& fields) {
    return list(fields, [](const NotFinite& f) {
        return record("field", f.field, "of", f.of_cells ? "cells" : "nodes", "count", f.count, "values", f.values);
    });
}

}  // namespace barycert::report

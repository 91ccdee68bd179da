/// Who decided what is right: one line, and its JSON.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "barycert/audit.hpp"

namespace barycert::report {

/// "decided: 900 by barycert's core, ...; confirmed: 60 by integers, ..., 0 disagreements".
inline std::string oracle_line(const OracleCounts& o) {
    std::string decided, confirmed;
    const auto add = [](std::string& to, std::uint64_t count, const std::string& text) {
        if (count != 0) to += (to.empty() ? "" : ", ") + text;
    };
    add(decided, o.core, fmt::format("{} by barycert's core", o.core));
    add(decided, o.integers, fmt::format("{} by integers ({} of them wide)", o.integers, o.wide));
    add(decided, o.cgal, fmt::format("{} by CGAL", o.cgal));
    add(confirmed, o.also_integers, fmt::format("{} by integers", o.also_integers));
    add(confirmed, o.also_cgal, fmt::format("{} by CGAL", o.also_cgal));
    return "decided: " + decided + (confirmed.empty() ? "" : "; confirmed: " + confirmed + ", 0 disagreements");
}

inline nlohmann::ordered_json oracles_json(OracleChoice choice, const OracleCounts& o) {
    nlohmann::ordered_json j;
    j["choice"] = name(choice);
    j["core"] = o.core;
    j["integers"] = o.integers;
    j["wide"] = o.wide;
    j["cgal"] = o.cgal;
    j["also_integers"] = o.also_integers;
    j["also_cgal"] = o.also_cgal;
    j["disagreements"] = 0;  // with one there is no report
    return j;
}

}  // namespace barycert::report

/// What was left out, converted or guessed, and taken as straight, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "barycert/check.hpp"
#include "barycert/report/common/json_figure.hpp"
#include "barycert/result.hpp"

namespace barycert::report {

inline nlohmann::ordered_json notes_json(const Notes& notes) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Note& note : notes) {
        nlohmann::ordered_json j;
        j["kind"] = name(note.kind);
        j["text"] = note.text;
        j["file"] = note.file;
        list.push_back(std::move(j));
    }
    return list;
}

inline nlohmann::ordered_json curved_json(const CurvedCells& curved) {
    nlohmann::ordered_json j;
    j["cells"] = curved.cells;
    j["max_deviation"] = figure(curved.max_deviation);
    j["rounded_cells"] = curved.rounded_cells;
    j["max_rounded"] = figure(curved.max_rounded);
    return j;
}

}  // namespace barycert::report

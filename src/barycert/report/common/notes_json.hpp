/// What was left out, converted or guessed, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "barycert/notes.hpp"

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

}  // namespace barycert::report

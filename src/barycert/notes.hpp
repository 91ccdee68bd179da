/// What was left out, converted or guessed on the way from files to files: nothing of that happens in silence.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace barycert {

struct Note {
    enum class Kind : std::uint8_t {
        left_out,   ///< it is not in the result
        converted,  ///< it is in the result in another type, order or unit
        guessed,    ///< the file does not say; this was taken from its contents
    };
    Kind kind = Kind::left_out;
    std::string text;        ///< what and why, in one clause: "2564 cells that are no tetrahedra: 2564 triangles"
    std::string file = {};   ///< where; empty: in memory
    bool important = false;  ///< it may change what results mean: a program tells it even if nobody asks

    friend bool operator==(const Note&, const Note&) = default;
};
using Notes = std::vector<Note>;

constexpr std::string_view name(Note::Kind kind) {
    return kind == Note::Kind::left_out ? "left out" : kind == Note::Kind::converted ? "converted" : "guessed";
}

/// `file: kind: text`, in one line: safe to show, see printable() in base/text.hpp.
std::string message(const Note& note);

}  // namespace barycert

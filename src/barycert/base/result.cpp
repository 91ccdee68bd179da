#include "barycert/result.hpp"

#include "barycert/base/text.hpp"

namespace barycert {

std::string Error::message() const {
    std::string text;
    if (!file.empty()) text += file + (line != 0 ? ":" + std::to_string(line) : "") + ": ";
    text += what;
    if (!expected.empty()) text += ": expected " + expected;
    if (!found.empty()) text += (expected.empty() ? ": found " : ", found ") + found;
    if (!remedy.empty()) text += "; " + remedy;
    return base::printable(text);
}

std::string message(const Note& note) {
    const std::string file = note.file.empty() ? "" : note.file + ": ";
    return base::printable(file + std::string(name(note.kind)) + ": " + note.text);
}

}  // namespace barycert

#include "barycert/result.hpp"

#include "barycert/base/text.hpp"

namespace barycert {

std::string message(const Note& note) {
    const std::string file = note.file.empty() ? "" : note.file + ": ";
    return base::printable(file + std::string(name(note.kind)) + ": " + note.text);
}

}  // namespace barycert

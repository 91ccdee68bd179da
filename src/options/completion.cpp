#include "options/completion.hpp"

#include <algorithm>
#include <array>

namespace barycert::cli {

std::string in_quotes(std::string_view text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + '\'';
}

std::string function_name(std::string_view path) {
    std::string name = "_";
    for (const char c : path) name += c == ' ' || c == '-' ? '_' : c;
    return name;
}

std::string summary(std::string_view text) {
    std::size_t end = text.size();
    for (const std::string_view stop : {"; ", " (", ". ", ": "}) end = std::min(end, text.find(stop));
    std::string out(text.substr(0, end));
    std::replace(out.begin(), out.end(), '\n', ' ');
    return out;
}

}  // namespace barycert::cli

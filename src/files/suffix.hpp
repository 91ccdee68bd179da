/// How the names of files end, and whether there are such files.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace barycert::base {

/// Whether there is something of that name, as far as one may see.
bool file_exists(const std::string& path);

inline std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// The path without .gz at its end: readers unpack such files, and no writer makes one.
inline std::string_view without_gz(std::string_view path) {
    return path.ends_with(".gz") ? path.substr(0, path.size() - 3) : path;
}

/// True if the path, but for .gz, ends so, or in one of these, in any case. Suffixes are in lower case.
inline bool has_suffix(std::string_view path, std::string_view suffix) {
    return lower(without_gz(path)).ends_with(suffix);
}
inline bool has_one_of(std::string_view path, std::initializer_list<std::string_view> suffixes) {
    return std::ranges::any_of(suffixes, [&](std::string_view one) { return has_suffix(path, one); });
}

inline std::string suffix_of(const std::string& path) {
    const std::size_t dot = path.find_last_of("./");
    return dot == std::string::npos || path[dot] == '/' ? "" : path.substr(dot);
}
inline std::string stem_of(const std::string& path) {
    return path.substr(0, path.size() - suffix_of(path).size());
}

}  // namespace barycert::base

#include "core/base/nearest_name.hpp"

#include <dirent.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace barycert::base {
namespace {

constexpr std::size_t longest_word = 100;

char folded(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Whether a word of that many letters may be meant for another at that distance.
bool is_near(std::size_t distance, std::size_t letters) {
    return distance < letters && distance <= std::max<std::size_t>(1, letters / 3);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Row i holds the distances of the first i letters of a from the first 0, 1, ... of b.
    std::vector<std::size_t> before_last, last, row(b.size() + 1);
    for (std::size_t k = 0; k <= b.size(); ++k) row[k] = k;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = std::move(last);
        last = std::move(row);
        row.assign(b.size() + 1, i);
        for (std::size_t k = 1; k <= b.size(); ++k) {
            const bool same = folded(a[i - 1]) == folded(b[k - 1]);
            row[k] = std::min({last[k] + 1, row[k - 1] + 1, last[k - 1] + (same ? 0 : 1)});
            if (i > 1 && k > 1 && folded(a[i - 1]) == folded(b[k - 2]) && folded(a[i - 2]) == folded(b[k - 1]))
                row[k] = std::min(row[k], before_last[k - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
    if (word.size() > longest_word) return {};
    std::string nearest;
    std::size_t least = word.size() + 1;
    const auto look = [&](std::string_view part, const std::string& name) {
        // A word so much longer or shorter is at least that far away.
        const std::size_t apart = std::max(part.size(), word.size()) - std::min(part.size(), word.size());
        if (apart >= least || !is_near(apart, word.size())) return;
        const std::size_t distance = edit_distance(word, part);
        if (distance >= least || !is_near(distance, word.size())) return;
        least = distance;
        nearest = name;
    };
    for (const std::string& name : names) look(name, name);
    for (const std::string& name : names) {
        if (const std::size_t dot = name.rfind('.'); dot != std::string::npos)
            look(std::string_view(name).substr(dot + 1), name);
    }
    return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names, std::string_view rest) {
    const std::string name = nearest_name(word, names);
    if (name.empty()) return std::string(rest);
    return "did you mean \"" + name + (rest.empty() ? "\"?" : "\"? ") + std::string(rest);
}

std::vector<std::string> names_in_folder(const std::string& folder, std::error_code& failed) {
    const auto close = [](DIR* opened) { ::closedir(opened); };
    const std::unique_ptr<DIR, decltype(close)> opened(::opendir(folder.c_str()), close);
    failed = opened ? std::error_code() : std::error_code(errno, std::generic_category());
    std::vector<std::string> names;
    while (opened) {
        errno = 0;
        const dirent* const entry = ::readdir(opened.get());
        if (entry == nullptr) {
            failed.assign(errno, std::generic_category());
            break;
        }
        const std::string name = entry->d_name;
        if (name != "." && name != "..") names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
}

std::string near_file(const std::string& path) {
    const std::size_t name = path.find_last_of('/') + 1;
    const std::string folder = path.substr(0, name);
    std::error_code ignored;
    const std::string near = nearest_name(path.substr(name), names_in_folder(folder.empty() ? "." : folder, ignored));
    return near.empty() ? near : folder + near;
}

}  // namespace barycert::base

#include "io/words.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace barycert::io {

std::vector<std::string_view> cut_fields(std::string_view line, std::string_view blanks, std::string_view separators) {
    std::vector<std::string_view> fields;
    const auto is_one = [&](std::size_t i, std::string_view of) {
        return i < line.size() && of.find(line[i]) != std::string_view::npos;
    };
    std::size_t i = 0;
    const auto skip_blanks = [&] {
        while (is_one(i, blanks)) ++i;
    };
    bool separated = false;
    for (skip_blanks(); i < line.size(); skip_blanks()) {
        const std::size_t begin = i;
        while (i < line.size() && !is_one(i, blanks) && !is_one(i, separators)) ++i;
        fields.push_back(line.substr(begin, i - begin));
        skip_blanks();
        separated = is_one(i, separators);
        if (separated) ++i;
    }
    if (separated) fields.push_back(line.substr(line.size()));
    return fields;
}

std::string_view next_word(std::string_view& text) {
    std::size_t begin = 0;
    while (begin < text.size() && is_white(text[begin])) ++begin;
    std::size_t end = begin;
    while (end < text.size() && !is_white(text[end])) ++end;
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

bool has_word(std::string_view text, std::string_view wanted) {
    std::string_view word = next_word(text);
    while (!word.empty() && word != wanted) word = next_word(text);
    return !word.empty();
}

}  // namespace barycert::io

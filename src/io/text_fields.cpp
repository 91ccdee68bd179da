#include "io/formats.hpp"

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

}  // namespace barycert::io

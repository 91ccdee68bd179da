#include "barycert/report/common/html_text.hpp"

#include <algorithm>
#include <cstddef>

#include "barycert/base/utf8.hpp"
#include "barycert/report/common/svg.hpp"

namespace barycert::report {

std::string html_escaped(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const std::size_t size = base::first_character(text).size;
        valid += size == 0 ? std::string_view("\xef\xbf\xbd") : text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return xml_escaped(valid);
}

std::string html_name(std::string_view name) {
    std::string out;
    for (std::size_t at = 0; at < name.size();) {
        const std::size_t dot = name.find('.', at);
        const std::size_t end = dot == std::string_view::npos ? name.size() : dot + 1;
        out += html_escaped(name.substr(at, end - at)) + (end < name.size() ? "<wbr/>" : "");
        at = end;
    }
    return out;
}

}  // namespace barycert::report

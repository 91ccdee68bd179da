#include "barycert/io/vti/xml_name.hpp"

#include <cstdint>

#include "barycert/base/utf8.hpp"

namespace barycert::io {
namespace {

/// The production Char of XML 1.0.
bool is_xml(char32_t code) {
    if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
    return code < 0xD800 || (code >= 0xE000 && code < 0xFFFE) || (code >= 0x10000 && code < 0x110000);
}

}  // namespace

std::optional<std::string> xml_attribute(std::string_view name) {
    std::string text;
    while (!name.empty()) {
        const base::Character c = base::first_character(name);
        if (c.size == 0 || !is_xml(c.code)) return std::nullopt;
        // What would end the value, and white space, which a reader would turn into spaces.
        if (std::string_view("<>&\"'\t\n\r").find(name[0]) != std::string_view::npos) {
            text += "&#" + std::to_string(static_cast<std::uint32_t>(c.code)) + ";";
        } else {
            text += name.substr(0, c.size);
        }
        name.remove_prefix(c.size);
    }
    return text;
}

}  // namespace barycert::io

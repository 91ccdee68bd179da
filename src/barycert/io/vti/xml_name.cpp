#include "barycert/io/vti/xml_name.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace barycert::io {
namespace {

struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0;  // 0: not UTF-8
};

/// The first character of `text`, which is not empty (RFC 3629).
Character first_of(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC0 || lead >= 0xF8 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7FU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) return {};
        code = code << 6U | (byte(i) & 0x3FU);
    }
    // The shortest form alone is one; the lowest code of each length.
    constexpr std::array<std::uint32_t, 5> lowest{0, 0, 0x80, 0x800, 0x10000};
    if (code < lowest[bytes]) return {};
    return {code, bytes};
}

/// The production Char of XML 1.0.
bool is_xml(std::uint32_t code) {
    if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
    return code < 0xD800 || (code >= 0xE000 && code < 0xFFFE) || (code >= 0x10000 && code < 0x110000);
}

}  // namespace

std::optional<std::string> xml_attribute(std::string_view name) {
    std::string text;
    while (!name.empty()) {
        const Character c = first_of(name);
        if (c.bytes == 0 || !is_xml(c.code)) return std::nullopt;
        // What would end the value, and white space, which a reader would turn into spaces.
        if (std::string_view("<>&\"'\t\n\r").find(name[0]) != std::string_view::npos) {
            text += "&#" + std::to_string(c.code) + ";";
        } else {
            text += name.substr(0, c.bytes);
        }
        name.remove_prefix(c.bytes);
    }
    return text;
}

}  // namespace barycert::io

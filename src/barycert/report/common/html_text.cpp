#include "barycert/report/common/html_text.hpp"

#include <algorithm>
#include <cstddef>

#include "barycert/report/common/svg.hpp"

namespace barycert::report {
namespace {

/// Length of the UTF-8 sequence at the beginning of `s`; 0 if it is none.
std::size_t sequence(std::string_view s) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
    const unsigned char b = byte(0);
    if (b < 0x80) return 1;
    const std::size_t length = b >= 0xc2 && b < 0xe0 ? 2 : b >= 0xe0 && b < 0xf0 ? 3 : b >= 0xf0 && b < 0xf5 ? 4 : 0;
    if (length == 0 || s.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
    }
    // Overlong forms, surrogates, beyond U+10FFFF.
    const unsigned char c = byte(1);
    if ((b == 0xe0 && c < 0xa0) || (b == 0xed && c >= 0xa0) || (b == 0xf0 && c < 0x90) || (b == 0xf4 && c >= 0x90))
        return 0;
    return length;
}

}  // namespace

std::string html_escaped(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const std::size_t length = sequence(text);
        valid += length == 0 ? std::string_view("\xef\xbf\xbd") : text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return xml_escaped(valid);
}

}  // namespace barycert::report

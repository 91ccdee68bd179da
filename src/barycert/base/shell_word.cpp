#include "barycert/base/shell_word.hpp"

#include <array>
#include <cstdio>

#include "barycert/base/text.hpp"

namespace barycert::base {
namespace {

/// A word that is not printable: printf makes its bytes, also of -, which at the front would begin an option of its.
/// Line ends after the last other byte are lost in "$(...)" and follow as they are.
std::string word_of_bytes(std::string_view text) {
    const std::size_t end = text.find_last_not_of('\n') + 1;
    std::string word = "\"$(printf '";
    for (const char c : text.substr(0, end)) {
        const auto byte = static_cast<unsigned char>(c);
        std::array<char, 5> octal{};
        std::snprintf(octal.data(), octal.size(), "\\%03o", static_cast<unsigned>(byte));
        const bool plain = byte >= 0x20 && byte < 0x7f && c != '\'' && c != '\\' && c != '-';
        word += c == '%' ? "%%" : plain ? std::string(1, c) : std::string(octal.data());
    }
    word += "')\"";
    if (end != text.size()) word += "'" + std::string(text.substr(end)) + "'";
    return word;
}

}  // namespace

std::string shell_word(std::string_view text) {
    if (printable(text) != text) return word_of_bytes(text);
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,-^=:@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) return std::string(text);
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

}  // namespace barycert::base

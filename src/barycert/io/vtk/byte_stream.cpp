#include "barycert/io/vtk/byte_stream.hpp"

#include <array>
#include <cstdint>

namespace barycert::io {
namespace {

constexpr int space = -1, padding = -2, other = -3;

/// What each character stands for.
constexpr std::array<std::int8_t, 256> make_table() {
    std::array<std::int8_t, 256> table{};
    for (std::int8_t& entry : table) entry = other;
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i) {
        table[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
    }
    for (const char c : {' ', '\t', '\n', '\r'}) table[static_cast<unsigned char>(c)] = space;
    table['='] = padding;
    return table;
}
constexpr std::array<std::int8_t, 256> table = make_table();

}  // namespace

bool Base64Stream::next_quadruple() {
    std::uint32_t word = 0;
    int digits = 0, pads = 0;
    std::size_t at = 0;
    for (; digits + pads < 4 && at < left_.size(); ++at) {
        const std::int8_t value = table[static_cast<unsigned char>(left_[at])];
        if (value == space) continue;
        if (value == padding) {
            ++pads;
        } else if (value == other || pads != 0) {
            break;
        } else {
            word = word << 6U | static_cast<std::uint32_t>(value);
            ++digits;
        }
    }
    if (digits + pads < 4 || digits < 2) {
        left_ = {};
        return false;
    }
    left_.remove_prefix(at);
    word <<= 6 * static_cast<unsigned>(pads);
    for (std::size_t i = 0; i < 3; ++i) bytes_[i] = static_cast<char>(word >> (16 - 8 * i));
    first_ = 0;
    held_ = static_cast<std::size_t>(3 - pads);
    return true;
}

std::size_t Base64Stream::read(char* to, std::size_t count) {
    std::size_t done = 0;
    while (done < count) {
        if (held_ == 0 && !next_quadruple()) break;
        to[done++] = bytes_[first_++];
        --held_;
    }
    return done;
}

}  // namespace barycert::io

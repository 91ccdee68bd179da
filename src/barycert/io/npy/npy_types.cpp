#include "barycert/io/npy/npy_header.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "barycert/base/text.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::io {
namespace {

template <class Word>
Word load(const char* at) {
    Word word = 0;
    std::memcpy(&word, at, sizeof word);
    return word;
}

/// The item as an integer without sign; 8 bytes at most.
std::uint64_t word_at(const char* at, const NpyType& type) {
    switch (type.size) {
        case 8:
            return type.swapped ? __builtin_bswap64(load<std::uint64_t>(at)) : load<std::uint64_t>(at);
        case 4:
            return type.swapped ? __builtin_bswap32(load<std::uint32_t>(at)) : load<std::uint32_t>(at);
        case 2:
            return type.swapped ? __builtin_bswap16(load<std::uint16_t>(at)) : load<std::uint16_t>(at);
        default:
            return load<std::uint8_t>(at);
    }
}

/// Sign, 5 bits of exponent, 10 of fraction.
double half(std::uint64_t bits) {
    const auto fraction = static_cast<double>(bits & 0x3FFU);
    const int exponent = static_cast<int>(bits >> 10 & 0x1FU);
    double x = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(fraction + 1024, exponent - 25);
    if (exponent == 31)
        x = fraction == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    return (bits & 0x8000U) != 0 ? -x : x;
}

std::int64_t signed_value(std::uint64_t word, std::size_t size) {
    const auto unused = static_cast<int>(64 - 8 * size);
    return static_cast<std::int64_t>(word << unused) >> unused;
}

}  // namespace

void append_utf8(std::string& text, std::uint32_t code) {
    const auto more = [&](int shift) { text += static_cast<char>(0x80U | (code >> shift & 0x3FU)); };
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0U | code >> 6);
        more(0);
    } else if (code < 0x10000) {
        text += static_cast<char>(0xE0U | code >> 12);
        more(6);
        more(0);
    } else {
        text += static_cast<char>(0xF0U | code >> 18);
        more(12);
        more(6);
        more(0);
    }
}

std::optional<NpyType> npy_type(std::string_view descr) {
    constexpr std::size_t longest = std::size_t{1} << 30;
    NpyType type{.text = std::string(descr)};
    if (descr.size() < 3 || std::string_view("<>|").find(descr.front()) == std::string_view::npos) return std::nullopt;
    const bool big = descr.front() == '>';
    const char kind = descr[1];
    descr.remove_prefix(2);
    const auto [end, error] = std::from_chars(descr.data(), descr.data() + descr.size(), type.size);
    if (error != std::errc{} || kind == 'O' || type.size > longest) return std::nullopt;
    const std::string_view unit = descr.substr(static_cast<std::size_t>(end - descr.data()));  // <M8[ns]
    const bool time = kind == 'M' || kind == 'm';
    if (!unit.empty() && !(time && unit.starts_with('[') && unit.ends_with(']'))) return std::nullopt;
    type.swapped = big == (std::endian::native == std::endian::little);
    const bool fits = kind == 'f'   ? type.size == 2 || type.size == 4 || type.size == 8
                      : kind == 'b' ? type.size == 1
                                    : type.size == 1 || type.size == 2 || type.size == 4 || type.size == 8;
    if (((kind == 'f' || kind == 'i' || kind == 'u' || kind == 'b') && fits) || kind == 'S' || kind == 'U')
        type.kind = kind;
    constexpr std::string_view known = "fiubSUVcMm";
    if (known.find(kind) == std::string_view::npos) return std::nullopt;
    if (kind == 'U') type.size *= 4;
    return type;
}

std::optional<std::int64_t> npy_integer(const char* at, const NpyType& type) {
    const std::uint64_t word = word_at(at, type);
    if (type.kind == 'b') return word != 0 ? 1 : 0;
    if (type.kind == 'i') return signed_value(word, type.size);
    if (word > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) return std::nullopt;
    return static_cast<std::int64_t>(word);
}

std::optional<double> npy_double(const char* at, const NpyType& type) {
    const std::uint64_t word = word_at(at, type);
    if (type.kind == 'f' && type.size == 8) return std::bit_cast<double>(word);
    if (type.kind == 'f' && type.size == 4)
        return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(word)));
    if (type.kind == 'f') return half(word);
    if (type.kind == 'b') return word != 0 ? 1 : 0;
    const std::int64_t whole = type.kind == 'i' ? signed_value(word, type.size) : 0;
    const bool negative = whole < 0;
    const std::uint64_t magnitude = type.kind != 'i' ? word
                                    : negative       ? 0 - static_cast<std::uint64_t>(whole)
                                                     : static_cast<std::uint64_t>(whole);
    // A double holds 53 bits, and any number of zeros behind them.
    if (magnitude != 0 && std::bit_width(magnitude) - std::countr_zero(magnitude) > 53) return std::nullopt;
    const auto x = static_cast<double>(magnitude);
    return negative ? -x : x;
}

std::optional<std::string> npy_text(const char* at, const NpyType& type) {
    if (type.kind == 'S') {
        std::size_t size = type.size;
        while (size != 0 && at[size - 1] == '\0') --size;
        return std::string(at, size);
    }
    std::string text;
    std::size_t count = type.size / 4;
    const NpyType character{.kind = 'u', .size = 4, .swapped = type.swapped};
    while (count != 0 && word_at(at + 4 * (count - 1), character) == 0) --count;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t code = word_at(at + 4 * i, character);
        if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return std::nullopt;
        append_utf8(text, static_cast<std::uint32_t>(code));
    }
    return text;
}

bool fits_npy_text(std::string_view text, std::size_t size, bool characters) {
    if (text.ends_with('\0')) return false;
    if (!characters) return text.size() <= size;
    const std::ptrdiff_t count = mesh::count_characters(text);
    return count >= 0 && static_cast<std::size_t>(count) <= size / 4;
}

void put_npy_text(char* at, std::size_t size, std::string_view text, bool characters) {
    std::memset(at, 0, size);
    if (!characters) {
        std::copy(text.begin(), text.end(), at);
        return;
    }
    for (; !text.empty(); at += 4) {
        const auto [code, bytes] = base::first_character(text);
        text.remove_prefix(bytes);
        for (std::size_t i = 0; i < 4; ++i) at[i] = static_cast<char>(code >> 8 * i & 0xFFU);
    }
}

}  // namespace barycert::io

#include "barycert/io/vtk/numbers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "barycert/base/text.hpp"

namespace barycert::io {
namespace {

/// f.operator()<T>() for the C++ type of a number type other than bit.
template <class F>
decltype(auto) with_type(NumberType type, F&& f) {
    switch (type) {
        case NumberType::int8:
            return f.template operator()<std::int8_t>();
        case NumberType::int16:
            return f.template operator()<std::int16_t>();
        case NumberType::uint16:
            return f.template operator()<std::uint16_t>();
        case NumberType::int32:
            return f.template operator()<std::int32_t>();
        case NumberType::uint32:
            return f.template operator()<std::uint32_t>();
        case NumberType::int64:
            return f.template operator()<std::int64_t>();
        case NumberType::uint64:
            return f.template operator()<std::uint64_t>();
        case NumberType::float32:
            return f.template operator()<float>();
        case NumberType::float64:
            return f.template operator()<double>();
        default:
            return f.template operator()<std::uint8_t>();
    }
}

constexpr double two63 = 0x1p63;

/// Whether `to` became the same number.
template <class To, class From>
bool convert(From from, To& to) {
    if constexpr (std::is_floating_point_v<To>) {
        to = static_cast<To>(from);
        if constexpr (std::is_integral_v<From> && sizeof(From) == 8) {
            const std::uint64_t size =
                from < From{0} ? std::uint64_t{0} - static_cast<std::uint64_t>(from) : static_cast<std::uint64_t>(from);
            return size == 0 || std::bit_width(size) - std::countr_zero(size) <= std::numeric_limits<To>::digits;
        }
        return true;
    } else if constexpr (std::is_floating_point_v<From>) {
        if (!(from >= -two63 && from < two63) || std::trunc(from) != from) return false;
        return convert(static_cast<std::int64_t>(from), to);
    } else {
        to = static_cast<To>(from);  // NOLINT(bugprone-signed-char-misuse): a number of 8 bits, no character
        return std::in_range<To>(from);
    }
}

template <class T>
std::string text_of(T value) {
    if constexpr (std::is_floating_point_v<T>) {
        return base::shortest(static_cast<double>(value));
    } else {
        return std::to_string(value);
    }
}

/// The bytes of one number, in the order of this machine.
template <class T>
T number_at(const char* bytes, bool swap_bytes) {
    std::array<char, sizeof(T)> own{};
    for (std::size_t i = 0; i < sizeof(T); ++i) own[i] = bytes[swap_bytes ? sizeof(T) - 1 - i : i];
    return std::bit_cast<T>(own);
}

template <class To>
NumberFault read_bits(ByteStream& stream, std::size_t count, std::vector<To>& values) {
    char byte = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 8 == 0 && stream.read(&byte, 1) != 1) return {NumberFault::Kind::too_few, i, {}};
        values.push_back(static_cast<To>((static_cast<unsigned char>(byte) >> (7 - i % 8)) & 1U));
    }
    return {};
}

template <class From, class To>
NumberFault read_words(ByteStream& stream, bool swap_bytes, std::size_t count, std::vector<To>& values) {
    constexpr std::size_t block = 8192;
    std::vector<char> bytes(block * sizeof(From));
    NumberFault fault;
    for (std::size_t done = 0; done < count;) {
        const std::size_t step = std::min(block, count - done);
        const std::size_t whole = stream.read(bytes.data(), step * sizeof(From)) / sizeof(From);
        for (std::size_t i = 0; i < whole; ++i) {
            const From from = number_at<From>(&bytes[i * sizeof(From)], swap_bytes);
            To to{};
            if (!convert(from, to) && !fault) fault = {NumberFault::Kind::not_exact, done + i, text_of(from)};
            values.push_back(to);
        }
        done += whole;
        if (whole < step) return {NumberFault::Kind::too_few, done, {}};
    }
    return fault;
}

/// The number a word writes, in the type it has in the file.
template <class T>
bool parse(std::string_view word, T& value) {
    if constexpr (std::is_same_v<T, double>) {
        const std::optional<double> number = base::parse_double(word);
        value = number.value_or(0);
        return number.has_value();
    } else {
        if (word.starts_with('+')) word.remove_prefix(1);
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if constexpr (std::is_same_v<T, float>) {
            // Too small for a float: zero or the least of them, which the double rounds to.
            if (error == std::errc::result_out_of_range) {
                const std::optional<double> wide = base::parse_double(word);
                if (!wide || std::abs(*wide) > 1) return false;
                value = static_cast<float>(*wide);
                return true;
            }
        }
        return error == std::errc{} && end == word.data() + word.size();
    }
}

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

template <class From, class To>
NumberFault read_words(std::string_view& text, std::size_t count, std::vector<To>& values) {
    NumberFault fault;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view word = next_word(text);
        if (word.empty()) return {NumberFault::Kind::too_few, i, {}};
        From from{};
        To to{};
        if (!parse(word, from)) return {NumberFault::Kind::no_number, i, std::string(word.substr(0, 40))};
        if (!convert(from, to) && !fault) fault = {NumberFault::Kind::not_exact, i, std::string(word.substr(0, 40))};
        values.push_back(to);
    }
    return fault;
}

/// Room for no more than the data can hold, so that a false count takes no memory.
template <class To>
void reserve(std::vector<To>& values, std::size_t count, std::uint64_t room) {
    const std::size_t wanted = values.size() + static_cast<std::size_t>(std::min<std::uint64_t>(count, room));
    // Doubled at least: arrays of many pieces would else be copied with each.
    if (wanted > values.capacity()) values.reserve(std::max(wanted, 2 * values.capacity()));
}

}  // namespace

std::optional<std::uint64_t> byte_count(NumberType type, std::uint64_t count) {
    if (type == NumberType::bit) return count / 8 + (count % 8 != 0 ? 1 : 0);
    const std::uint64_t size = with_type(type, []<class T>() { return sizeof(T); });
    if (count > std::numeric_limits<std::uint64_t>::max() / size) return std::nullopt;
    return count * size;
}

std::string_view next_word(std::string_view& text) {
    std::size_t begin = 0;
    while (begin < text.size() && is_space(text[begin])) ++begin;
    std::size_t end = begin;
    while (end < text.size() && !is_space(text[end])) ++end;
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

std::optional<std::uint64_t> parse_count(std::string_view text) {
    std::string_view word = next_word(text);
    if (!next_word(text).empty()) return std::nullopt;
    if (word.starts_with('+')) word.remove_prefix(1);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

template <class To>
NumberFault read_binary(ByteStream& stream, NumberType type, bool swap_bytes, std::size_t count,
                        std::vector<To>& values) {
    const std::uint64_t room = stream.room();
    if (type == NumberType::bit) {
        reserve(values, count, 8 * room);
        return read_bits(stream, count, values);
    }
    return with_type(type, [&]<class From>() {
        reserve(values, count, room / sizeof(From));
        return read_words<From>(stream, swap_bytes, count, values);
    });
}

template <class To>
NumberFault read_text(std::string_view& text, NumberType type, std::size_t count, std::vector<To>& values) {
    reserve(values, count, text.size() / 2 + 1);
    return with_type(type, [&]<class From>() { return read_words<From>(text, count, values); });
}

template NumberFault read_binary(ByteStream&, NumberType, bool, std::size_t, std::vector<double>&);
template NumberFault read_binary(ByteStream&, NumberType, bool, std::size_t, std::vector<std::int64_t>&);
template NumberFault read_binary(ByteStream&, NumberType, bool, std::size_t, std::vector<std::int32_t>&);
template NumberFault read_binary(ByteStream&, NumberType, bool, std::size_t, std::vector<std::uint8_t>&);
template NumberFault read_text(std::string_view&, NumberType, std::size_t, std::vector<double>&);
template NumberFault read_text(std::string_view&, NumberType, std::size_t, std::vector<std::int64_t>&);
template NumberFault read_text(std::string_view&, NumberType, std::size_t, std::vector<std::int32_t>&);
template NumberFault read_text(std::string_view&, NumberType, std::size_t, std::vector<std::uint8_t>&);

}  // namespace barycert::io

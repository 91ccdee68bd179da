/// The numbers of VTK files, of every type and in every encoding, as those that meshes hold.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace barycert::io {

enum class NumberType : std::uint8_t {
    bit,  ///< 8 a byte, the first in the highest bit
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64,
    text  ///< no number: bytes up to a zero byte
};

/// In C++, in this order.
using NumberTypes = std::tuple<std::uint8_t, std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
                               std::uint32_t, std::int64_t, std::uint64_t, float, double, std::uint8_t>;

/// "Float64": its name in XML files.
std::string_view xml_name(NumberType type);
/// By this name, or that in legacy files, in capitals.
std::optional<NumberType> type_of_name(std::string_view name);

std::size_t number_bytes(NumberType type);

/// Bytes that `count` numbers take; nothing if they do not fit in 64 bits.
std::optional<std::uint64_t> byte_count(NumberType type, std::uint64_t count);

/// Fault of a number.
struct NumberFault {
    enum class Kind : std::uint8_t {
        none,
        too_few,    ///< the data end before the last number
        no_number,  ///< text that is no number of that type
        not_exact,  ///< the number is not one of the type asked for
    };
    Kind kind = Kind::none;
    std::size_t index = 0;        ///< of the number, from 0
    std::string text = {};        ///< as it stands in the file
    const char* place = nullptr;  ///< where it stands, if that is a text

    explicit operator bool() const { return kind != Kind::none; }
};

/// Where numbers go: behind those of a vector of one of the types that meshes hold.
using NumbersTo =
    std::variant<std::reference_wrapper<std::vector<double>>, std::reference_wrapper<std::vector<std::int64_t>>,
                 std::reference_wrapper<std::vector<std::int32_t>>, std::reference_wrapper<std::vector<std::uint8_t>>>;

/// Appends `count` numbers, of bytes that may be too few. From a number that is not exact on, others may stand there.
NumberFault read_binary(std::string_view bytes, NumberType type, bool swapped, std::size_t count, NumbersTo values);

/// The same from text, off which that is taken. Numbers are rounded to their type, as by VTK. Memory grows with them.
NumberFault read_text(std::string_view& text, NumberType type, std::size_t count, NumbersTo values);

/// A count as XML attributes and headers give it: blanks around it, a plus before it. Nothing if it is none.
std::optional<std::uint64_t> parse_count(std::string_view text);

inline bool is_letter_or_digit(char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// f.operator()<T>() for the C++ type of a number type; for bit and text that of uint8.
template <class F>
decltype(auto) with_number_type(NumberType type, F&& f) {
    using Own = std::remove_reference_t<F>;
    const auto calls = []<class... T>(const std::tuple<T...>*) {
        return std::array{+[](Own& own) { return own.template operator()<T>(); }...};
    }(static_cast<const NumberTypes*>(nullptr));
    return calls[static_cast<std::size_t>(type)](f);
}

/// Whether `to` became the same number.
template <class To, class From>
bool convert_number(From from, To& to) {
    if constexpr (std::is_floating_point_v<To>) {
        to = static_cast<To>(from);
        if constexpr (std::is_integral_v<From> && sizeof(From) == 8) {
            if (std::in_range<std::int32_t>(from)) return true;  // as most are
            const std::uint64_t size =
                from < From{0} ? std::uint64_t{0} - static_cast<std::uint64_t>(from) : static_cast<std::uint64_t>(from);
            return size == 0 || std::bit_width(size) - std::countr_zero(size) <= std::numeric_limits<To>::digits;
        }
        return true;
    } else if constexpr (std::is_floating_point_v<From>) {
        to = To{};
        if (!(from >= -0x1p63 && from < 0x1p63) || std::trunc(from) != from) return false;
        return convert_number(static_cast<std::int64_t>(from), to);
    } else {
        to = static_cast<To>(from);  // NOLINT(bugprone-signed-char-misuse): a number of 8 bits, no character
        return std::in_range<To>(from);
    }
}

/// The bytes of these numbers, as they stand in memory.
template <class Numbers>
std::string_view bytes_of(const Numbers& numbers) {
    static_assert(std::is_trivially_copyable_v<std::remove_cvref_t<decltype(*std::data(numbers))>>);
    return {reinterpret_cast<const char*>(std::data(numbers)), std::size(numbers) * sizeof(*std::data(numbers))};
}

/// The number at those bytes, which stand in the order of this machine or in the other.
template <class T>
T number_at(const char* bytes, bool swapped) {
    using Words = std::tuple<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>;
    std::tuple_element_t<std::bit_width(sizeof(T)) - 1, Words> word = 0;
    std::memcpy(&word, bytes, sizeof(T));
    if constexpr (sizeof(T) == 8) word = swapped ? __builtin_bswap64(word) : word;
    if constexpr (sizeof(T) == 4) word = swapped ? __builtin_bswap32(word) : word;
    if constexpr (sizeof(T) == 2) word = swapped ? __builtin_bswap16(word) : word;
    return std::bit_cast<T>(word);
}

}  // namespace barycert::io

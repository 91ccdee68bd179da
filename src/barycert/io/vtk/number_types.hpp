/// The C++ types of the numbers in VTK files, and one as another.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "barycert/io/vtk/numbers.hpp"

namespace barycert::io {

/// f.operator()<T>() for the C++ type of a number type; for bit that of uint8.
template <class F>
decltype(auto) with_number_type(NumberType type, F&& f) {
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

/// Whether `to` became the same number.
template <class To, class From>
bool convert_number(From from, To& to) {
    if constexpr (std::is_floating_point_v<To>) {
        to = static_cast<To>(from);
        if constexpr (std::is_integral_v<From> && sizeof(From) == 8) {
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

/// The number at those bytes, which stand in the order of this machine or in the other.
template <class T, bool swap>
T number_at(const char* bytes) {
    if constexpr (!swap || sizeof(T) == 1) {
        T value{};
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    } else if constexpr (sizeof(T) == 2) {
        std::uint16_t word = 0;
        std::memcpy(&word, bytes, 2);
        return std::bit_cast<T>(__builtin_bswap16(word));
    } else if constexpr (sizeof(T) == 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, bytes, 4);
        return std::bit_cast<T>(__builtin_bswap32(word));
    } else {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes, 8);
        return std::bit_cast<T>(__builtin_bswap64(word));
    }
}

inline bool is_white(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace barycert::io

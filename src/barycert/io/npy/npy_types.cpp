#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "barycert/io/npy/npy.hpp"
#include "barycert/io/vtk/numbers.hpp"

namespace barycert::io {
namespace {

/// Sign, 5 bits of exponent, 10 of fraction.
double half(std::uint16_t bits) {
    const auto fraction = static_cast<double>(bits & 0x3FFU);
    const int exponent = static_cast<int>(bits >> 10 & 0x1FU);
    double x = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(fraction + 1024, exponent - 25);
    if (exponent == 31)
        x = fraction == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    return (bits & 0x8000U) != 0 ? -x : x;
}

/// Of types whose kind and size are known: neither halves nor booleans.
NumberType number_type(const NpyType& type) {
    const auto doublings = static_cast<int>(std::bit_width(type.size)) - 1;
    const int first = static_cast<int>(NumberType::int8) + (type.kind == 'i' ? 0 : 1);
    if (type.kind == 'f') return type.is_double() ? NumberType::float64 : NumberType::float32;
    return static_cast<NumberType>(first + 2 * doublings);
}

}  // namespace

template <class To>
std::size_t npy_numbers(const char* at, std::size_t step, std::size_t count, const NpyType& type, To* out,
                        std::size_t stride) {
    const auto all = [&]<class From>(const auto& change) {
        std::size_t i = 0;
        while (i < count && convert_number(change(number_at<From>(at + i * step, type.swapped)), out[i * stride])) ++i;
        return i;
    };
    if (type.kind == 'f' && type.size == 2) return all.template operator()<std::uint16_t>(half);
    if (type.kind == 'b')
        return all.template operator()<std::uint8_t>([](std::uint8_t x) { return static_cast<int>(x != 0); });
    return with_number_type(number_type(type),
                            [&]<class From>() { return all.template operator()<From>([](From x) { return x; }); });
}
template std::size_t npy_numbers(const char*, std::size_t, std::size_t, const NpyType&, double*, std::size_t);
template std::size_t npy_numbers(const char*, std::size_t, std::size_t, const NpyType&, std::int64_t*, std::size_t);

bool append_utf8(std::string& text, std::uint32_t code) {
    if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return false;
    // The first code that takes two, three and four bytes; what marks the first of so many.
    constexpr std::array<std::uint32_t, 3> longer{0x80, 0x800, 0x10000};
    constexpr std::array<std::uint32_t, 4> marks{0, 0xC0, 0xE0, 0xF0};
    auto more = static_cast<std::size_t>(std::upper_bound(longer.begin(), longer.end(), code) - longer.begin());
    text += static_cast<char>(marks[more] | code >> 6 * more);
    while (more-- != 0) text += static_cast<char>(0x80U | (code >> 6 * more & 0x3FU));
    return true;
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
    const std::size_t least = kind == 'f' ? 2 : 1, most = kind == 'b' ? 1 : 8;
    const bool fits = std::has_single_bit(type.size) && type.size >= least && type.size <= most;
    if (((kind == 'f' || kind == 'i' || kind == 'u' || kind == 'b') && fits) || kind == 'S' || kind == 'U')
        type.kind = kind;
    constexpr std::string_view known = "fiubSUVcMm";
    if (known.find(kind) == std::string_view::npos) return std::nullopt;
    if (kind == 'U') type.size *= 4;
    return type;
}

std::optional<std::string> npy_text(const char* at, const NpyType& type) {
    if (type.kind == 'S') {
        std::size_t size = type.size;
        while (size != 0 && at[size - 1] == '\0') --size;
        return std::string(at, size);
    }
    std::string text;
    std::size_t count = type.size / 4;
    const auto code_at = [&](std::size_t i) { return number_at<std::uint32_t>(at + 4 * i, type.swapped); };
    while (count != 0 && code_at(count - 1) == 0) --count;
    for (std::size_t i = 0; i < count; ++i) {
        if (!append_utf8(text, code_at(i))) return std::nullopt;
    }
    return text;
}

}  // namespace barycert::io

#include "barycert/io/vtk/numbers.hpp"

#include <atomic>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/vtk/number_types.hpp"
#include "barycert/io/vtk/parallel.hpp"

namespace barycert::io {
namespace {

/// Whether a number of those bytes is certain to be exact: all but what needs a closer look.
template <class To, class From>
bool plainly_exact(From from) {
    if constexpr (std::is_same_v<To, From> || (std::is_floating_point_v<To> && sizeof(From) < sizeof(To))) {
        return true;
    } else if constexpr (std::is_floating_point_v<From>) {
        return false;
    } else if constexpr (std::is_floating_point_v<To>) {
        constexpr std::uint64_t wide = std::uint64_t{1} << 53U;
        if constexpr (std::is_unsigned_v<From>) return from <= wide;
        return static_cast<std::uint64_t>(from) + wide <= 2 * wide;
    } else {
        return std::in_range<To>(from);
    }
}

template <class T>
std::string number_text(T value) {
    if constexpr (std::is_floating_point_v<T>) {
        return base::shortest(static_cast<double>(value));
    } else {
        return std::to_string(value);
    }
}

/// One run of numbers, on this thread; the first that is not exact, or `count`.
template <class From, bool swap, class To>
std::size_t convert_run(const char* bytes, std::size_t count, To* to) {
    if constexpr (std::is_same_v<From, To> && !swap) {
        if (count != 0) std::memcpy(to, bytes, count * sizeof(To));
        return count;
    } else {
        bool plain = true;
        for (std::size_t i = 0; i < count; ++i) {
            const From from = number_at<From, swap>(bytes + i * sizeof(From));
            plain = plain && plainly_exact<To>(from);
            if constexpr (std::is_floating_point_v<From> && std::is_integral_v<To>) {
                convert_number(from, to[i]);  // no plain cast: that of a number out of range is undefined
            } else {
                to[i] = static_cast<To>(from);  // NOLINT(bugprone-signed-char-misuse): a number, no character
            }
        }
        if (plain) return count;
        for (std::size_t i = 0; i < count; ++i) {
            if (!convert_number(number_at<From, swap>(bytes + i * sizeof(From)), to[i])) return i;
        }
        return count;
    }
}

template <class From, class To>
std::size_t convert_all(const char* bytes, bool swap_bytes, std::size_t count, To* to) {
    constexpr std::size_t part = std::size_t{1} << 17;
    std::atomic<std::size_t> first_fault{count};
    in_parts(count, part, [&](std::size_t first, std::size_t last) {
        const char* const from = bytes + first * sizeof(From);
        const std::size_t good = first + (swap_bytes ? convert_run<From, true>(from, last - first, to + first)
                                                     : convert_run<From, false>(from, last - first, to + first));
        if (good == last) return;
        std::size_t known = first_fault.load();
        while (good < known && !first_fault.compare_exchange_weak(known, good)) {
        }
    });
    return first_fault;
}

template <class To>
void append_bits(std::string_view bytes, std::size_t count, std::vector<To>& values) {
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(static_cast<To>((static_cast<unsigned char>(bytes[i / 8]) >> (7 - i % 8)) & 1U));
    }
}

}  // namespace

std::size_t number_bytes(NumberType type) {
    return with_number_type(type, []<class T>() { return sizeof(T); });
}

std::optional<std::uint64_t> byte_count(NumberType type, std::uint64_t count) {
    if (type == NumberType::bit) return count / 8 + (count % 8 != 0 ? 1 : 0);
    const std::uint64_t size = number_bytes(type);
    if (count > std::numeric_limits<std::uint64_t>::max() / size) return std::nullopt;
    return count * size;
}

std::string_view next_word(std::string_view& text) {
    std::size_t begin = 0;
    while (begin < text.size() && is_white(text[begin])) ++begin;
    std::size_t end = begin;
    while (end < text.size() && !is_white(text[end])) ++end;
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
std::size_t convert_numbers(std::string_view bytes, NumberType type, bool swap_bytes, std::size_t count, To* to) {
    return with_number_type(type, [&]<class From>() { return convert_all<From>(bytes.data(), swap_bytes, count, to); });
}

template <class To>
bool are_as_they_stand(NumberType type, bool swap_bytes) {
    return type != NumberType::bit && with_number_type(type, [&]<class From>() {
               return std::is_same_v<From, To> && (!swap_bytes || sizeof(From) == 1);
           });
}

NumberFault inexact_number(std::string_view bytes, NumberType type, bool swap_bytes, std::size_t index) {
    const std::string text = with_number_type(type, [&]<class From>() {
        const char* const at = bytes.data() + index * sizeof(From);
        return number_text(swap_bytes ? number_at<From, true>(at) : number_at<From, false>(at));
    });
    return {NumberFault::Kind::not_exact, index, text};
}

template <class To>
NumberFault read_binary(std::string_view bytes, NumberType type, bool swap_bytes, std::size_t count,
                        std::vector<To>& values) {
    const std::size_t there = type == NumberType::bit ? std::min(count, 8 * std::min(bytes.size(), count / 8 + 1))
                                                      : std::min(count, bytes.size() / number_bytes(type));
    make_room(values, there);
    std::size_t exact = there;
    if (type == NumberType::bit) {
        append_bits(bytes, there, values);
    } else {
        const std::size_t before = values.size();
        values.resize(before + there);
        exact = convert_numbers(bytes, type, swap_bytes, there, values.data() + before);
    }
    if (there < count) return {NumberFault::Kind::too_few, there, {}};
    if (exact < there) return inexact_number(bytes, type, swap_bytes, exact);
    return {};
}

template std::size_t convert_numbers(std::string_view, NumberType, bool, std::size_t, double*);
template std::size_t convert_numbers(std::string_view, NumberType, bool, std::size_t, std::int64_t*);
template std::size_t convert_numbers(std::string_view, NumberType, bool, std::size_t, std::int32_t*);
template std::size_t convert_numbers(std::string_view, NumberType, bool, std::size_t, std::uint8_t*);
template bool are_as_they_stand<double>(NumberType, bool);
template bool are_as_they_stand<std::int64_t>(NumberType, bool);
template bool are_as_they_stand<std::int32_t>(NumberType, bool);
template bool are_as_they_stand<std::uint8_t>(NumberType, bool);
template NumberFault read_binary(std::string_view, NumberType, bool, std::size_t, std::vector<double>&);
template NumberFault read_binary(std::string_view, NumberType, bool, std::size_t, std::vector<std::int64_t>&);
template NumberFault read_binary(std::string_view, NumberType, bool, std::size_t, std::vector<std::int32_t>&);
template NumberFault read_binary(std::string_view, NumberType, bool, std::size_t, std::vector<std::uint8_t>&);

}  // namespace barycert::io

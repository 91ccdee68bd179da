#include "io/vtk/numbers.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>
#include <vector>

#include "core/base/text.hpp"
#include "io/number_word.hpp"
#include "io/parallel.hpp"
#include "io/paths.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

// Code that depends on the type in the file and on the one in memory is compiled for each pair: a loop, and no more.

/// One run of numbers, on this thread; the first that is not exact, or `count`.
template <class From, class To>
std::size_t convert_run(const char* bytes, bool swapped, std::size_t count, To* to) {
    if (std::is_same_v<From, To> && !swapped) {
        if (count != 0) std::memcpy(to, bytes, count * sizeof(To));
        return count;
    }
    bool exact = true;
    for (std::size_t i = 0; i < count; ++i)
        exact &= convert_number(number_at<From>(bytes + i * sizeof(From), swapped), to[i]);
    std::size_t i = exact ? count : 0;
    while (i < count && convert_number(number_at<From>(bytes + i * sizeof(From), swapped), to[i])) ++i;
    return i;
}

std::string number_text(const char* bytes, NumberType type, bool swapped) {
    return with_number_type(type, [&]<class T>() {
        const auto value = number_at<T>(bytes, swapped);
        if constexpr (std::is_floating_point_v<T>) {
            return base::shortest(static_cast<double>(value));
        } else {
            return std::to_string(value);
        }
    });
}

template <class To>
NumberFault append_numbers(std::string_view bytes, NumberType type, bool swapped, std::size_t count,
                           std::vector<To>& values) {
    const auto convert = with_number_type(type, []<class From>() { return &convert_run<From, To>; });
    const std::size_t size = number_bytes(type), there = std::min(count, bytes.size() / size), before = values.size();
    grow(values, there);
    const std::size_t exact = first_bad(there, std::size_t{1} << 17, [&](std::size_t first, std::size_t last) {
        return first + convert(bytes.data() + first * size, swapped, last - first, values.data() + before + first);
    });
    if (there < count) return {NumberFault::Kind::too_few, there};
    if (exact == there) return {};
    return {NumberFault::Kind::not_exact, exact, number_text(bytes.data() + exact * size, type, swapped)};
}

template <class To>
NumberFault append_bits(std::string_view bytes, std::size_t count, std::vector<To>& values) {
    const std::size_t there = std::min(count, 8 * std::min(bytes.size(), count / 8 + 1));
    make_room(values, there);
    for (std::size_t i = 0; i < there; ++i)
        values.push_back(static_cast<To>((static_cast<unsigned char>(bytes[i / 8]) >> (7 - i % 8)) & 1U));
    if (there < count) return {NumberFault::Kind::too_few, there};
    return {};
}

/// In the order of NumberType: XML's name, then those of legacy files, where vtkIdType has 32 bits. A long has 64 here.
constexpr std::array<std::string_view, 12> type_names{"Bit BIT",
                                                      "Int8 CHAR SIGNED_CHAR",
                                                      "UInt8 UNSIGNED_CHAR",
                                                      "Int16 SHORT",
                                                      "UInt16 UNSIGNED_SHORT",
                                                      "Int32 VTKIDTYPE INT",
                                                      "UInt32 UNSIGNED_INT",
                                                      "Int64 LONG VTKTYPEINT64 LONG_LONG __INT64",
                                                      "UInt64 UNSIGNED_LONG VTKTYPEUINT64 UNSIGNED_LONG_LONG",
                                                      "Float32 FLOAT",
                                                      "Float64 DOUBLE",
                                                      "String STRING UTF8_STRING VARIANT"};

// Numbers as text, on all threads: parts of the text, cut between words, are read, then put together in their order.

/// The number that the word is, rounded to its type; false if it is none of that type.
template <class From>
bool read_word(std::string_view word, From& value) {
    if constexpr (std::is_same_v<From, double>) {
        const std::optional<double> number = real_of_word(word, false);
        value = number.value_or(0);
        return number.has_value();
    } else {
        word = without_plus(word);
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if constexpr (std::is_same_v<From, float>) {
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

/// The same at `at`: what stands behind it, white space or the end; nullptr where a closer look is needed.
template <class From>
const char* read_quickly(const char* at, const char* end, From& value) {
    const auto [behind, error] = [&] {
        if constexpr (std::is_floating_point_v<From>) {
            return fast_float::from_chars(at, end, value);
        } else {
            return std::from_chars(at, end, value);
        }
    }();
    const bool good = error == std::errc{} && value - value == 0;  // else it is infinite or NaN
    return good && (behind == end || is_white(*behind)) ? behind : nullptr;
}

/// Up to `count` numbers of one part of the text.
template <class To>
struct TextPart {
    std::vector<To> values;
    NumberFault fault;  // its index counts from the first number of the part
    const char* end = nullptr;

    template <class From>
    void read(std::string_view text, std::size_t count) {
        values.clear();
        fault = {};
        const char* at = text.data();
        const char* const last = at + text.size();
        while (values.size() < count) {
            while (at != last && is_white(*at)) ++at;
            if (at == last) break;
            From from{};
            const char* behind = read_quickly(at, last, from);
            if (behind == nullptr) {
                std::string_view rest(at, static_cast<std::size_t>(last - at));
                const std::string_view word = next_word(rest);
                if (!read_word(word, from)) {
                    fault = {NumberFault::Kind::no_number, values.size(), std::string(word.substr(0, 40)), word.data()};
                    break;
                }
                behind = at + word.size();
            }
            To to{};
            if (!convert_number(from, to) && !fault) {
                const std::string_view word(at, static_cast<std::size_t>(behind - at));
                fault = {NumberFault::Kind::not_exact, values.size(), std::string(word.substr(0, 40)), at};
            }
            values.push_back(to);
            at = behind;
        }
        end = at;
    }
};

constexpr std::size_t part_bytes = std::size_t{1} << 18;

/// The text in parts of about that size, each ended by white space; at most `most` of them.
std::vector<std::string_view> parts_of(std::string_view text, std::size_t most) {
    std::vector<std::string_view> parts;
    while (!text.empty() && parts.size() < most) {
        std::size_t size = std::min(part_bytes, text.size());
        while (size < text.size() && !is_white(text[size])) ++size;
        parts.push_back(text.substr(0, size));
        text.remove_prefix(size);
    }
    return parts;
}

template <class To>
NumberFault read_words(std::string_view& text, NumberType type, std::size_t count, std::vector<To>& values) {
    const auto read_part = [type](TextPart<To>& part, std::string_view from, std::size_t most) {
        with_number_type(type, [&]<class From>() { part.template read<From>(from, most); });
    };
    NumberFault fault;
    constexpr std::size_t most = 64;
    std::vector<TextPart<To>> read(1);
    for (std::size_t done = 0; done < count;) {
        // Few numbers take more than 32 bytes: text far behind the last one is not looked at.
        const std::size_t left = count - done;
        const std::vector<std::string_view> parts = parts_of(text, std::min(most, left / (part_bytes / 32) + 1));
        if (parts.empty()) return {NumberFault::Kind::too_few, done};
        if (read.size() < parts.size()) read.resize(parts.size());
        in_parallel(parts.size(), [&](std::size_t i) { read_part(read[i], parts[i], left); });
        std::vector<std::size_t> places;
        std::size_t size = values.size();
        for (std::size_t i = 0; i < parts.size() && done < count; ++i) {
            TextPart<To>& part = read[i];
            const std::size_t wanted = count - done;
            const bool no_number = part.fault.kind == NumberFault::Kind::no_number;
            if (part.values.size() > wanted || (part.values.size() == wanted && no_number))
                read_part(part, parts[i], wanted);  // what follows are other words
            if (part.fault && (!fault || part.fault.kind == NumberFault::Kind::no_number)) {
                fault = part.fault;
                fault.index += done;
                if (fault.kind == NumberFault::Kind::no_number) return fault;
            }
            places.push_back(size);
            size += part.values.size();
            done += part.values.size();
            text.remove_prefix(static_cast<std::size_t>(part.end - text.data()));
        }
        grow(values, size - values.size());
        in_parallel(places.size(),
                    [&](std::size_t i) { std::ranges::copy(read[i].values, values.data() + places[i]); });
    }
    return fault;
}

}  // namespace

std::string_view xml_name(NumberType type) {
    std::string_view names = type_names[static_cast<std::size_t>(type)];
    return next_word(names);
}

std::optional<NumberType> type_of_name(std::string_view name) {
    const auto* const found = std::ranges::find_if(type_names, [&](auto names) { return has_word(names, name); });
    if (found == type_names.end()) return std::nullopt;
    return static_cast<NumberType>(found - type_names.begin());
}

std::size_t number_bytes(NumberType type) {
    return with_number_type(type, []<class T>() { return sizeof(T); });
}

std::optional<std::uint64_t> byte_count(NumberType type, std::uint64_t count) {
    if (type == NumberType::bit) return count / 8 + (count % 8 != 0 ? 1 : 0);
    const std::uint64_t size = number_bytes(type);
    if (count > std::numeric_limits<std::uint64_t>::max() / size) return std::nullopt;
    return count * size;
}

std::optional<std::uint64_t> parse_count(std::string_view text) {
    std::string_view word = next_word(text);
    if (!next_word(text).empty()) return std::nullopt;
    if (word.starts_with('+')) word.remove_prefix(1);
    return whole_number<std::uint64_t>(word);
}

NumberFault read_binary(std::string_view bytes, NumberType type, bool swapped, std::size_t count, NumbersTo values) {
    return std::visit(
        [&](auto to) {
            return type == NumberType::bit ? append_bits(bytes, count, to.get())
                                           : append_numbers(bytes, type, swapped, count, to.get());
        },
        values);
}

NumberFault read_text(std::string_view& text, NumberType type, std::size_t count, NumbersTo values) {
    return std::visit([&](auto to) { return read_words(text, type, count, to.get()); }, values);
}

}  // namespace barycert::io

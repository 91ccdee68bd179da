// Numbers as text, on all threads: parts that begin and end between words are read into values of their own, which
// are put together in the order of the file.
#include <fast_float/fast_float.h>

#include <charconv>
#include <cmath>
#include <span>
#include <type_traits>

#include "barycert/base/text.hpp"
#include "barycert/io/vtk/number_types.hpp"
#include "barycert/io/vtk/numbers.hpp"
#include "barycert/io/vtk/parallel.hpp"

namespace barycert::io {
namespace {

/// The number that a word writes, in the type it has in the file.
template <class T>
bool parse_word(std::string_view word, T& value) {
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

/// The number at `at`, behind which there is white space or the end; nullptr where a closer look is needed.
template <class T>
const char* quick_number(const char* at, const char* end, T& value) {
    const char* behind = nullptr;
    if constexpr (std::is_floating_point_v<T>) {
        const auto [next, error] = fast_float::from_chars(at, end, value);
        if (error != std::errc{} || !std::isfinite(value)) return nullptr;
        behind = next;
    } else {
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc{}) return nullptr;
        behind = next;
    }
    return behind == end || is_white(*behind) ? behind : nullptr;
}

/// Up to `count` numbers of one part of the text.
template <class From, class To>
struct TextPart {
    std::vector<To> values;
    NumberFault fault;  // its index counts from the first number of the part
    const char* end = nullptr;

    void read(std::string_view text, std::size_t count) {
        values.clear();
        fault = {};
        const char* at = text.data();
        const char* const last = at + text.size();
        while (values.size() < count) {
            while (at != last && is_white(*at)) ++at;
            if (at == last) break;
            From from{};
            const char* behind = quick_number(at, last, from);
            if (behind == nullptr) {
                std::string_view rest(at, static_cast<std::size_t>(last - at));
                const std::string_view word = next_word(rest);
                if (!parse_word(word, from)) {
                    fault = {NumberFault::Kind::no_number, values.size(), std::string(word.substr(0, 40))};
                    break;
                }
                behind = at + word.size();
            }
            To to{};
            if (!convert_number(from, to) && !fault) {
                const std::string_view word(at, static_cast<std::size_t>(behind - at));
                fault = {NumberFault::Kind::not_exact, values.size(), std::string(word.substr(0, 40))};
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

template <class From, class To>
NumberFault read_words(std::string_view& text, std::size_t count, std::vector<To>& values) {
    NumberFault fault;
    constexpr std::size_t most = 64;
    std::vector<TextPart<From, To>> read(1);
    for (std::size_t done = 0; done < count;) {
        // Few numbers take more than 32 bytes: text far behind the last one is not looked at.
        const std::size_t left = count - done;
        const std::vector<std::string_view> parts = parts_of(text, std::min(most, left / (part_bytes / 32) + 1));
        if (parts.empty()) return {NumberFault::Kind::too_few, done, {}};
        if (read.size() < parts.size()) read.resize(parts.size());
        in_parallel(parts.size(), [&](std::size_t i) { read[i].read(parts[i], left); });
        std::vector<std::size_t> places, taken;
        std::size_t size = values.size();
        bool ended = false;
        for (std::size_t i = 0; i < parts.size() && !ended; ++i) {
            TextPart<From, To>& part = read[i];
            const std::size_t wanted = count - done;
            const bool no_number = part.fault.kind == NumberFault::Kind::no_number;
            if (part.values.size() > wanted || (part.values.size() == wanted && no_number)) {
                part.read(parts[i], wanted);  // what follows are other words
            }
            if (part.fault && (!fault || part.fault.kind == NumberFault::Kind::no_number)) {
                fault = part.fault;
                fault.index += done;
                if (fault.kind == NumberFault::Kind::no_number) return fault;
            }
            places.push_back(size);
            taken.push_back(part.values.size());
            size += part.values.size();
            done += part.values.size();
            text.remove_prefix(static_cast<std::size_t>(part.end - text.data()));
            ended = done == count;
        }
        make_room(values, size - values.size());
        values.resize(size);
        in_parallel(places.size(),
                    [&](std::size_t i) { std::copy_n(read[i].values.data(), taken[i], values.data() + places[i]); });
    }
    return fault;
}

}  // namespace

template <class To>
NumberFault read_text(std::string_view& text, NumberType type, std::size_t count, std::vector<To>& values) {
    return with_number_type(type, [&]<class From>() { return read_words<From>(text, count, values); });
}

template NumberFault read_text(std::string_view&, NumberType, std::size_t, std::vector<double>&);
template NumberFault read_text(std::string_view&, NumberType, std::size_t, std::vector<std::int64_t>&);
template NumberFault read_text(std::string_view&, NumberType, std::size_t, std::vector<std::int32_t>&);
template NumberFault read_text(std::string_view&, NumberType, std::size_t, std::vector<std::uint8_t>&);

}  // namespace barycert::io

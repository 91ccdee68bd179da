#include "barycert/io/vtk/legacy_text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <utility>

#include "barycert/base/input_file.hpp"

namespace barycert::io {
namespace {

constexpr const char* cut_off = "write the file again: it may be cut off";
constexpr bool swap_bytes = std::endian::native == std::endian::little;

std::string capitals(std::string_view word) {
    std::string text(word);
    for (char& c : text) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return text;
}

/// An error shows no more of a file than tells what it is about.
std::string shown(std::string_view word) {
    return in_quotes(word.substr(0, 60));
}

/// %20 and the like are one byte.
std::string decoded(std::string_view word) {
    std::string text;
    for (std::size_t i = 0; i < word.size(); ++i) {
        unsigned code = 0;
        if (word[i] == '%' && i + 2 < word.size() &&
            std::from_chars(&word[i + 1], &word[i + 1] + 2, code, 16).ptr == &word[i + 1] + 2) {
            text += static_cast<char>(code);
            i += 2;
        } else {
            text += word[i];
        }
    }
    return text;
}

}  // namespace

Error LegacyText::error(std::string what, std::string expected, std::string found, std::string remedy) const {
    return {.what = std::move(what),
            .file = *path_,
            .line = line_of(rest_),
            .expected = std::move(expected),
            .found = std::move(found),
            .remedy = std::move(remedy)};
}

std::size_t LegacyText::line_of(std::string_view rest) const {
    if (binary_) return 0;  // numbers hold line breaks by chance
    const std::string_view before = bytes_.substr(0, bytes_.size() - rest.size());
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

Status LegacyText::read_head() {
    constexpr std::string_view start = "# vtk DataFile Version ";
    const std::string_view all = rest_;
    std::string_view first = rest_of_line();
    const bool known = capitals(first.substr(0, start.size())) == capitals(start);
    if (known) first.remove_prefix(start.size());
    const char* const end = first.data() + first.size();
    if (!known || std::from_chars(first.data(), end, major_version_).ec != std::errc{}) {
        rest_ = all;  // of the line itself, not of the next one
        return error("the first line", "\"# vtk DataFile Version 4.2\" or the like", shown(first));
    }
    rest_of_line();  // title
    const std::string type = keyword();
    if (type != "ASCII" && type != "BINARY") return error("the third line", "ASCII or BINARY", shown(type));
    binary_ = type == "BINARY";
    return Done{};
}

std::string LegacyText::word() {
    return std::string(next_word(rest_));
}

std::string LegacyText::keyword() {
    return capitals(next_word(rest_));
}

std::string LegacyText::name() {
    return decoded(next_word(rest_));
}

std::string_view LegacyText::rest_of_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
}

Status LegacyText::expect(const char* wanted) {
    const std::string found = keyword();
    if (found == wanted) return Done{};
    return error("a keyword of the format", wanted, shown(found));
}

Status LegacyText::skip_line() {
    rest_of_line();
    return Done{};
}

Status LegacyText::skip_metadata() {
    rest_of_line();
    while (!rest_.empty() && !rest_of_line().empty()) {
    }
    return Done{};
}

Result<std::size_t> LegacyText::count(const std::string& what) {
    const std::string_view word = next_word(rest_);
    const std::optional<std::uint64_t> value = parse_count(word);
    if (value.has_value() && *value <= max_entities) return static_cast<std::size_t>(*value);
    return error(what, "a count up to " + std::to_string(max_entities),
                 word.empty() ? "the end of the file" : shown(word));
}

std::optional<NumberType> LegacyText::number_type_named(std::string_view name) {
    // vtkIdType is written with 32 bits; long has 64 where this library runs.
    constexpr std::array<std::pair<std::string_view, NumberType>, 18> names{{{"BIT", NumberType::bit},
                                                                             {"CHAR", NumberType::int8},
                                                                             {"SIGNED_CHAR", NumberType::int8},
                                                                             {"UNSIGNED_CHAR", NumberType::uint8},
                                                                             {"SHORT", NumberType::int16},
                                                                             {"UNSIGNED_SHORT", NumberType::uint16},
                                                                             {"VTKIDTYPE", NumberType::int32},
                                                                             {"INT", NumberType::int32},
                                                                             {"UNSIGNED_INT", NumberType::uint32},
                                                                             {"LONG", NumberType::int64},
                                                                             {"UNSIGNED_LONG", NumberType::uint64},
                                                                             {"VTKTYPEINT64", NumberType::int64},
                                                                             {"VTKTYPEUINT64", NumberType::uint64},
                                                                             {"LONG_LONG", NumberType::int64},
                                                                             {"UNSIGNED_LONG_LONG", NumberType::uint64},
                                                                             {"FLOAT", NumberType::float32},
                                                                             {"DOUBLE", NumberType::float64},
                                                                             {"__INT64", NumberType::int64}}};
    const std::string wanted = capitals(name);
    for (const auto& [known, type] : names) {
        if (wanted == known) return type;
    }
    return std::nullopt;
}

bool LegacyText::is_text(std::string_view type) {
    const std::string wanted = capitals(type);
    return wanted == "STRING" || wanted == "UTF8_STRING" || wanted == "VARIANT";
}

Result<NumberType> LegacyText::number_type(const std::string& what) {
    const std::string_view word = next_word(rest_);
    if (const std::optional<NumberType> type = number_type_named(word); type.has_value()) return *type;
    return error("the type of " + what, "double, float, int and the like", shown(word));
}

template <class To>
Status LegacyText::numbers(const std::string& what, NumberType type, std::uint64_t count, std::vector<To>& values,
                           NumberFault* fault) {
    const std::string_view start = rest_;
    NumberFault found;
    if (!binary_) {
        found = read_text(rest_, type, static_cast<std::size_t>(count), values);
        constexpr std::string_view white = " \t\n\v\f\r";
        if (!found && count != 0 && rest_.empty() && white.find(bytes_.back()) == std::string_view::npos) {
            return base::unended_number(*path_, line_of(rest_));
        }
    } else {
        rest_of_line();
        const std::optional<std::uint64_t> size = byte_count(type, count);
        if (!size.has_value() || *size > rest_.size()) {
            return error(what, std::to_string(count) + " numbers", "the end of the file before that", cut_off);
        }
        const std::string_view bytes = rest_.substr(0, static_cast<std::size_t>(*size));
        rest_.remove_prefix(bytes.size());
        found = read_binary(bytes, type, swap_bytes, static_cast<std::size_t>(count), values);
    }
    if (fault != nullptr && found.kind == NumberFault::Kind::not_exact) {
        *fault = std::move(found);
    } else if (found) {
        return number_error(*path_, line_of(start), what, count, found);
    }
    return Done{};
}

Status LegacyText::colors(const std::string& what, std::uint64_t count, std::vector<double>& values) {
    if (binary_) return numbers(what, NumberType::uint8, count, values);
    if (Status s = numbers(what, NumberType::float32, count, values); !s) return s;
    for (double& value : values) {
        if (!(value >= 0 && value <= 1)) return error(what, "shares from 0 to 1", std::to_string(value));
        value = std::floor(255 * value + 0.5);
    }
    return Done{};
}

Status LegacyText::skip_colors(std::uint64_t count) {
    std::vector<double> unused;
    return colors("a lookup table", count, unused);
}

Status LegacyText::strings(const std::string& what, std::string_view type, std::uint64_t count,
                           std::vector<std::string>* texts) {
    rest_of_line();
    for (std::uint64_t i = 0; i < count; ++i) {
        if (rest_.empty()) return error(what, std::to_string(count) + " strings", std::to_string(i), cut_off);
        if (!binary_ || capitals(type) == "VARIANT") {
            const std::string_view text = rest_of_line();
            if (texts != nullptr) texts->push_back(decoded(text));
            continue;
        }
        // The two highest bits say how many bytes the length takes: 8, 4, 2 or 1.
        const auto lead = static_cast<unsigned char>(rest_.front());
        const std::size_t width = std::size_t{8} >> (lead >> 6U);
        if (rest_.size() < width) return error(what, "the length of a string", "the end of the file", cut_off);
        std::uint64_t length = lead & 0x3FU;
        for (std::size_t k = 1; k < width; ++k) length = length << 8U | static_cast<unsigned char>(rest_[k]);
        rest_.remove_prefix(width);
        if (length > rest_.size())
            return error(what, "a string of " + std::to_string(length) + " bytes", "less", cut_off);
        if (texts != nullptr) texts->emplace_back(rest_.substr(0, static_cast<std::size_t>(length)));
        rest_.remove_prefix(static_cast<std::size_t>(length));
    }
    return Done{};
}

template Status LegacyText::numbers(const std::string&, NumberType, std::uint64_t, std::vector<double>&, NumberFault*);
template Status LegacyText::numbers(const std::string&, NumberType, std::uint64_t, std::vector<std::int64_t>&,
                                    NumberFault*);
template Status LegacyText::numbers(const std::string&, NumberType, std::uint64_t, std::vector<std::int32_t>&,
                                    NumberFault*);
template Status LegacyText::numbers(const std::string&, NumberType, std::uint64_t, std::vector<std::uint8_t>&,
                                    NumberFault*);

}  // namespace barycert::io

/// Words and numbers of VTK's legacy files.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/paths.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/raw_grid.hpp"
#include "io/words.hpp"

namespace barycert::io {

inline std::string capitals(std::string_view word) {
    std::string text(word);
    for (char& c : text) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return text;
}

/// An error shows no more of a file than tells what it is about.
inline std::string shown(std::string_view word) {
    return in_quotes(word.substr(0, 60));
}

/// %20 and the like are one byte.
inline std::string decoded(std::string_view word) {
    std::string text;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const std::string_view digits = word[i] == '%' && i + 2 < word.size() ? word.substr(i + 1, 2) : "";
        const std::optional<std::uint8_t> byte = whole_number<std::uint8_t, 16>(digits);
        text += byte ? static_cast<char>(*byte) : word[i];
        if (byte) i += 2;
    }
    return text;
}

/// A place in a legacy file: words; in a binary file big-endian numbers behind the line that announces an array.
class LegacyText {
public:
    LegacyText(std::string_view bytes, const std::string& path) : file_{bytes, path}, rest_(bytes) {}

    /// The first three lines: version, title, ASCII or BINARY.
    void read_head() {
        constexpr std::string_view start = "# vtk DataFile Version ";
        const std::string_view all = rest_;
        std::string_view first = rest_of_line();
        const bool known = capitals(first.substr(0, start.size())) == capitals(start);
        if (known) first.remove_prefix(start.size());
        const std::string_view shown_first = first, version = next_word(first);
        const std::size_t dot = version.find('.');
        const std::optional<int> major = whole_number<int>(version.substr(0, dot));
        const bool minor = dot == std::string_view::npos || whole_number<unsigned>(version.substr(dot + 1));
        if (!known || !major || !minor || !next_word(first).empty()) {
            rest_ = all;  // of the line itself, not of the next one
            fail("file.format", "the first line", "\"# vtk DataFile Version 4.2\" or the like", shown(shown_first));
        }
        major_version_ = *major;
        rest_of_line();  // title
        const std::string type = take_keyword();
        if (type != "ASCII" && type != "BINARY") fail("file.syntax", "the third line", "ASCII or BINARY", shown(type));
        file_.has_lines = type == "ASCII";
    }
    bool binary() const { return !file_.has_lines; }

    std::string take_word() { return std::string(next_word(rest_)); }
    /// The next word in capitals, as which keywords are compared.
    std::string take_keyword() { return capitals(next_word(rest_)); }
    bool take(std::string_view wanted) {
        std::string_view rest = rest_;
        const bool found = capitals(next_word(rest)) == wanted;
        if (found) rest_ = rest;
        return found;
    }
    std::string take_name() { return decoded(next_word(rest_)); }
    /// Takes the rest of the line, and its end.
    std::string_view rest_of_line() {
        std::string_view text = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(std::min(text.size() + 1, rest_.size()));
        if (text.ends_with('\r')) text.remove_suffix(1);
        return text;
    }
    /// Nothing may stand between what announces numbers and their bytes.
    void end_line(const std::string& what) {
        const std::string_view more = rest_of_line();
        if (more.find_first_not_of(" \t") != std::string_view::npos)
            fail("file.syntax", "the line before " + what, "its end", shown(more));
    }
    void expect(const char* wanted) {
        const std::string found = take_keyword();
        if (found != wanted) fail("file.syntax", "a keyword of the format", wanted, shown(found));
    }
    void skip_metadata() {
        rest_of_line();
        while (!rest_.empty() && !rest_of_line().empty()) {
        }
    }

    /// The next word as a count, at most that of entities in a mesh.
    std::size_t take_count(const std::string& what) {
        const std::string_view word = next_word(rest_);
        const std::optional<std::uint64_t> value = parse_count(word);
        if (!value || *value > max_entities)
            fail("file.count", what, "a count up to " + std::to_string(max_entities),
                 word.empty() ? "the end of the file" : shown(word));
        return static_cast<std::size_t>(*value);
    }
    NumberType take_type(const std::string& what) {
        const std::string_view word = next_word(rest_);
        const std::optional<NumberType> type = type_of_name(capitals(word));
        if (!type || type == NumberType::text)
            fail("file.number", "the type of " + what, "double, float, int and the like", shown(word));
        return *type;
    }

    /// Exactly `count` numbers; `inexact` as in FileText::check.
    void take_numbers(const std::string& what, NumberType type, std::uint64_t count, NumbersTo values,
                      NumberFault* inexact = nullptr) {
        const char* const begin = rest_.data();
        if (!binary()) {
            NumberFault fault = read_text(rest_, type, static_cast<std::size_t>(count), values);
            if (!fault && count != 0 && rest_.empty() && !is_white(file_.bytes.back()))
                throw Exception(base::unended_number(file_.path, line_of(file_.bytes, rest_.data())));
            return file_.check(std::move(fault), begin, what, count, inexact);
        }
        end_line(what);
        const std::optional<std::uint64_t> size = byte_count(type, count);
        if (!size || *size > rest_.size())
            fail("file.truncated", what, std::to_string(count) + " numbers", "the end of the file before that",
                 cut_off);
        constexpr bool swap = std::endian::native == std::endian::little;
        file_.check(read_binary(take_bytes(*size), type, swap, static_cast<std::size_t>(count), values), begin, what,
                    count, inexact);
    }
    /// Bytes 0 to 255, which in an ASCII file are written as shares of 255.
    void take_colors(const std::string& what, std::uint64_t count, std::vector<double>& values) {
        take_numbers(what, binary() ? NumberType::uint8 : NumberType::float32, count, values);
        if (binary()) return;
        for (double& value : values) {
            if (!(value >= 0 && value <= 1)) fail("file.number", what, "shares from 0 to 1", std::to_string(value));
            value = std::floor(255 * value + 0.5);
        }
    }
    /// Strings of an array: lines, or in a binary file, but for variants (`in_lines`), lengths and bytes.
    void take_strings(const std::string& what, bool in_lines, std::uint64_t count, std::vector<std::string>* texts) {
        rest_of_line();
        for (std::uint64_t i = 0; i < count; ++i) {
            if (rest_.empty())
                fail("file.truncated", what, std::to_string(count) + " strings", std::to_string(i), cut_off);
            const bool line = !binary() || in_lines;
            const std::string_view text = line ? rest_of_line() : counted_string(what);
            if (texts != nullptr) texts->push_back(line ? decoded(text) : std::string(text));
        }
    }

    [[noreturn]] void fail(ErrorCode code, std::string what, std::string expected, std::string found,
                           std::string remedy = {}) const {
        file_.refuse(code, rest_.data(), std::move(what), std::move(expected), std::move(found), std::move(remedy));
    }

protected:
    std::string_view counted_string(const std::string& what) {
        // The two highest bits say how many bytes the length takes: 8, 4, 2 or 1.
        const auto lead = static_cast<unsigned char>(rest_.front());
        const std::size_t width = std::size_t{8} >> (lead >> 6U);
        if (rest_.size() < width)
            fail("file.truncated", what, "the length of a string", "the end of the file", cut_off);
        std::uint64_t length = lead & 0x3FU;
        for (std::size_t k = 1; k < width; ++k) length = length << 8U | static_cast<unsigned char>(rest_[k]);
        rest_.remove_prefix(width);
        if (length > rest_.size())
            fail("file.truncated", what, "a string of " + std::to_string(length) + " bytes", "less", cut_off);
        return take_bytes(length);
    }

    std::string_view take_bytes(std::uint64_t count) {
        const std::string_view bytes = rest_.substr(0, static_cast<std::size_t>(count));
        rest_.remove_prefix(bytes.size());
        return bytes;
    }

    FileText file_;
    std::string_view rest_;  ///< what is left of the file
    int major_version_ = 0;
};

}  // namespace barycert::io

// Rows of CSV: what they say, and why they are refused, in words.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/csv/csv_layout.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/streams.hpp"
#include "barycert/io/tetgen/scanner.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::io {
namespace {

struct Complaint {
    std::string expected;
    std::string remedy;
};

/// Digits, and nothing but digits and `also`.
bool only_digits_and(std::string_view text, std::string_view also) {
    return std::any_of(text.begin(), text.end(), is_digit) && std::all_of(text.begin(), text.end(), [&](char c) {
               return is_digit(c) || also.find(c) != std::string_view::npos;
           });
}

Complaint about_coordinate(std::string_view field, char separator) {
    if (field.empty()) return {"a number", std::string("fill it in, or remove the line") + or_nan_for_it};
    if (only_digits_and(field, ".eE+-") && std::count(field.begin(), field.end(), '.') < 2) {
        // A number in form: either it overflows, or its signs and exponent are askew.
        return {"a number that a double can hold", "check the number: the largest double is near 1.8e308"};
    }
    if (only_digits_and(field, ".,eE+-") && field.find(',') != std::string_view::npos)
        return {"a number", "write it with a decimal point, not a comma"};
    if (only_digits_and(field, ".dD+-")) return {"a number", "write the exponent with e"};
    std::string word(field.substr(field.find_first_not_of("+-") == 1 ? 1 : 0, 3));
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (word == "nan" || word == "inf")
        return {"a finite number", std::string("remove the point, give it coordinates") + or_nan_for_it};
    if (field.find('\r') != std::string_view::npos)
        return {"a number", "end the lines with LF or CR LF, not with CR alone"};
    if (std::any_of(field.begin(), field.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 32 && c != '\t'; })) {
        return {"a number", "save the points as text: this looks like binary data"};
    }
    return {"a number", "separate the fields by " + separator_name(separator) +
                            " throughout, as in the first line; put # before lines that are no points"};
}

/// Why a value of a carried column is refused, if it is: the columns had their types from an earlier look at the file.
std::optional<Complaint> about_value(std::string_view field, Column::Type type) {
    const char* const remedy = "do not change the file while it is read";
    if (type == Column::Type::integer && !integer_of(field)) return Complaint{"an integer, as in a first pass", remedy};
    if (type == Column::Type::number && !number_of(field)) return Complaint{"a number, as in a first pass", remedy};
    return std::nullopt;
}

enum class Verdict : std::uint8_t { point, bad, cut };

/// Appends the value of a carried column; false if it is none of its type.
bool append_value(Column& column, const FieldCutter& cutter, std::string_view field) {
    if (auto* const texts = std::get_if<std::vector<std::string>>(&column.values)) {
        texts->push_back(cutter.text(field));
        return true;
    }
    if (auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values)) {
        const auto value = integer_of(field);
        if (value) integers->push_back(*value);
        return value.has_value();
    }
    const auto value = number_of(field);
    if (value) std::get<std::vector<double>>(column.values).push_back(*value);
    return value.has_value();
}

/// `whole`: the line has an end.
Verdict parse_line(std::string_view line, bool whole, const CsvLayout& layout, std::array<double, 3>& point,
                   std::vector<Column>& carried) {
    FieldCutter cutter(line, layout.separator);
    const char* const cut = whole ? nullptr : line.data() + line.size();
    bool at_cut = false;
    const std::size_t fields = layout.role_of.size();
    std::size_t i = 0;
    for (std::string_view field; cutter.next(field); ++i) {
        if (i == fields) return Verdict::bad;
        const int role = layout.role_of[i];
        const char* const end = field.data() + field.size();
        if (role == CsvLayout::must_be_empty && !field.empty()) return Verdict::bad;
        if (role < 0) continue;
        if (role >= CsvLayout::first_kept) {
            if (!append_value(carried[static_cast<std::size_t>(role - CsvLayout::first_kept)], cutter, field))
                return Verdict::bad;
            // A text may go on behind blanks, but not where these separate.
            at_cut = !whole && i + 1 == fields && !cutter.quoted() && (end == cut || layout.separator != ' ');
            continue;
        }
        double value = 0;
        if (!layout.coordinate(field, value)) return Verdict::bad;
        point[static_cast<std::size_t>(role)] = value;
        at_cut = end == cut;
    }
    if (i != fields || cutter.malformed()) return Verdict::bad;
    return at_cut ? Verdict::cut : Verdict::point;
}

/// The common case: nothing but numbers, each with the separator or the end of the line right behind it. Then
/// parse_line finds the same fields and the same values. False: nothing is known.
bool parse_plain(std::string_view line, const CsvLayout& layout, std::array<double, 3>& point) {
    const char* at = line.data();
    const char* const end = at + line.size();
    const std::size_t fields = layout.role_of.size();
    for (std::size_t i = 0; i < fields; ++i) {
        const int axis = layout.role_of[i];
        double value = 0;
        const char* const after = scan_real(at, end, value);
        if (after == nullptr) return false;
        if (i + 1 == fields ? after != end : after == end || *after != layout.separator) return false;
        if (axis >= 0) point[static_cast<std::size_t>(axis)] = value;
        at = after + 1;
    }
    return true;
}

void refuse(CsvPiece& piece, std::string_view line, bool cut, int dimension) {
    piece.failed = true;
    piece.bad = line;
    piece.cut = cut;
    // Some of its columns may have their value.
    for (Column& column : piece.carried)
        mesh::shrink(column, piece.points.size() / static_cast<std::size_t>(dimension));
}

}  // namespace

std::string separator_name(char separator) {
    switch (separator) {
        case ',':
            return "commas";
        case ';':
            return "semicolons";
        case '\t':
            return "tabs";
        default:
            return "blanks";
    }
}

Error csv_row_error(std::string_view line, const CsvLayout& layout, const LinePlace& place) {
    const auto refused = [&](std::string what, std::string expected, std::string found, std::string remedy) {
        return line_error(place.file, place.line, std::move(what), std::move(expected), std::move(found),
                          std::move(remedy));
    };
    FieldCutter cutter(line, layout.separator);
    std::size_t count = 0;
    for (std::string_view field; cutter.next(field); ++count) {
        if (count >= layout.role_of.size()) continue;
        const int role = layout.role_of[count];
        if (role == CsvLayout::must_be_empty && !field.empty())
            return refused("a value behind the last separator", "none, as in the first line", base::quoted(field),
                           "say which columns are the coordinates, such as options.columns 1,2,3");
        if (role < 0) continue;
        if (role >= CsvLayout::first_kept) {
            const ColumnFormat& column = layout.kept[static_cast<std::size_t>(role - CsvLayout::first_kept)];
            const std::optional<Complaint> c = about_value(field, column.type);
            if (c)
                return refused("bad value of column " + base::quoted(column.name), c->expected, base::quoted(field),
                               c->remedy);
            continue;
        }
        double value = 0;
        if (!layout.coordinate(field, value)) {
            const Complaint c = about_coordinate(field, layout.separator);
            return refused(std::string("bad coordinate ") + "xyz"[role], c.expected,
                           field.empty() ? "nothing" : base::quoted(field), c.remedy);
        }
        if (layout.flat && role == 2 && value != 0) return off_plane(place.file, place.line, "", base::quoted(field));
    }
    if (cutter.malformed())
        return refused("a quoted field is not closed", "a closing quote, and then a separator or the end of the line",
                       base::quoted(line), "close the quote on the same line; double the quotes inside");
    const std::size_t fields = layout.role_of.size();
    return refused(
        std::string("too ") + (count < fields ? "few" : "many") + " fields in a line",
        std::to_string(fields) + ", separated by " + separator_name(layout.separator) + ", as in the first line",
        std::to_string(count), "give every line the same columns; put fields that hold a separator in double quotes");
}

void parse_csv(std::string_view text, const CsvLayout& layout, int dimension, CsvPiece& piece) {
    piece.points.clear();
    piece.lines = 0;
    piece.failed = false;
    mesh::begin_columns(layout.kept, piece.carried);
    // Blanks come in runs.
    const bool may_be_plain = layout.plain && layout.separator != ' ';
    std::array<double, 3> point{};
    while (!text.empty()) {
        const void* const feed = std::memchr(text.data(), '\n', text.size());
        const std::size_t size =
            feed == nullptr ? text.size() : static_cast<std::size_t>(static_cast<const char*>(feed) - text.data());
        std::string_view line = text.substr(0, size);
        const bool whole = feed != nullptr || line.ends_with('\r');
        if (line.ends_with('\r')) line.remove_suffix(1);
        text.remove_prefix(feed == nullptr ? size : size + 1);
        ++piece.lines;
        if (!(may_be_plain && whole && parse_plain(line, layout, point))) {
            if (!holds_fields(line, layout.separator)) continue;
            const Verdict verdict = parse_line(line, whole, layout, point, piece.carried);
            if (verdict != Verdict::point) return refuse(piece, line, verdict == Verdict::cut, dimension);
        }
        if (layout.flat && point[2] != 0 && std::isfinite(point[0]) && std::isfinite(point[1]))
            return refuse(piece, line, false, dimension);
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
            piece.points.push_back(point[axis]);
    }
}

}  // namespace barycert::io

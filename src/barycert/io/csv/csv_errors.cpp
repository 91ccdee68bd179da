// Why a row of a CSV file is refused, in words.
#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/csv/csv_fields.hpp"
#include "barycert/io/csv/csv_layout.hpp"
#include "barycert/io/csv/csv_types.hpp"
#include "barycert/io/point_columns.hpp"
#include "barycert/io/tetgen/row_errors.hpp"
#include "barycert/io/tetgen/scanner.hpp"

namespace barycert::io {
namespace {

struct Complaint {
    std::string expected;
    std::string remedy;
};

/// Digits, and nothing but digits and `also`.
bool only_digits_and(std::string_view text, std::string_view also) {
    return std::any_of(text.begin(), text.end(), barycert::io::is_digit) &&
           std::all_of(text.begin(), text.end(),
                       [&](char c) { return barycert::io::is_digit(c) || also.find(c) != std::string_view::npos; });
}

Complaint about_coordinate(std::string_view field, char separator) {
    if (field.empty()) return {"a number", std::string("fill it in, or remove the line") + or_nan_for_it};
    if (only_digits_and(field, ".eE+-") && std::count(field.begin(), field.end(), '.') < 2) {
        // A number in form: either it overflows, or its signs and exponent are askew.
        return {"a number that a double can hold", "check the number: the largest double is near 1.8e308"};
    }
    if (only_digits_and(field, ".,eE+-") && field.find(',') != std::string_view::npos) {
        return {"a number", "write it with a decimal point, not a comma"};
    }
    if (only_digits_and(field, ".dD+-")) return {"a number", "write the exponent with e"};
    std::string word(field.substr(field.find_first_not_of("+-") == 1 ? 1 : 0, 3));
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (word == "nan" || word == "inf")
        return {"a finite number", std::string("remove the point, give it coordinates") + or_nan_for_it};
    if (field.find('\r') != std::string_view::npos) {
        return {"a number", "end the lines with LF or CR LF, not with CR alone"};
    }
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
    Error error{.file = place.file, .line = place.line};
    FieldCutter cutter(line, layout.separator);
    std::size_t count = 0;
    for (std::string_view field; cutter.next(field); ++count) {
        if (count >= layout.role_of.size()) continue;
        const int role = layout.role_of[count];
        if (role == CsvLayout::must_be_empty && !field.empty()) {
            error.what = "a value behind the last separator";
            error.expected = "none, as in the first line";
            error.found = base::quoted(field);
            error.remedy = "say which columns are the coordinates, such as --columns 1,2,3";
            return error;
        }
        if (role < 0) continue;
        if (role >= CsvLayout::first_kept) {
            const ColumnFormat& column = layout.kept[static_cast<std::size_t>(role - CsvLayout::first_kept)];
            std::optional<Complaint> complaint = about_value(field, column.type);
            if (!complaint) continue;
            error.what = "bad value of column " + base::quoted(column.name);
            error.expected = std::move(complaint->expected);
            error.found = base::quoted(field);
            error.remedy = std::move(complaint->remedy);
            return error;
        }
        double value = 0;
        if (layout.coordinate(field, value)) {
            if (layout.flat && role == 2 && value != 0)
                return off_plane(place.file, place.line, "", base::quoted(field));
            continue;
        }
        Complaint complaint = about_coordinate(field, layout.separator);
        error.what = std::string("bad coordinate ") + "xyz"[role];
        error.expected = std::move(complaint.expected);
        error.found = field.empty() ? "nothing" : base::quoted(field);
        error.remedy = std::move(complaint.remedy);
        return error;
    }
    if (cutter.malformed()) {
        error.what = "a quoted field is not closed";
        error.expected = "a closing quote, and then a separator or the end of the line";
        error.found = base::quoted(line);
        error.remedy = "close the quote on the same line; double the quotes inside";
        return error;
    }
    const std::size_t fields = layout.role_of.size();
    error.what = std::string("too ") + (count < fields ? "few" : "many") + " fields in a line";
    error.expected =
        std::to_string(fields) + ", separated by " + separator_name(layout.separator) + ", as in the first line";
    error.found = std::to_string(count);
    error.remedy = "give every line the same columns; put fields that hold a separator in double quotes";
    return error;
}

}  // namespace barycert::io

#include "io/csv/csv_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/paths.hpp"
#include "io/streams.hpp"
#include "io/tetgen/scanner.hpp"
#include "mesh/columns.hpp"

namespace barycert::io {
namespace {

/// The first of ; , tab outside quotes, by rank: a semicolon stands beside decimal commas, a comma beside blanks.
char separator_of(std::string_view line) {
    constexpr std::string_view ranked = ";,\t";
    std::size_t best = ranked.size();
    bool in_quotes = false;
    for (const char c : line) {
        if (c == '"') in_quotes = !in_quotes;
        if (!in_quotes) best = std::min(best, ranked.find(c));
    }
    return best < ranked.size() ? ranked[best] : ' ';
}

bool is_header(const TableColumns& all, int dimension, const PointOptions& options) {
    const std::vector<std::string> asked = parts_of(options.columns, static_cast<std::size_t>(dimension));
    if (asked.empty()) return find_coordinates(all, dimension) || std::ranges::none_of(all.names, looks_numeric);
    if (!are_places(asked)) return true;
    return std::none_of(asked.begin(), asked.end(), [&](const std::string& text) {
        const std::size_t place = *place_of(text);
        return place <= all.names.size() && looks_numeric(all.names[place - 1]);
    });
}

/// True if no double holds the decimal number: `value`, the nearest, written with as many digits, is another one.
bool is_rounded(std::string_view text, double value) {
    // A double holds 15 digits, unless it is subnormal, and has 767 at most.
    constexpr std::size_t held = 15, most = 767;
    const bool normal = std::fabs(value) >= std::numeric_limits<double>::min();
    if (normal && text.size() <= held) return false;
    const auto digits_of = [](std::string_view number) {
        number = number.substr(0, number.find_first_of("eE"));
        std::string digits;
        std::copy_if(number.begin(), number.end(), std::back_inserter(digits), is_digit);
        digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
        return digits.substr(0, digits.find_last_not_of('0') + 1);
    };
    const std::string digits = digits_of(text);
    if (digits.empty() || (normal && digits.size() <= held)) return false;
    if (digits.size() > most) return true;
    // fmt takes three times as long, or more; this is asked of most numbers of a column.
    std::array<char, 800> nearest{};
    const auto [end, error] = std::to_chars(nearest.data(), nearest.data() + nearest.size(), value,
                                            std::chars_format::scientific, static_cast<int>(digits.size()) - 1);
    return digits_of({nearest.data(), static_cast<std::size_t>(end - nearest.data())}) != digits;
}

// Rows: what they say, and why they are refused, in words.

[[noreturn]] void refuse_coordinate(std::string_view field, std::size_t axis, char separator) {
    const std::string what = std::string("bad coordinate ") + "xyz"[axis];
    if (field.empty())
        throw Exception(
            about(nonfinite_points, file_error("file.number", {}, what, "a number", "nothing",
                                               std::string("fill it in, or remove the line") + or_nan_for_it)));
    const Complaint c = about_real(field, std::string("remove the point, give it coordinates") + or_nan_for_it,
                                   "separate the fields by " + separator_name(separator) +
                                       " throughout, as in the first line; put # before lines that are no points");
    throw Exception(
        about(nonfinite_points, file_error("file.number", {}, what, c.expected, base::quoted(field), c.remedy)));
}

/// Appends the value of a carried column; false if it is none of its type.
bool append_value(Column& column, const FieldCutter& cutter, std::string_view field) {
    const auto append = [&]<class T>(std::vector<T>& values) {
        std::optional<T> value;
        if constexpr (std::is_same_v<T, std::string>) value = cutter.text(field);
        if constexpr (std::is_same_v<T, std::int64_t>) value = integer_of(field);
        if constexpr (std::is_same_v<T, double>) value = number_of(field);
        if (value) values.push_back(std::move(*value));
        return value.has_value();
    };
    return std::visit(append, column.values);
}

/// Beside a mesh in the plane. A point that is not finite anyway may lie anywhere.
bool is_off_plane(const CsvLayout& layout, const std::array<double, 3>& point) {
    return layout.flat && point[2] != 0 && std::isfinite(point[0]) && std::isfinite(point[1]);
}

/// `whole`: the line has an end. Errors lack file and number of the line.
void parse_line(std::string_view line, bool whole, const CsvLayout& layout, std::array<double, 3>& point,
                std::vector<Column>& carried) {
    FieldCutter cutter(line, layout.separator);
    const char* const file_end = whole ? nullptr : line.data() + line.size();
    bool at_cut = false;
    const std::size_t fields = layout.role_of.size();
    std::size_t i = 0;
    std::string_view height;
    for (std::string_view field; cutter.next(field); ++i) {
        if (i >= fields) continue;
        const int role = layout.role_of[i];
        const char* const end = field.data() + field.size();
        if (role == CsvLayout::must_be_empty && !field.empty())
            throw Exception(about("options.columns",
                                  file_error("file.syntax", {}, "a value after the last separator",
                                             "none, as in the first line", base::quoted(field),
                                             "say which columns are the coordinates, such as options.columns 1,2,3")));
        if (role < 0) continue;
        if (role >= CsvLayout::first_kept) {
            const auto k = static_cast<std::size_t>(role - CsvLayout::first_kept);
            const char* const kind = layout.kept[k].type == Column::Type::integer ? "an integer" : "a number";
            if (!append_value(carried[k], cutter, field))
                refuse_file("file.changed", {}, "bad value of column " + base::quoted(layout.kept[k].name),
                            std::string(kind) + ", as in a first pass", base::quoted(field),
                            "do not change the file while it is read");
            // A text may go on behind blanks, but not where these separate.
            at_cut = !whole && i + 1 == fields && !cutter.quoted() && (end == file_end || layout.separator != ' ');
            continue;
        }
        const auto axis = static_cast<std::size_t>(role);
        if (!layout.coordinate(field, point[axis])) refuse_coordinate(field, axis, layout.separator);
        if (axis == 2) height = field;
        at_cut = end == file_end;
    }
    check_cut(cutter, line, i, layout, {});
    if (at_cut) throw Exception(base::unended_number({}, 0));  // 0.2 may be the beginning of 0.25
    if (is_off_plane(layout, point)) refuse_off_plane({}, "", base::quoted(height));
}

/// The common case: numbers, the separator or line end right behind each; parse_line finds the same. False: not known.
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
    return !is_off_plane(layout, point);
}

}  // namespace

bool CsvLayout::coordinate(std::string_view field, double& value) const {
    const char* const end = field.data() + field.size();
    if (barycert::io::scan_real(field.data(), end, value) == end) return true;
    if (!any_point) return false;
    value = std::numeric_limits<double>::quiet_NaN();
    return field.empty() || barycert::io::scan_nonfinite(field.data(), end, value) == end;
}

bool looks_numeric(std::string_view field) {
    if (base::parse_double(field)) return true;
    if (field.starts_with('+') || field.starts_with('-')) field.remove_prefix(1);
    if (field.starts_with('.')) field.remove_prefix(1);
    return !field.empty() && barycert::io::is_digit(field.front());
}

CsvLine cut_first_line(std::string_view line, const LinePlace& place) {
    if (line.find('\r') != std::string_view::npos)
        refuse_line("file.encoding", place.file, place.line, "lines end with CR alone", "LF or CR LF", "CR alone",
                    "save the file with LF or CR LF as line ends");
    CsvLine out{.separator = separator_of(line)};
    FieldCutter cutter(line, out.separator);
    for (std::string_view field; cutter.next(field);) out.fields.push_back(cutter.name(field));
    check_cut(cutter, line, 0, {}, place);
    return out;
}

CsvLayout settle_csv_layout(std::string_view line, int dimension, const PointOptions& options, const LinePlace& place) {
    const CsvLine cut = cut_first_line(line, place);
    TableColumns all{.names = cut.fields, .named = true, .file = place.file, .line = place.line};
    CsvLayout layout;
    layout.separator = cut.separator;
    layout.header = all.named = is_header(all, dimension, options);
    layout.any_point = options.nonfinite_points == NonfinitePoints::nan;
    layout.role_of.assign(all.names.size(), CsvLayout::passed_over);
    if (!layout.header && options.columns.empty()) {
        // Where lines end with a separator, the field after it is empty in every line.
        const auto first = all.names.begin() + std::min<std::ptrdiff_t>(dimension, std::ssize(all.names));
        const bool none = std::all_of(first, all.names.end(), [](const std::string& name) { return name.empty(); });
        const auto empty = static_cast<std::size_t>(none ? all.names.end() - first : 0);
        all.names.resize(all.names.size() - empty);
        std::fill_n(layout.role_of.rbegin(), empty, CsvLayout::must_be_empty);
        layout.plain = empty == 0;
    }
    for (std::size_t i = 0; i < all.names.size(); ++i) {
        if (!layout.header || all.names[i].empty()) all.names[i] = column_number(i);
    }
    PointColumns columns = choose_columns(all, dimension, options);
    for (std::size_t axis = 0; axis < columns.axes.size(); ++axis)
        layout.role_of[columns.axes[axis]] = static_cast<int>(axis);
    if (columns.zero) layout.role_of[*columns.zero] = 2;
    layout.flat = columns.zero.has_value();
    for (PointColumns::Kept& kept : columns.kept) {
        layout.role_of[kept.column] = CsvLayout::first_kept + static_cast<int>(layout.kept.size());
        layout.kept.push_back({std::move(kept.name), Column::Type::text});
        layout.plain = false;
    }
    if (layout.separator != ',')
        layout.notes.push_back(
            {Note::Kind::guessed, "columns are separated by " + separator_name(layout.separator), all.file});
    if (!layout.header)
        layout.notes.push_back({Note::Kind::guessed, "there is no header: the first line is a point", all.file});
    layout.notes.insert(layout.notes.end(), columns.notes.begin(), columns.notes.end());
    return layout;
}

std::optional<std::int64_t> integer_of(std::string_view field) {
    const std::string_view digits = field.substr(field.starts_with('-') ? 1 : 0);
    if (digits.empty() || (digits.front() == '0' && field.size() != 1)) return std::nullopt;
    return whole_number<std::int64_t>(field);
}

std::optional<double> number_of(std::string_view field) {
    if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
    const std::string_view body = field.substr(field.starts_with('-') || field.starts_with('+') ? 1 : 0);
    if (body.size() > 1 && body.front() == '0' && (is_digit(body[1]) || body[1] == 'x' || body[1] == 'X'))
        return std::nullopt;
    const std::optional<double> value = base::parse_double(field);
    return value && is_inexact(field, *value) ? std::nullopt : value;
}

bool is_inexact(std::string_view text, double value) {
    if (std::fabs(value) < 0x1p53) return false;
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    if (text.find_first_not_of("0123456789") != std::string_view::npos) return false;
    text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
    // Every double from 2^53 on is an integer: the same one if it has the same digits.
    return fmt::format("{:.0f}", std::fabs(value)) != text;
}

void TypeOfTexts::see(std::string_view text) {
    if (text.empty()) {
        empty = true;
        return;
    }
    any = true;
    // An integer is a number, unless no double represents it.
    if (integers && !integer_of(text)) integers = false;
    if (!numbers) return;
    const std::optional<double> value = number_of(text);
    numbers = value.has_value();
    if (!numbers || !is_rounded(text, *value)) return;
    (*value == 0 ? lost : rounded) = true;
}

void check_cut(const FieldCutter& cutter, std::string_view line, std::size_t count, const CsvLayout& layout,
               const LinePlace& place) {
    if (cutter.malformed())
        refuse_line("file.syntax", place.file, place.line, "a quoted field is not closed",
                    "a closing quote, and then a separator or the end of the line", base::quoted(line),
                    "close the quote on the same line; double the quotes inside");
    const std::size_t fields = layout.role_of.size();
    // Twice as many or so: of each number a comma made two.
    const bool commas = layout.separator == ',' && count > fields;
    if (count != fields)
        refuse_line(
            "file.syntax", place.file, place.line,
            std::string("too ") + (count < fields ? "few" : "many") + " fields in a line",
            std::to_string(fields) + ", separated by " + separator_name(layout.separator) + ", as in the first line",
            std::to_string(count),
            std::string("give every line the same columns; put fields that hold a separator in double quotes") +
                (commas ? "; if commas are decimal ones, write points" : ""));
}

void parse_csv(std::string_view text, const CsvLayout& layout, int dimension, CsvPiece& piece) {
    piece.points.clear();
    piece.lines = 0;
    piece.fault.reset();
    mesh::begin_columns(layout.kept, piece.carried);
    const auto size = static_cast<std::size_t>(dimension);
    // Blanks come in runs.
    const bool may_be_plain = layout.plain && layout.separator != ' ';
    std::array<double, 3> point{};
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        const bool feed = line.size() != text.size(), whole = feed || line.ends_with('\r');
        text.remove_prefix(line.size() + (feed ? 1 : 0));
        if (line.ends_with('\r')) line.remove_suffix(1);
        ++piece.lines;
        if (!(may_be_plain && whole && parse_plain(line, layout, point))) {
            if (!holds_fields(line, layout.separator)) continue;
            try {
                parse_line(line, whole, layout, point, piece.carried);
            } catch (const Exception& problem) {
                piece.fault = problem.error();
                break;
            }
        }
        for (std::size_t axis = 0; axis < size; ++axis) piece.points.push_back(point[axis]);
    }
    // A bad line may have set the values of some columns.
    for (Column& column : piece.carried)
        std::visit([&](auto& values) { values.resize(piece.points.size() / size); }, column.values);
}

}  // namespace barycert::io

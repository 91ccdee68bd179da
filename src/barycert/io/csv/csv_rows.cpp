// Rows of CSV: what they say, and why they are refused, in words.
#include "barycert/io/csv/csv_layout.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/streams.hpp"
#include "barycert/io/tetgen/scanner.hpp"

namespace barycert::io {
namespace {

[[noreturn]] void refuse_coordinate(std::string_view field, std::size_t axis, char separator) {
    const std::string what = std::string("bad coordinate ") + "xyz"[axis];
    if (field.empty())
        refuse_file({}, what, "a number", "nothing", std::string("fill it in, or remove the line") + or_nan_for_it);
    const Complaint c = about_real(field, std::string("remove the point, give it coordinates") + or_nan_for_it,
                                   "separate the fields by " + separator_name(separator) +
                                       " throughout, as in the first line; put # before lines that are no points");
    refuse_file({}, what, c.expected, base::quoted(field), c.remedy);
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
            refuse_file({}, "a value after the last separator", "none, as in the first line", base::quoted(field),
                        "say which columns are the coordinates, such as options.columns 1,2,3");
        if (role < 0) continue;
        if (role >= CsvLayout::first_kept) {
            const auto k = static_cast<std::size_t>(role - CsvLayout::first_kept);
            const char* const kind = layout.kept[k].type == Column::Type::integer ? "an integer" : "a number";
            if (!append_value(carried[k], cutter, field))
                refuse_file({}, "bad value of column " + base::quoted(layout.kept[k].name),
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
    if (is_off_plane(layout, point)) throw Exception(off_plane({}, 0, "", base::quoted(height)));
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

void check_cut(const FieldCutter& cutter, std::string_view line, std::size_t count, const CsvLayout& layout,
               const LinePlace& place) {
    if (cutter.malformed())
        refuse_line(place.file, place.line, "a quoted field is not closed",
                    "a closing quote, and then a separator or the end of the line", base::quoted(line),
                    "close the quote on the same line; double the quotes inside");
    const std::size_t fields = layout.role_of.size();
    if (count != fields)
        refuse_line(
            place.file, place.line, std::string("too ") + (count < fields ? "few" : "many") + " fields in a line",
            std::to_string(fields) + ", separated by " + separator_name(layout.separator) + ", as in the first line",
            std::to_string(count),
            "give every line the same columns; put fields that hold a separator in double quotes");
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
    // Of a bad line some columns may have their value.
    for (Column& column : piece.carried)
        std::visit([&](auto& values) { values.resize(piece.points.size() / size); }, column.values);
}

}  // namespace barycert::io

#include "barycert/io/csv/csv_piece.hpp"

#include <array>
#include <cmath>
#include <cstring>

#include "barycert/io/csv/csv_fields.hpp"
#include "barycert/io/csv/csv_types.hpp"
#include "barycert/io/tetgen/scanner.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::io {
namespace {

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

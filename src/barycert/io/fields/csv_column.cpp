#include "barycert/io/fields/csv_column.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/csv/csv_fields.hpp"
#include "barycert/io/csv/csv_layout.hpp"
#include "barycert/io/csv/csv_types.hpp"
#include "barycert/io/csv/line_reader.hpp"
#include "barycert/io/point_columns.hpp"

namespace barycert::io {
namespace {

/// Which fields of a line are the components.
struct FieldLayout {
    CsvLayout lines;                   ///< no coordinates: role first_kept + c for the component c
    std::vector<std::size_t> columns;  ///< of each component
};

Result<FieldLayout> settle(std::string_view line, const std::string& column, const LinePlace& place) {
    const Result<CsvLine> cut = cut_first_line(line, place);
    if (!cut) return cut.error();
    FieldLayout out;
    out.lines.separator = cut->separator;
    out.lines.role_of.assign(cut->fields.size(), CsvLayout::passed_over);
    out.lines.header = true;
    if (are_places({column})) {
        std::size_t number = 0;
        std::from_chars(column.data(), column.data() + column.size(), number);
        if (number <= cut->fields.size()) {
            out.columns = {number - 1};
            out.lines.header = !looks_numeric(cut->fields[number - 1]);
        }
    } else {
        out.columns = columns_of_field(cut->fields, column);
    }
    if (!out.columns.empty()) return out;
    return Error{
        .what = "no such column",
        .file = place.file,
        .line = place.line,
        .expected = base::quoted(column),
        .found = listed(cut->fields),
        .remedy = base::did_you_mean(column, cut->fields, "name a column of the first line, or say its place, from 1")};
}

/// Appends the values of the line.
Status take_line(std::string_view line, bool whole, const FieldLayout& layout, const LinePlace& place, Field& field) {
    FieldCutter cutter(line, layout.lines.separator);
    std::size_t count = 0;
    bool cut = false;
    const std::size_t before = field.data.size();
    field.data.resize(before + layout.columns.size());
    for (std::string_view text; cutter.next(text); ++count) {
        for (std::size_t c = 0; c < layout.columns.size(); ++c) {
            if (layout.columns[c] != count) continue;
            const auto x = base::parse_double(text);
            if (!x || is_inexact(text, *x))
                return Error{.what = "a value of field \"" + field.name + '"',
                             .file = place.file,
                             .line = place.line,
                             .expected = x ? "an integer that a double holds exactly" : "a number",
                             .found = base::quoted(text),
                             .remedy = x ? "write it with a decimal point to round it" : "mend or remove the line"};
            field.data[before + c] = *x;
            cut = !whole && text.data() + text.size() == line.data() + line.size();
        }
    }
    if (cutter.malformed() || count != layout.lines.role_of.size()) return csv_row_error(line, layout.lines, place);
    if (cut) return base::unended_number(place.file, place.line);
    return Done{};
}

}  // namespace

std::vector<std::size_t> columns_of_field(const std::vector<std::string>& names, const std::string& name) {
    const auto place = [&](const std::string& one) {
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), one) - names.begin());
    };
    if (const std::size_t at = place(name); at != names.size()) return {at};
    std::vector<std::size_t> all;
    for (std::size_t at = 0; (at = place(name + "." + std::to_string(all.size()))) != names.size();) all.push_back(at);
    return all;
}

Result<Field> read_csv_column(Field field, const std::string& path, const std::string& column) {
    Result<LineReader> lines = LineReader::open(path);
    if (!lines) return lines.error();
    std::optional<FieldLayout> layout;
    for (std::string_view line; lines->next(line);) {
        if (!holds_fields(line, layout ? layout->lines.separator : ' ')) continue;
        const LinePlace place{lines->name(), lines->number()};
        if (!layout) {
            Result<FieldLayout> settled = settle(line, column, place);
            if (!settled) return settled.error();
            layout = std::move(*settled);
            if (layout->lines.header) continue;
        }
        if (Status taken = take_line(line, lines->line_ended(), *layout, place, field); !taken) {
            const Status same = lines->unchanged();
            return same ? taken.error() : same.error();
        }
    }
    if (lines->failed()) return lines->error();
    if (layout) field.components = static_cast<int>(layout->columns.size());
    return field;
}

}  // namespace barycert::io

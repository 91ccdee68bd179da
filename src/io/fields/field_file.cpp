#include "io/fields/field_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "io/csv/csv_layout.hpp"
#include "io/csv/line_reader.hpp"
#include "io/errors.hpp"
#include "io/npy/npy.hpp"
#include "io/paths.hpp"
#include "io/streams.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

/// The places of `name` among the names, or of NAME.0, NAME.1, ...; empty if there are none.
std::vector<std::size_t> columns_of_field(const std::vector<std::string>& names, const std::string& name) {
    const auto place = [&](const std::string& one) {
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), one) - names.begin());
    };
    if (const std::size_t at = place(name); at != names.size()) return {at};
    std::vector<std::size_t> all;
    for (std::size_t at = 0; (at = place(name + "." + std::to_string(all.size()))) != names.size();) all.push_back(at);
    return all;
}

/// The roles of the fields of a line: components, by their numbers, or passed over.
CsvLayout settle(std::string_view line, const std::string& column, const LinePlace& place, Field& field) {
    const CsvLine cut = cut_first_line(line, place);
    CsvLayout layout{.separator = cut.separator, .header = true};
    layout.role_of.assign(cut.fields.size(), CsvLayout::passed_over);
    std::vector<std::size_t> columns;
    const std::optional<std::size_t> number = place_of(column);
    if (!number) columns = columns_of_field(cut.fields, column);
    if (number && *number <= cut.fields.size()) {
        columns = {*number - 1};
        layout.header = !looks_numeric(cut.fields[*number - 1]);
    }
    field.components = static_cast<int>(columns.size());
    for (int c = 0; c < field.components; ++c) layout.role_of[columns[static_cast<std::size_t>(c)]] = c;
    if (!columns.empty()) return layout;
    refuse_line("column.unknown", place.file, place.line, "no such column", base::quoted(column), listed(cut.fields),
                base::did_you_mean(column, cut.fields, "name a column of the first line, or say its place, from 1"));
}

void take_line(std::string_view line, bool whole, const CsvLayout& layout, const LinePlace& place, Field& field) {
    FieldCutter cutter(line, layout.separator);
    std::size_t count = 0;
    bool cut = false;
    const std::size_t before = field.data.size();
    field.data.resize(before + static_cast<std::size_t>(field.components));
    for (std::string_view text; cutter.next(text); ++count) {
        const int component = count < layout.role_of.size() ? layout.role_of[count] : CsvLayout::passed_over;
        if (component < 0) continue;
        const auto x = base::parse_double(text);
        if (!x || is_inexact(text, *x))
            refuse_line("file.number", place.file, place.line, "a value of field \"" + field.name + '"',
                        x ? "an integer that a double holds exactly" : "a number", base::quoted(text),
                        x ? "write it with a decimal point to round it" : "mend or remove the line");
        field.data[before + static_cast<std::size_t>(component)] = *x;
        cut = !whole && text.data() + text.size() == line.data() + line.size();
    }
    check_cut(cutter, line, count, layout, place);
    if (cut) throw Exception(base::unended_number(place.file, place.line));
}

Field read_csv_column(Field field, const std::string& path, const std::string& column) {
    LineReader lines(path);
    std::optional<CsvLayout> layout;
    for (std::string_view line; lines.next(line);) {
        if (!holds_fields(line, layout ? layout->separator : ' ')) continue;
        const LinePlace place{lines.name(), lines.number()};
        if (!layout) {
            layout = settle(line, column, place, field);
            if (layout->header) continue;
        }
        try {
            take_line(line, lines.line_ended(), *layout, place, field);
        } catch (const Exception&) {
            lines.unchanged().value();
            throw;
        }
    }
    return field;
}

/// Whether commas part some words and blanks or semicolons others, as in `0,5 0,25`: then commas may be decimal ones.
bool has_mixed_separators(const std::vector<std::string_view>& words) {
    bool commas = false, others = false;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const char* const begin = words[i - 1].data() + words[i - 1].size();
        const bool comma = std::find(begin, words[i].data(), ',') != words[i].data();
        (comma ? commas : others) = true;
    }
    return commas && others;
}

Field read_text(Field field, const std::string& path, std::string_view bytes) {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    const char* const file_end = bytes.data() + bytes.size();
    std::size_t line_number = 0, components = 0;
    const auto refuse = [&](ErrorCode code, const std::string& expected, const std::string& found, const char* remedy) {
        refuse_line(code, path, line_number, "a row of field \"" + field.name + '"', expected, found, remedy);
    };
    while (!bytes.empty()) {
        const std::string_view line = bytes.substr(0, bytes.find('\n'));
        bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
        ++line_number;
        const std::vector<std::string_view> words = cut_fields(line.substr(0, line.find('#')), " \t\r", ",;");
        if (words.empty()) continue;
        if (has_mixed_separators(words))
            refuse("file.syntax", "one way to part numbers: blanks, commas or semicolons", base::quoted(line),
                   "if commas are decimal ones, write points");
        for (const std::string_view word : words) {
            const auto x = base::parse_double(word);
            if (!x || is_inexact(word, *x))
                refuse("file.number", x ? "an integer that a double holds exactly" : "numbers", base::quoted(word),
                       x ? "write it with a decimal point to round it"
                         : "write one row of numbers per node or cell; start header lines with #");
            if (word.data() + word.size() == file_end) throw Exception(base::unended_number(path, line_number));
            field.data.push_back(*x);
        }
        if (components == 0) components = words.size();
        if (words.size() != components)
            refuse("file.count", std::to_string(components) + " numbers, as in the first row",
                   std::to_string(words.size()), "rows have one number for each component of the field");
    }
    field.components = static_cast<int>(std::max<std::size_t>(components, 1));
    return field;
}

std::vector<std::size_t> components_of(const NpyTable& table, bool structured, const Field& field,
                                       const std::string& path, const std::string& column) {
    const std::vector<std::string> names = base::names_of(table.columns);
    std::vector<std::size_t> columns;
    if (!column.empty())
        columns = columns_of_field(names, place_of(column) && !structured ? "column" + column : column);
    for (std::size_t c = 0; column.empty() && !structured && c < names.size(); ++c) columns.push_back(c);
    if (!columns.empty()) return columns;
    refuse_file(column.empty() ? ErrorCode("field.type") : ErrorCode("column.unknown"), path,
                column.empty() ? "the type of field \"" + field.name + '"' : "no such column",
                column.empty() ? "an array of numbers" : base::quoted(column),
                structured && column.empty() ? "a structured array of " + listed(names) : listed(names),
                base::did_you_mean(column, names, "name one of them: --field " + field.name + "=" + path + ":NAME"));
}

Field read_npy(Field field, const std::string& path, const std::string& column, Notes& notes) {
    NpyFile file(path);
    const auto& shape = file.header().shape;
    constexpr std::uint64_t max_components = 1U << 16;
    if (!file.header().structured &&
        (shape.empty() || shape.size() > 2 || (shape.size() == 2 && (shape[1] < 1 || shape[1] > max_components))))
        refuse_file("field.size", path, "the shape of field \"" + field.name + '"', "(rows,) or (rows, components)",
                    as_tuple(shape), "save a.reshape(len(a), -1)");
    const NpyTable& table = file.make_table();
    const std::vector<std::size_t> columns = components_of(table, file.header().structured, field, path, column);
    for (const std::size_t c : columns) {
        const NpyType& type = table.columns[c].type;
        if (!type.is_number())
            refuse_file("field.type", path, "the type of field \"" + field.name + '"',
                        "floats of 2, 4 or 8 bytes, or integers", base::quoted(type.text), "save a.astype('f8')");
    }
    if (const NpyType& type = table.columns[columns.front()].type; !type.is_double())
        notes.push_back(
            {Note::Kind::converted, "field " + field.name + " of type " + type.text + " to double, exactly", path});
    const std::size_t components = columns.size(), at_once = file.rows_at_once();
    field.components = static_cast<int>(components);
    field.data.resize(table.rows * components);
    for (std::uint64_t row = 0; row < table.rows; row += at_once) {
        file.go_to(row, std::min<std::uint64_t>(at_once, table.rows - row));
        for (std::size_t c = 0; c < components; ++c)
            file.numbers(table.columns[columns[c]], "field \"" + field.name + '"',
                         field.data.data() + row * components + c, components);
    }
    return field;
}

/// The Error, with a column of the CSV file that might be meant.
Error with_columns(Error error, const std::string& name, const std::string& path, std::string_view bytes) {
    const std::string_view first = bytes.substr(0, bytes.find('\n'));
    CsvLine line;
    const Status cut = status_of([&] { line = cut_first_line(first.substr(0, first.find('\r')), {path, 1}); });
    if (!cut || line.fields.empty() || error.line != 1) return error;
    if (std::none_of(line.fields.begin(), line.fields.end(), looks_numeric))
        error.remedy = "name a column of the header: --field " + name + "=" + path + ":" + line.fields.front();
    return error;
}

}  // namespace

Result<Field> read_field_file(const std::string& name, const std::string& path, const std::string& column,
                              Notes& notes) {
    return read_guarded(path, [&]() -> Result<Field> {
        const Field field{.name = name, .components = 1, .data = {}};
        if (base::kind_of(path) == FormatKind::npy) return read_npy(field, path, column, notes);
        if (!column.empty()) return read_csv_column(field, path, column);
        const auto rows_in = [&](std::string_view bytes) {
            try {
                return read_text(field, path, bytes);
            } catch (const Exception& problem) {
                throw Exception(with_columns(problem.error(), name, path, bytes));
            }
        };
        const auto first_rows = [&](std::string_view block, std::uint64_t) {
            return status_of([&] { rows_in(block.substr(0, block.rfind('\n') + 1)); });
        };
        return rows_in(base::MappedFile::open(path, 1, base::Text::all, first_rows).value().bytes());
    });
}

}  // namespace barycert::io

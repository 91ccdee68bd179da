#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/paths.hpp"
#include "io/tetgen/scanner.hpp"
#include "io/tetgen/text_table.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

template <class... Parts>
[[noreturn]] void refuse_at(ErrorCode code, const TextTable& table, const char* at, Parts&&... parts) {
    refuse_line(code, table.file, line_of(table.bytes, at), std::forward<Parts>(parts)...);
}

/// "5 columns: id, 3 coordinates, 1 marker".
std::string described_columns(const TextTable& table) {
    const auto described = [](const Columns& columns) {
        if (columns.count == 0) return std::string();
        return columns.kind == ColumnKind::id ? columns.name : base::counted(columns.count, columns.name);
    };
    return base::counted(table.column_count(), "column") + ": " + base::joined(table.columns, ", ", described);
}

/// Digits, and nothing but digits and what else is allowed.
bool looks_like_number(std::string_view text, std::string_view also) {
    return std::any_of(text.begin(), text.end(), is_digit) &&
           std::ranges::all_of(text, [&](char c) { return is_digit(c) || also.find(c) != std::string_view::npos; });
}

std::string_view without_sign(std::string_view field) {
    if (!field.empty() && (field.front() == '+' || field.front() == '-')) field.remove_prefix(1);
    return field;
}

std::string about_separators(std::string_view field) {
    return field.find(';') == std::string_view::npos ? "" : "separate the columns by spaces, tabs or commas";
}

Complaint about_integer(std::string_view field) {
    const std::string_view body = without_sign(field);
    if (looks_like_number(body, "")) {
        if (body.front() == '0')
            return {"an integer without leading zeros", "write it without them: TetGen would read it as octal"};
        return {"an integer of at most 64 bits", "check the number"};
    }
    if (looks_like_number(body, ".eEdD+-")) return {"an integer", "write it without point and exponent"};
    return {"an integer", about_real(field, {}, about_separators(field)).remedy};
}

[[noreturn]] void refuse_id(const TextTable& table, std::string_view field, std::size_t row) {
    const std::string expected = std::to_string(table.base + static_cast<std::int64_t>(row));
    const std::string remedy =
        "number the rows without gaps: TetGen ignores the numbers and would silently take the rows as they come";
    if (row != 0)
        refuse_at("mesh.numbering", table, field.data(), "a row out of sequence", "row " + expected,
                  base::quoted(field), remedy);
    if (table.base_is_given && (field == "0" || field == "1"))
        refuse_at("mesh.numbering", table, field.data(), "the files of this mesh count from different bases",
                  "row " + expected + " first, as in the .node file", base::quoted(field),
                  "number all files from 0 or all from 1");
    refuse_at("mesh.numbering", table, field.data(), "a bad first row number",
              table.base_is_given ? expected : "0 or 1", base::quoted(field), remedy);
}

[[noreturn]] void refuse_index(const TextTable& table, const Columns& columns, std::string_view field) {
    const std::string last = std::to_string(columns.limit - 1 + table.base);
    std::string expected = columns.limit == 0
                               ? "none, for there are no " + columns.refers_to
                               : std::to_string(table.base) + " to " + last + " (" + columns.refers_to + ")";
    if (columns.kind == ColumnKind::neighbour) expected += ", or -1 for none";
    refuse_at("mesh.node-index", table, field.data(), columns.name + " out of range", expected, base::quoted(field),
              "check that the files belong together and count from the same base");
}

void check_field(const TextTable& table, const Columns& columns, std::string_view field, std::size_t row) {
    const char* const end = field.data() + field.size();
    if (field.empty())
        refuse_at("file.number", table, end, "bad " + columns.name, "a number before and after each comma", "nothing",
                  "fill in the missing number or remove the comma");
    const bool real = columns.kind == ColumnKind::real;
    std::int64_t value = 0;
    double number = 0;
    if ((real ? scan_real(field.data(), end, number) : scan_integer(field.data(), value)) != end) {
        const Complaint complaint =
            real ? about_real(field, table.finite_remedy, about_separators(field)) : about_integer(field);
        Error error = file_error("file.number", table.file, "bad " + columns.name, complaint.expected,
                                 base::quoted(field), complaint.remedy);
        error.line = line_of(table.bytes, end);
        throw Exception(about(table.finite_subject, std::move(error)));
    }
    if (columns.kind == ColumnKind::id && value != table.base + static_cast<std::int64_t>(row))
        refuse_id(table, field, row);
    const bool index = columns.kind == ColumnKind::index || (columns.kind == ColumnKind::neighbour && value != -1);
    if (index && (value < table.base || value - table.base >= columns.limit)) refuse_index(table, columns, field);
}

[[noreturn]] void refuse_column_count(const TextTable& table, const std::vector<std::string_view>& fields) {
    const std::size_t expected = table.column_count();
    const char* const at = fields.front().data();
    if (fields.size() < expected)
        refuse_at("file.count", table, at, "too few columns in a row", described_columns(table),
                  std::to_string(fields.size()),
                  "complete the row, or mend the header: it tells how many columns there are");
    const std::string found =
        std::to_string(fields.size()) + ", the first too many being " +
        (fields[expected].empty() ? "an empty one after a comma" : base::quoted(fields[expected]));
    // Commas part columns, and decimal ones make two of one.
    const char* const last = fields.back().data() + fields.back().size();
    const bool commas = std::find(at, last, ',') != last;
    refuse_at("file.count", table, at, "too many columns in a row", described_columns(table), found,
              table.surplus_remedy + (commas ? "; if commas are decimal ones, write points" : ""));
}

}  // namespace

Complaint about_real(std::string_view field, const std::string& finite, const std::string& separators) {
    const std::string_view body = without_sign(field);
    if (looks_like_number(body, ".eEdD+-") && body.find_first_of("dD") != std::string_view::npos)
        return {"a number", "write the exponent with e: programs in C stop reading at the d"};
    // A number in form: either it overflows, or its signs and exponent are askew.
    if (looks_like_number(body, ".eE+-") && std::count(body.begin(), body.end(), '.') < 2)
        return {"a number that a double can hold", "check the number: the largest double is near 1.8e308"};
    if (looks_like_number(body, ".,eE+-") && body.find(',') != std::string_view::npos)
        return {"a number", "write it with a decimal point, not a comma"};
    const std::string word = lower(body.substr(0, 3));
    if (word == "nan" || word == "inf") return {"a finite number", finite};
    if (field.find('\r') != std::string_view::npos)
        return {"a number", "end the lines with LF or CR LF, not with CR alone"};
    if (std::any_of(field.begin(), field.end(), [](char c) { return static_cast<unsigned char>(c) < 32 && c != '\t'; }))
        return {"a number", "save the file as text: this looks like binary data"};
    return {"a number", separators};
}

std::vector<std::string_view> fields_of_line(const TextTable& table, const char* at) {
    const std::string_view bytes = table.bytes;
    const auto place = static_cast<std::size_t>(at - bytes.data());
    std::size_t begin = place == 0 ? 0 : bytes.rfind('\n', place - 1) + 1;
    if (begin == 0 && bytes.starts_with("\xEF\xBB\xBF")) begin = 3;
    std::string_view line = bytes.substr(begin, bytes.find('\n', place) - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return cut_fields(line.substr(0, line.find('#')), " \t", ",");
}

void refuse_count(const TextTable& table, std::string_view field, const char* name) {
    if (field == "BIN")
        refuse_header("file.unsupported", table, "a binary file", "text", "\"BIN\" in the header",
                      "save the mesh as text: in Chaste, leave out SetWriteFilesAsBinary()");
    std::int64_t value = 0;
    const bool integer = scan_integer(field.data(), value) == field.data() + field.size();
    const Complaint complaint = integer ? Complaint{} : about_integer(field);
    std::string remedy = complaint.remedy;
    if (remedy.empty())
        remedy = integer ? "check the header" : "begin the file with its header; put # before any other text";
    const std::string expected = complaint.expected.find("zeros") != std::string::npos
                                     ? complaint.expected
                                     : "an integer from 0 to " + std::to_string(max_count);
    refuse_header("file.count", table, std::string("bad number of ") + name + " in the header", expected,
                  field.empty() ? "nothing" : base::quoted(field), remedy);
}

void refuse_row(const TextTable& table, const char* at, std::size_t row) {
    const std::vector<std::string_view> fields = fields_of_line(table, at);
    std::size_t i = 0;
    for (const Columns& columns : table.columns) {
        for (std::size_t k = 0; k < columns.count && i < fields.size(); ++k, ++i)
            check_field(table, columns, fields[i], row);
    }
    if (!fields.empty() && fields.size() != table.column_count()) refuse_column_count(table, fields);
    throw Exception(base::unended_number(table.file, line_of(table.bytes, at)));
}

void refuse_end(const TextTable& table, std::size_t found) {
    refuse_at("file.truncated", table, table.end(), "the file ends too early",
              base::counted(table.rows, "row") + " as the header tells", std::to_string(found),
              "the file may be cut short: write it again, or mend the header");
}

void refuse_surplus(const TextTable& table, const char* at) {
    const std::vector<std::string_view> fields = fields_of_line(table, at);
    const std::string_view field = fields.empty() ? std::string_view() : fields.front();
    std::int64_t value = 0;
    const bool another_row = scan_integer(at, value) == field.data() + field.size() &&
                             value == table.base + static_cast<std::int64_t>(table.rows);
    if (another_row)
        refuse_at("file.count", table, at, "more rows than the header tells", base::counted(table.rows, "row"),
                  "a row " + base::quoted(field), "mend the header or remove the row");
    refuse_at("file.syntax", table, at, "text after the last row", "the end of the file or a comment",
              base::quoted(field), "remove the text, put # before it, or mend the number of rows in the header");
}

}  // namespace barycert::io

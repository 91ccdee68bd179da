#include "barycert/io/csv/csv_layout.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "barycert/base/text.hpp"
#include "barycert/io/csv/csv_fields.hpp"
#include "barycert/io/tetgen/row_errors.hpp"
#include "barycert/io/tetgen/scanner.hpp"

namespace barycert::io {
namespace {

constexpr std::array<std::array<std::string_view, 3>, 3> coordinate_names{
    {{"x", "y", "z"}, {"points:0", "points:1", "points:2"}, {"points_0", "points_1", "points_2"}}};

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

/// Begins as numbers do, or is a word for one. What is meant as a number must not make its line a header.
bool looks_numeric(std::string_view field) {
    if (base::parse_double(field)) return true;
    if (field.starts_with('+') || field.starts_with('-')) field.remove_prefix(1);
    if (field.starts_with('.')) field.remove_prefix(1);
    return !field.empty() && barycert::io::is_digit(field.front());
}

bool same_but_for_case(std::string_view field, std::string_view lower) {
    return std::equal(field.begin(), field.end(), lower.begin(), lower.end(), [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b);
    });
}

std::string listed_names(int dimension) {
    return dimension == 2 ? "columns x, y (or Points:0, Points:1)"
                          : "columns x, y, z (or Points:0, Points:1, Points:2)";
}

std::string listed(const std::vector<std::string_view>& fields) {
    constexpr std::size_t max = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(max, fields.size()); ++i)
        text += (i != 0 ? ", " : "") + base::quoted(fields[i]);
    return text + (fields.size() > max ? ", ..." : "");
}

}  // namespace

bool holds_fields(std::string_view line, char separator) {
    const std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string_view::npos) return separator == '\t' && line.find('\t') != std::string_view::npos;
    return line[at] != '#';
}

Result<CsvLayout> settle_csv_layout(std::string_view line, int dimension, const LinePlace& place) {
    if (line.find('\r') != std::string_view::npos) {
        return Error{.what = "lines end with CR alone",
                     .file = place.file,
                     .line = place.line,
                     .expected = "LF or CR LF",
                     .found = "CR alone",
                     .remedy = "save the file with LF or CR LF as line ends"};
    }
    CsvLayout layout;
    layout.separator = separator_of(line);
    std::vector<std::string_view> fields;
    FieldCutter cutter(line, layout.separator);
    for (std::string_view field; cutter.next(field);) fields.push_back(field);
    if (cutter.malformed()) return csv_row_error(line, layout, place);

    const auto axes = static_cast<std::size_t>(dimension);
    for (const auto& names : coordinate_names) {
        layout.axis_of.assign(fields.size(), -1);
        std::size_t named = 0;
        for (std::size_t axis = 0; axis < axes; ++axis) {
            std::optional<std::size_t> at;
            for (std::size_t i = 0; i < fields.size(); ++i) {
                if (!same_but_for_case(fields[i], names[axis])) continue;
                if (at) {
                    return Error{.what = "two columns have the same name",
                                 .file = place.file,
                                 .line = place.line,
                                 .expected = "one column " + std::string(names[axis]),
                                 .found = base::quoted(fields[*at]) + " and " + base::quoted(fields[i]),
                                 .remedy = "rename the column that is not a coordinate"};
                }
                at = i;
            }
            if (!at) break;
            layout.axis_of[*at] = static_cast<int>(axis);
            ++named;
        }
        layout.header = named == axes;
        if (layout.header) return layout;
    }

    if (std::none_of(fields.begin(), fields.end(), looks_numeric)) {
        return Error{.what = "the header does not name the coordinates",
                     .file = place.file,
                     .line = place.line,
                     .expected = listed_names(dimension),
                     .found = listed(fields),
                     .remedy = "use these column names, or start the file with numbers"};
    }
    layout.axis_of.assign(fields.size(), -1);
    if (fields.size() < axes) {
        return Error{
            .what = "too few columns for a point",
            .file = place.file,
            .line = place.line,
            .expected =
                std::to_string(dimension) + " numbers, for the mesh is " + std::to_string(dimension) + "-dimensional",
            .found = listed(fields),
            .remedy = "write one point a line, its coordinates separated by commas, semicolons, tabs or blanks"};
    }
    for (std::size_t axis = 0; axis < axes; ++axis) layout.axis_of[axis] = static_cast<int>(axis);
    return layout;
}

}  // namespace barycert::io

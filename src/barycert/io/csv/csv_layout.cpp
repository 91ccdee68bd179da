#include "barycert/io/csv/csv_layout.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <iterator>
#include <limits>

#include "barycert/io/formats.hpp"
#include "barycert/io/streams.hpp"
#include "barycert/io/tetgen/scanner.hpp"

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
        refuse_line(place.file, place.line, "lines end with CR alone", "LF or CR LF", "CR alone",
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

}  // namespace barycert::io

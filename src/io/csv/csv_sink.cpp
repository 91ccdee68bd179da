#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "io/streams.hpp"

namespace barycert::io {
namespace {

/// The longest value is -2.2250738585072014e-308; and a comma or line end.
constexpr std::size_t longest_value = 24 + 1;

char* put(char* at, double x) {
    if (std::isnan(x)) [[unlikely]]
        x = std::fabs(x);  // its sign bit says nothing
    return std::to_chars(at, at + longest_value, x).ptr;
}

/// A name or text as a field of CSV takes this much at most.
std::size_t longest_field(std::string_view text) {
    return 2 * text.size() + 2 + 1;
}

char* put(char* at, std::string_view text) {
    // Else it would not be read as it is: the header settles the separator, and blanks around fields are passed over.
    const bool quotes = text.find_first_of(",;\"\r\n\t") != std::string_view::npos;
    if (!quotes && !text.starts_with(' ') && !text.ends_with(' ')) return std::copy(text.begin(), text.end(), at);
    *at++ = '"';
    for (const char c : text) {
        if (c == '"') *at++ = c;
        *at++ = c;
    }
    *at++ = '"';
    return at;
}

std::string as_field(const std::string& name) {
    std::string text(longest_field(name), '\0');
    text.resize(static_cast<std::size_t>(put(text.data(), name) - text.data()));
    return text;
}

template <std::signed_integral Integer>
char* put(char* at, Integer x) {
    return std::to_chars(at, at + longest_value, x).ptr;
}

char* put(char* at, Feature feature) {
    const std::string_view word = name(feature);
    return std::copy(word.begin(), word.end(), at);
}

class CsvSink final : public RowSink {
public:
    CsvSink(const std::string& path, const TableFormat& format) : RowSink(path, format) {
        std::string header = format_.dimension == 2 ? "x,y,cell,feature" : "x,y,z,cell,feature";
        for (const std::string& column : format_.columns()) header += ',' + as_field(column);
        if (format_.distances) header += ",distance";
        for (const ColumnFormat& column : format_.carried) header += ',' + as_field(column.name);
        file_.write(header + '\n');
        file_.status().value();
    }

private:
    std::size_t longest_row(const TableView& rows) const override {
        // The coordinates, the cell, the feature, the values and perhaps a distance.
        std::size_t size = longest_value * (static_cast<std::size_t>(format_.dimension) + 3 + columns_);
        for (const Column& column : rows.carried) {
            std::size_t longest = longest_value;
            if (const auto* const texts = std::get_if<std::vector<std::string>>(&column.values)) {
                for (const std::string& text : *texts) longest = std::max(longest, longest_field(text));
            }
            size += longest;
        }
        return size;
    }
    char* put_rows(const TableView& rows, std::size_t first, std::size_t last, char* at) const override {
        for (; first != last; ++first) {
            put_row(rows, first, [&](const auto& value, std::size_t) {
                at = put(at, value);
                *at++ = ',';
            });
            at[-1] = '\n';
        }
        return at;
    }
};

}  // namespace

std::unique_ptr<TableSink> open_csv_sink(const std::string& path, const TableFormat& format) {
    return std::make_unique<CsvSink>(path, format);
}

}  // namespace barycert::io

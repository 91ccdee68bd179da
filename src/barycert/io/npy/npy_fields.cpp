#include "barycert/io/npy/npy_fields.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::io {
namespace {

/// As a string of Python.
std::string as_literal(std::string_view name) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "'";
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '\'' || c == '\\') {
            text += {'\\', c};
        } else if (code < 32 || code == 127) {
            text += {'\\', 'x', digits[code >> 4], digits[code & 15]};
        } else {
            text += c;
        }
    }
    return text + "'";
}

/// NumPy has no texts of length zero that every function takes.
std::size_t length_of(const ColumnFormat& text) {
    return std::max<std::size_t>(1, text.max_characters != 0 ? text.max_characters : text.max_bytes);
}

std::string type_of(const ColumnFormat& column) {
    if (column.type == Column::Type::integer) return "<i8";
    if (column.type == Column::Type::number) return "<f8";
    return (column.max_characters != 0 ? "<U" : "|S") + std::to_string(length_of(column));
}

const char* fault_of(const std::string& name, std::set<std::string>& seen) {
    if (name.empty()) return "a name";
    if (mesh::count_characters(name) < 0) return "a name in UTF-8";
    if (!seen.insert(name).second)
        return "a name that differs from the others and from x, y, z, cell, feature, distance";
    return nullptr;
}

}  // namespace

std::size_t npy_size(const ColumnFormat& column) {
    if (column.type != Column::Type::text) return 8;
    return length_of(column) * (column.max_characters != 0 ? 4 : 1);
}

Result<NpyFields> npy_fields(const TableFormat& format, const std::string& path) {
    struct NpyColumn {
        std::string name;
        std::string type = "<f8";
    };
    std::vector<NpyColumn> fields{{"x"}, {"y"}};
    if (format.dimension == 3) fields.push_back({"z"});
    fields.push_back({"cell", "<i8"});
    fields.push_back({"feature", "|S8"});
    for (const std::string& column : format.columns()) fields.push_back({column});
    if (format.distances) fields.push_back({"distance"});

    NpyFields result{.descr = "[", .row_size = 8 * fields.size()};  // each has 8 bytes
    for (const ColumnFormat& column : format.carried) {
        fields.push_back({column.name, type_of(column)});
        result.carried.push_back(npy_size(column));
        result.row_size += result.carried.back();
    }
    std::set<std::string> seen;
    for (const NpyColumn& field : fields) {
        if (const char* const expected = fault_of(field.name, seen); expected != nullptr) {
            return Error{.what = "a column name is not allowed in an NPY file",
                         .file = path,
                         .expected = expected,
                         .found = base::quoted(field.name),
                         .remedy = "rename the field, leave it out, or write CSV"};
        }
        if (result.descr.size() > 1) result.descr += ", ";
        result.descr += "(" + as_literal(field.name) + ", '" + field.type + "')";
    }
    result.descr += "]";
    return result;
}

}  // namespace barycert::io

#include "barycert/io/npy/npy_fields.hpp"

#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/io/tetgen/row_errors.hpp"

namespace barycert::io {
namespace {

/// Well-formed UTF-8: no stray or missing continuation, no longer form than needed, no surrogate, nothing above
/// U+10FFFF.
bool is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i++]);
        if (lead < 0x80) continue;
        const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
        if (lead < 0xC2 || lead > 0xF4) return false;
        std::uint32_t code = lead & (0x3FU >> more);
        for (int k = 0; k < more; ++k, ++i) {
            if (i == text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return false;
            code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3FU);
        }
        if (more == 2 && (code < 0x800 || (code >= 0xD800 && code < 0xE000))) return false;
        if (more == 3 && (code < 0x10000 || code > 0x10FFFF)) return false;
    }
    return true;
}

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

const char* fault_of(const std::string& name, std::set<std::string>& seen) {
    if (name.empty()) return "a name";
    if (!is_utf8(name)) return "a name in UTF-8";
    if (!seen.insert(name).second)
        return "a name that differs from the others and from x, y, z, cell, feature, distance";
    return nullptr;
}

}  // namespace

Result<NpyFields> npy_fields(const TableFormat& format, const std::string& path) {
    struct NpyColumn {
        std::string name;
        const char* type = "<f8";
    };
    std::vector<NpyColumn> fields{{"x"}, {"y"}};
    if (format.dimension == 3) fields.push_back({"z"});
    fields.push_back({"cell", "<i8"});
    fields.push_back({"feature", "|S8"});
    for (const std::string& column : format.columns()) fields.push_back({column});
    if (format.distances) fields.push_back({"distance"});

    NpyFields result{.descr = "[", .row_size = 8 * fields.size()};  // each has 8 bytes
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

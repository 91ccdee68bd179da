#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/base/text.hpp"
#include "io/errors.hpp"
#include "io/npy/npy.hpp"
#include "io/npy/npy_rows.hpp"
#include "io/streams.hpp"
#include "mesh/columns.hpp"

namespace barycert::io {
namespace {

constexpr std::size_t feature_count = static_cast<std::size_t>(Feature::degenerate) + 1;

/// The longest feature of a row: interior.
constexpr std::size_t feature_size = 8;

std::string as_literal(std::string_view name) {
    std::string text = "'";
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '\'' || c == '\\') text += '\\';
        text += code < 32 || code == 127 ? fmt::format("\\x{:02x}", code) : std::string(1, c);
    }
    return text + "'";
}

NpyType type_of(const ColumnFormat& column) {
    if (column.type == Column::Type::integer) return {'i', 8, false, "<i8"};
    if (column.type == Column::Type::number) return {'f', 8, false, "<f8"};
    // NumPy has no texts of length zero that every function takes.
    const bool characters = column.max_characters != 0;
    const std::size_t length = std::max<std::size_t>(1, characters ? column.max_characters : column.max_bytes);
    if (characters) return {'U', 4 * length, false, "<U" + std::to_string(length)};
    return {'S', length, false, "|S" + std::to_string(length)};
}

char* put(char* at, std::uint64_t bits) {
    if constexpr (std::endian::native != std::endian::little) bits = __builtin_bswap64(bits);
    std::memcpy(at, &bits, sizeof bits);
    return at + sizeof bits;
}

bool holds(const NpyType& type, std::string_view text) {
    if (text.ends_with('\0')) return false;
    if (type.kind == 'S') return text.size() <= type.size;
    const std::ptrdiff_t count = mesh::count_characters(text);
    return count >= 0 && static_cast<std::size_t>(count) <= type.size / 4;
}

/// Writes the text, with zeros behind it; the place after it. Requires: it fits.
char* put(char* at, const NpyType& type, std::string_view text) {
    char* const end = at + type.size;
    if (type.kind == 'S') at = std::copy(text.begin(), text.end(), at);
    for (; type.kind == 'U' && !text.empty(); at += 4) {
        const auto [code, bytes] = base::first_character(text);
        text.remove_prefix(bytes);
        for (std::size_t i = 0; i < 4; ++i) at[i] = static_cast<char>(code >> 8 * i & 0xFFU);
    }
    std::fill(at, end, '\0');
    return end;
}

class NpySink final : public RowSink {
public:
    NpySink(const std::string& path, const TableFormat& format) : RowSink(path, format) {
        file_.status().value();
        if (!file_.can_replace())
            refuse_file("file.pipe", path_, "cannot write NPY to a pipe or device",
                        "a regular file: the number of rows is written into its header at the end", {},
                        "name a regular file, or write CSV");
        settle_types();
        for (std::size_t f = 0; f < features_.size(); ++f)
            name(static_cast<Feature>(f)).copy(features_[f].data(), feature_size);
        head_size_ = npy_header_of(types_, {UINT64_MAX}).size();
        if (head_size_ > longest_npy_text)
            refuse_file("file.too-large", path_, "too many columns for an NPY file",
                        "a header of at most " + std::to_string(longest_npy_text) + " bytes",
                        std::to_string(head_size_), "choose fewer fields, or write CSV");
        file_.write(npy_header_of(types_, {0}, head_size_));
        file_.status().value();
    }

    Status commit() override {
        file_.replace(0, npy_header_of(types_, {count_}, head_size_));
        return RowSink::commit();
    }
    Status write(const TableView& rows) override {
        Status written = RowSink::write(rows);
        if (written) count_ += rows.cells.size();
        return written;
    }

private:
    /// Error: an empty name, one that is not UTF-8, two that are alike.
    void settle_types() {
        using enum Column::Type;
        std::vector<ColumnFormat> fields{{"x", number}, {"y", number}};
        if (format_.dimension == 3) fields.push_back({"z", number});
        fields.push_back({"cell", integer});
        fields.push_back({"feature", text, feature_size});
        for (const std::string& column : format_.columns()) fields.push_back({column, number});
        if (format_.distances) fields.push_back({"distance", number});
        fields.insert(fields.end(), format_.carried.begin(), format_.carried.end());
        for (const ColumnFormat& column : format_.carried) carried_.push_back(type_of(column));
        std::set<std::string> seen;
        for (const ColumnFormat& field : fields) {
            const char* const expected =
                field.name.empty()                       ? "a name"
                : mesh::count_characters(field.name) < 0 ? "a name in UTF-8"
                : !seen.insert(field.name).second
                    ? "a name that differs from the others and from x, y, z, cell, feature, distance"
                    : nullptr;
            if (expected != nullptr)
                refuse_file("field.type", path_, "a column name is not allowed in an NPY file", expected,
                            base::quoted(field.name), "rename the field, leave it out, or write CSV");
            const NpyType type = type_of(field);
            row_size_ += type.size;
            types_ += (types_.empty() ? "[(" : ", (") + as_literal(field.name) + ", '" + type.text + "')";
        }
        types_ += "]";
    }

    Status check(const TableView& rows) const override {
        for (std::size_t k = 0; k < carried_.size(); ++k) {
            const auto* const texts = std::get_if<std::vector<std::string>>(&rows.carried[k].values);
            if (texts == nullptr) continue;
            const NpyType& type = carried_[k];
            for (const std::string& text : *texts) {
                if (holds(type, text)) continue;
                return file_error(
                    "column.type", path_,
                    "a text of column " + base::quoted(format_.carried[k].name) + " does not fit the file",
                    (type.kind == 'U' ? std::to_string(type.size / 4) + " characters of UTF-8"
                                      : std::to_string(type.size) + " bytes") +
                        " at most, as the column was told, and no zero byte at its end",
                    base::quoted(text), "write CSV");
            }
        }
        return Done{};
    }

    std::size_t longest_row(const TableView&) const override { return row_size_; }
    char* put_rows(const TableView& rows, std::size_t first, std::size_t last, char* at) const override {
        const auto put_one = [&]<class T>(const T& value, std::size_t k) {
            if constexpr (std::is_same_v<T, std::string>) {
                at = put(at, carried_[k], value);
            } else if constexpr (std::is_same_v<T, Feature>) {
                std::memcpy(at, features_[static_cast<std::size_t>(value)].data(), feature_size);
                at += feature_size;
            } else if constexpr (std::is_same_v<T, double>) {
                at = put(at, std::bit_cast<std::uint64_t>(value));
            } else {
                at = put(at, static_cast<std::uint64_t>(std::int64_t{value}));
            }
        };
        for (; first != last; ++first) put_row(rows, first, put_one);
        return at;
    }

    std::string types_;          // the descr of the header
    std::size_t head_size_ = 0;  // with room for any count
    std::size_t row_size_ = 0;
    std::vector<NpyType> carried_;
    std::uint64_t count_ = 0;
    std::array<std::array<char, feature_size>, feature_count> features_{};  // as they stand in the file
};

}  // namespace

std::unique_ptr<TableSink> open_npy_sink(const std::string& path, const TableFormat& format) {
    return std::make_unique<NpySink>(path, format);
}

}  // namespace barycert::io

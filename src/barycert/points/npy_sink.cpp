#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <set>
#include <utility>

#include "barycert/core/output_file.hpp"
#include "barycert/mesh/row_errors.hpp"
#include "barycert/points/formats.hpp"
#include "barycert/points/npy_header.hpp"

namespace barycert::points {
namespace {

/// The length of the longest feature of a row.
constexpr std::size_t feature_size = 8;

/// NumPy aligns the numbers of a file so.
constexpr std::size_t alignment = 64;

std::size_t buffered_rows(std::size_t row_size) {
    return std::max<std::size_t>(1, (std::size_t{1} << 18) / row_size);
}

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

char* put(char* at, std::uint64_t bits) {
    if constexpr (std::endian::native != std::endian::little) bits = __builtin_bswap64(bits);
    std::memcpy(at, &bits, sizeof bits);
    return at + sizeof bits;
}

class NpySink final : public Sink {
public:
    NpySink(const std::string& path, RowFormat format) : path_(path), format_(std::move(format)), file_(path) {}

    Status begin();
    Status write(const Rows& rows) override;
    Status commit() override;

private:
    Status check_names(const std::vector<std::string>& names) const;
    std::string header(std::uint64_t count) const;
    void put_row(const Rows& rows, std::size_t row, char* at) const;

    std::string path_;
    RowFormat format_;
    OutputFile file_;
    std::string types_;          // the descr of the header
    std::size_t text_size_ = 0;  // of the header, with room for any count
    std::size_t head_size_ = 0;
    char version_ = 1;
    std::size_t row_size_ = 0;
    std::uint64_t count_ = 0;
    std::vector<char> buffer_;
};

Status NpySink::check_names(const std::vector<std::string>& names) const {
    std::set<std::string> seen;
    for (const std::string& name : names) {
        const char* expected = nullptr;
        if (name.empty()) expected = "a name";
        if (!is_utf8(name)) expected = "a name in UTF-8";
        if (!seen.insert(name).second)
            expected = "names that differ from each other and from x, y, z, cell, feature, distance";
        if (expected == nullptr) continue;
        return Error{.what = "a column name that an NPY file cannot hold",
                     .file = path_,
                     .expected = expected,
                     .found = barycert::detail::quoted(name),
                     .remedy = "rename the field, leave it out, or write CSV"};
    }
    return Done{};
}

Status NpySink::begin() {
    if (!file_.status()) return file_.status();
    if (!file_.can_replace()) {
        return Error{.what = "cannot write NPY to a pipe or device",
                     .file = path_,
                     .expected = "a regular file: the number of rows is written into its header at the end",
                     .found = {},
                     .remedy = "name a regular file, or write CSV"};
    }
    std::vector<std::string> names{"x", "y"};
    if (format_.dimension == 3) names.emplace_back("z");
    names.insert(names.end(), {"cell", "feature"});
    const std::size_t before = names.size();
    names.insert(names.end(), format_.columns.begin(), format_.columns.end());
    if (format_.distances) names.emplace_back("distance");
    if (Status good = check_names(names); !good) return good;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const char* const type = i + 2 == before ? "<i8" : i + 1 == before ? "|S8" : "<f8";
        types_ += (i != 0 ? ", (" : "(") + as_literal(names[i]) + ", '" + type + "')";
    }
    row_size_ = 8 * names.size();
    buffer_.resize(buffered_rows(row_size_) * row_size_);

    // Version 1 has 2 bytes for the length and is in Latin-1, version 2 has 4, version 3 is in UTF-8.
    const bool ascii =
        std::none_of(types_.begin(), types_.end(), [](char c) { return static_cast<unsigned char>(c) > 127; });
    const std::size_t longest = header(UINT64_MAX).size() + alignment;
    if (longest > UINT16_MAX) version_ = 2;
    if (!ascii) version_ = 3;
    head_size_ = version_ == 1 ? 10 : 12;
    const std::size_t whole = (head_size_ + header(UINT64_MAX).size() + 1 + alignment - 1) / alignment * alignment;
    text_size_ = whole - head_size_;
    if (text_size_ > longest_npy_text) {
        return Error{.what = "too many columns for an NPY file",
                     .file = path_,
                     .expected = "a header of at most " + std::to_string(longest_npy_text) + " bytes",
                     .found = std::to_string(text_size_),
                     .remedy = "choose fewer fields, or write CSV"};
    }
    std::string head(npy_magic);
    head += {version_, '\0'};
    for (std::size_t i = 8; i < head_size_; ++i) head += static_cast<char>(text_size_ >> 8 * (i - 8) & 0xFFU);
    file_.write(head);
    std::string text = header(0);
    text.resize(text_size_ - 1, ' ');
    file_.write(text + '\n');
    return file_.status();
}

std::string NpySink::header(std::uint64_t count) const {
    return "{'descr': [" + types_ + "], 'fortran_order': False, 'shape': (" + std::to_string(count) + ",), }";
}

void NpySink::put_row(const Rows& rows, std::size_t row, char* at) const {
    const auto dimension = static_cast<std::size_t>(format_.dimension);
    const std::size_t columns = format_.columns.size();
    for (const double x : rows.points.subspan(row * dimension, dimension))
        at = put(at, std::bit_cast<std::uint64_t>(x));
    at = put(at, static_cast<std::uint64_t>(static_cast<std::int64_t>(rows.cells[row])));
    const std::string_view feature = name(rows.features[row]);
    for (std::size_t i = 0; i < feature_size; ++i) *at++ = i < feature.size() ? feature[i] : '\0';
    for (const double x : rows.values.subspan(row * columns, columns)) at = put(at, std::bit_cast<std::uint64_t>(x));
    if (format_.distances) put(at, std::bit_cast<std::uint64_t>(rows.distances[row]));
}

Status NpySink::write(const Rows& rows) {
    if (Status fits = check_rows(rows, format_, path_); !fits) return fits;
    const std::size_t count = rows.cells.size();
    const std::size_t most = buffer_.size() / row_size_;
    for (std::size_t row = 0; row < count;) {
        const std::size_t size = std::min(most, count - row);
        for (std::size_t i = 0; i < size; ++i) put_row(rows, row + i, buffer_.data() + i * row_size_);
        file_.write({buffer_.data(), size * row_size_});
        row += size;
    }
    count_ += count;
    return file_.status();
}

Status NpySink::commit() {
    std::string text = header(count_);
    text.resize(text_size_ - 1, ' ');
    file_.replace(head_size_, text);
    return file_.commit();
}

}  // namespace

Result<std::unique_ptr<Sink>> open_npy_sink(const std::string& path, const RowFormat& format) {
    auto sink = std::make_unique<NpySink>(path, format);
    if (Status begun = sink->begin(); !begun) return begun.error();
    return std::unique_ptr<Sink>(std::move(sink));
}

}  // namespace barycert::points

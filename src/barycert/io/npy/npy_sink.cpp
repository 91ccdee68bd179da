#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

#include "barycert/base/output_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/npy/npy_fields.hpp"
#include "barycert/io/npy/npy_header.hpp"
#include "barycert/io/npy/npy_types.hpp"

namespace barycert::io {
namespace {

/// NumPy aligns the numbers of a file so.
constexpr std::size_t alignment = 64;

constexpr std::size_t feature_count = static_cast<std::size_t>(Feature::degenerate) + 1;

/// What one thread lays out at a time, and how many of these go to the file together.
constexpr std::size_t piece_bytes = std::size_t{1} << 18;
constexpr std::size_t pieces_at_once = 16;

std::size_t rows_a_piece(std::size_t row_size) {
    return std::max<std::size_t>(1, piece_bytes / row_size);
}

char* put(char* at, std::uint64_t bits) {
    if constexpr (std::endian::native != std::endian::little) bits = __builtin_bswap64(bits);
    std::memcpy(at, &bits, sizeof bits);
    return at + sizeof bits;
}

class NpySink final : public TableSink {
public:
    NpySink(const std::string& path, TableFormat format)
        : path_(path), format_(std::move(format)), columns_(format_.columns().size()), file_(path) {}

    Status begin();
    Status write(const TableView& rows) override;
    Status commit() override;

private:
    std::string header(std::uint64_t count) const;
    void put_row(const TableView& rows, std::size_t row, char* at) const;
    Status check_texts(const TableView& rows) const;

    std::string path_;
    TableFormat format_;
    std::size_t columns_;
    base::OutputFile file_;
    std::string types_;          // the descr of the header
    std::size_t text_size_ = 0;  // of the header, with room for any count
    std::size_t head_size_ = 0;
    char version_ = 1;
    std::size_t row_size_ = 0;
    std::vector<std::size_t> carried_;  // bytes of each carried column
    std::uint64_t count_ = 0;
    std::vector<char> buffer_;
    std::array<std::uint64_t, feature_count> features_{};  // as they stand in the file, in the memory of this machine
    Error error_;                                          // rows that do not fit
};

Status NpySink::begin() {
    if (!file_.status()) return file_.status();
    if (!file_.can_replace()) {
        return Error{.what = "cannot write NPY to a pipe or device",
                     .file = path_,
                     .expected = "a regular file: the number of rows is written into its header at the end",
                     .found = {},
                     .remedy = "name a regular file, or write CSV"};
    }
    Result<NpyFields> fields = npy_fields(format_, path_);
    if (!fields) return fields.error();
    types_ = std::move(fields->descr);
    row_size_ = fields->row_size;
    carried_ = std::move(fields->carried);
    for (std::size_t f = 0; f < features_.size(); ++f) {
        std::array<char, npy_feature_size> text{};
        const std::string_view word = name(static_cast<Feature>(f));
        std::copy_n(word.begin(), std::min(word.size(), text.size()), text.begin());
        std::memcpy(&features_[f], text.data(), text.size());
    }

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
    return "{'descr': " + types_ + ", 'fortran_order': False, 'shape': (" + std::to_string(count) + ",), }";
}

void NpySink::put_row(const TableView& rows, std::size_t row, char* at) const {
    const auto dimension = static_cast<std::size_t>(format_.dimension);
    for (const double x : rows.points.subspan(row * dimension, dimension))
        at = put(at, std::bit_cast<std::uint64_t>(x));
    at = put(at, static_cast<std::uint64_t>(static_cast<std::int64_t>(rows.cells[row])));
    std::memcpy(at, &features_[static_cast<std::size_t>(rows.features[row])], npy_feature_size);
    at += npy_feature_size;
    for (const double x : rows.values.subspan(row * columns_, columns_)) at = put(at, std::bit_cast<std::uint64_t>(x));
    if (format_.distances) at = put(at, std::bit_cast<std::uint64_t>(rows.distances[row]));
    for (std::size_t k = 0; k < carried_.size(); ++k) {
        const auto& values = rows.carried[k].values;
        if (const auto* const integers = std::get_if<std::vector<std::int64_t>>(&values)) {
            put(at, static_cast<std::uint64_t>((*integers)[row]));
        } else if (const auto* const numbers = std::get_if<std::vector<double>>(&values)) {
            put(at, std::bit_cast<std::uint64_t>((*numbers)[row]));
        } else {
            put_npy_text(at, carried_[k], std::get<std::vector<std::string>>(values)[row],
                         format_.carried[k].max_characters != 0);
        }
        at += carried_[k];
    }
}

/// What the types of the file cannot hold.
Status NpySink::check_texts(const TableView& rows) const {
    for (std::size_t k = 0; k < carried_.size(); ++k) {
        const auto* const texts = std::get_if<std::vector<std::string>>(&rows.carried[k].values);
        if (texts == nullptr) continue;
        const bool characters = format_.carried[k].max_characters != 0;
        for (const std::string& text : *texts) {
            if (fits_npy_text(text, carried_[k], characters)) continue;
            return Error{.what = "a text of column " + base::quoted(format_.carried[k].name) + " does not fit the file",
                         .file = path_,
                         .expected = std::to_string(carried_[k] / (characters ? 4 : 1)) +
                                     (characters ? " characters of UTF-8" : " bytes") +
                                     " at most, as the column was told, and no zero byte at its end",
                         .found = base::quoted(text),
                         .remedy = "write CSV"};
        }
    }
    return Done{};
}

Status NpySink::write(const TableView& rows) {
    const ExactEnvironment environment;
    if (!error_.what.empty()) return error_;
    if (Status fits = check_rows(rows, format_, path_); !fits) return error_ = fits.error();
    if (Status fits = check_texts(rows); !fits) return error_ = fits.error();
    const std::size_t count = rows.cells.size();
    const std::size_t piece = rows_a_piece(row_size_), at_once = pieces_at_once * piece;
    buffer_.resize(std::max(buffer_.size(), std::min(count, at_once) * row_size_));
    for (std::size_t row = 0; row < count && file_.status(); row += at_once) {
        const std::size_t size = std::min(at_once, count - row);
        // Whoever waits here must not begin other work of the caller: its stages wait for this one.
        tbb::this_task_arena::isolate([&] {
            tbb::parallel_for(std::size_t{0}, (size + piece - 1) / piece, [&](std::size_t p) {
                for (std::size_t i = p * piece; i < std::min(size, (p + 1) * piece); ++i)
                    put_row(rows, row + i, buffer_.data() + i * row_size_);
            });
        });
        file_.write({buffer_.data(), size * row_size_});
    }
    count_ += count;
    return file_.status();
}

Status NpySink::commit() {
    if (!error_.what.empty()) return error_;
    std::string text = header(count_);
    text.resize(text_size_ - 1, ' ');
    file_.replace(head_size_, text);
    return file_.commit();
}

}  // namespace

Result<std::unique_ptr<TableSink>> open_npy_sink(const std::string& path, const TableFormat& format) {
    auto sink = std::make_unique<NpySink>(path, format);
    if (Status begun = sink->begin(); !begun) return begun.error();
    return std::unique_ptr<TableSink>(std::move(sink));
}

}  // namespace barycert::io

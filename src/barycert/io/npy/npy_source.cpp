// Points from an NPY file, read by blocks and not mapped: memory is bounded, and a file that shrinks meanwhile is told.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "barycert/base/finite.hpp"
#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/npy/npy_header.hpp"

namespace barycert::io {
namespace {

/// Numbers read at a time.
constexpr std::size_t block_size = std::size_t{1} << 15;

/// Floating-point numbers of 8 or 4 bytes as they stand in the file.
template <class Number, class Bits>
double number_at(const char* at, bool swapped) {
    Bits bits = 0;
    std::memcpy(&bits, at, sizeof bits);
    if (swapped)
        bits = sizeof bits == 8 ? static_cast<Bits>(__builtin_bswap64(bits))
                                : static_cast<Bits>(__builtin_bswap32(static_cast<std::uint32_t>(bits)));
    return std::bit_cast<Number>(bits);
}

class NpySource final : public PointSource {
public:
    NpySource(std::string path, int dimension)
        : path_(std::move(path)), dimension_(static_cast<std::size_t>(dimension)) {}

    Status begin();

    int dimension() const override { return static_cast<int>(dimension_); }
    std::optional<std::uint64_t> count() const override { return layout_.count; }
    Result<std::size_t> read(std::size_t max, std::vector<double>& out) override;

private:
    Error failure(const char* what, std::string expected, std::string found, std::string remedy) const {
        return {.what = what,
                .file = path_,
                .line = 0,
                .expected = std::move(expected),
                .found = std::move(found),
                .remedy = std::move(remedy)};
    }
    Status read_bytes(std::uint64_t offset, std::span<char> bytes);
    Status read_numbers(std::uint64_t first, std::size_t count, double* out, std::size_t stride);

    std::string path_;
    std::size_t dimension_;
    base::InputFile file_;
    std::uint64_t file_size_ = 0;
    std::uint64_t data_ = 0;  // where the numbers begin
    NpyLayout layout_;
    std::uint64_t next_ = 0;
    std::vector<char> bytes_;
    Error error_;
};

Status NpySource::read_bytes(std::uint64_t offset, std::span<char> bytes) {
    const Result<std::size_t> got = file_.read_at(offset, bytes, path_);
    if (!got) return got.error();
    if (*got == bytes.size()) return Done{};
    return failure("the file ends too early", "byte " + std::to_string(offset + bytes.size() - 1),
                   "the end of the file", "do not change the file while it is read");
}

Status NpySource::begin() {
    Result<base::InputFile> opened =
        base::InputFile::open(path_, "save the array to a regular file first; CSV can be read from a pipe");
    if (!opened) return opened.error();
    file_ = std::move(*opened);
    file_size_ = file_.size();
    bytes_.resize(std::min<std::uint64_t>(npy_head, file_size_));
    if (Status head = read_bytes(0, bytes_); !head) return head;
    const Result<NpyText> text = find_npy_text({bytes_.data(), bytes_.size()}, path_);
    if (!text) return text.error();
    data_ = text->offset + text->size;
    if (data_ > file_size_) {
        return failure("the file ends too early", "a header of " + std::to_string(data_) + " bytes",
                       std::to_string(file_size_), "the file may be cut short: write it again");
    }
    bytes_.resize(text->size);
    if (Status read = read_bytes(text->offset, bytes_); !read) return read;
    const Result<NpyHeader> header = parse_npy_text({bytes_.data(), bytes_.size()}, path_);
    if (!header) return header.error();
    const Result<NpyLayout> layout = settle_npy_layout(*header, dimension_, file_size_ - data_, path_);
    if (!layout) return layout.error();
    layout_ = *layout;
    return Done{};
}

/// The `count` numbers of the file from number `first` on, to out[0], out[stride], ...
Status NpySource::read_numbers(std::uint64_t first, std::size_t count, double* out, std::size_t stride) {
    const bool as_in_memory = layout_.item == 8 && !layout_.swapped && stride == 1;
    if (as_in_memory && count != 0)
        return read_bytes(data_ + first * 8, {reinterpret_cast<char*>(out), count * sizeof(double)});
    for (std::size_t done = 0; done < count;) {
        const std::size_t size = std::min(block_size, count - done);
        bytes_.resize(size * layout_.item);
        if (Status read = read_bytes(data_ + (first + done) * layout_.item, bytes_); !read) return read;
        for (std::size_t i = 0; i < size; ++i) {
            const char* const at = bytes_.data() + i * layout_.item;
            out[(done + i) * stride] = layout_.item == 8
                                           ? number_at<double, std::uint64_t>(at, layout_.swapped)
                                           : static_cast<double>(number_at<float, std::uint32_t>(at, layout_.swapped));
        }
        done += size;
    }
    return Done{};
}

Result<std::size_t> NpySource::read(std::size_t max, std::vector<double>& out) {
    const ExactEnvironment environment;
    if (!error_.what.empty()) return error_;
    const std::size_t taken = std::min<std::uint64_t>(max, layout_.count - next_);
    const std::size_t before = out.size();
    out.resize(before + taken * dimension_);
    double* const points = out.data() + before;
    Status read = Done{};
    if (layout_.fortran_order) {
        for (std::size_t axis = 0; axis < dimension_ && read; ++axis) {
            read = read_numbers(axis * layout_.count + next_, taken, points + axis, dimension_);
        }
    } else {
        read = read_numbers(next_ * dimension_, taken * dimension_, points, 1);
    }
    const bool finite = read && base::all_finite({points, taken * dimension_});
    for (std::size_t i = 0; i < taken * dimension_ && read && !finite; ++i) {
        if (std::isfinite(points[i])) continue;
        read = failure("a point that is not finite", "finite coordinates",
                       base::shortest(points[i]) + " at [" + std::to_string(next_ + i / dimension_) + ", " +
                           std::to_string(i % dimension_) + "]",
                       "remove the point, or give it coordinates: a[numpy.isfinite(a).all(axis=1)]");
    }
    if (!read) {
        out.resize(before);
        return error_ = read.error();
    }
    next_ += taken;
    return taken;
}

}  // namespace

Result<std::unique_ptr<PointSource>> open_npy_source(const std::string& path, int dimension) {
    auto source = std::make_unique<NpySource>(path, dimension);
    if (Status begun = source->begin(); !begun) return begun.error();
    return std::unique_ptr<PointSource>(std::move(source));
}

}  // namespace barycert::io

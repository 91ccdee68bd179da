#include "barycert/io/npz/weights_file.hpp"

#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

namespace barycert::io {
namespace {

static_assert(std::endian::native == std::endian::little, "NPY files are written as numbers stand in memory");

template <class T>
std::string_view bytes_of(std::span<const T> numbers) {
    const auto bytes = std::as_bytes(numbers);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The numbers of type From in `bytes` as numbers of type To, each changed by `change`.
template <class From, class To, class Change>
void write_changed(std::string_view bytes, NpzWriter& file, Change change) {
    std::vector<To> out(bytes.size() / sizeof(From));
    for (std::size_t i = 0; i < out.size(); ++i) {
        From x;
        std::memcpy(&x, bytes.data() + sizeof x * i, sizeof x);
        out[i] = static_cast<To>(change(x));
    }
    file.write(bytes_of(std::span<const To>(out)));
}

template <class Offset>
Status write_pattern(NpzWriter& file, base::SpillFile& counts, base::SpillFile& indices, std::uint64_t rows,
                     std::uint64_t entries) {
    const char* const type = sizeof(Offset) == 4 ? "<i4" : "<i8";
    file.begin("indices", type);
    const auto same = [](auto x) { return x; };
    if (Status read =
            indices.read([&](std::string_view bytes) { write_changed<Mesh::Index, Offset>(bytes, file, same); });
        !read)
        return read;
    file.end({entries});
    file.begin("indptr", type);
    Offset at = 0;
    file.write(bytes_of(std::span<const Offset>(&at, 1)));
    const auto sum = [&at](std::uint8_t count) { return at = static_cast<Offset>(at + count); };
    if (Status read =
            counts.read([&](std::string_view bytes) { write_changed<std::uint8_t, Offset>(bytes, file, sum); });
        !read)
        return read;
    file.end({rows + 1});
    return Done{};
}

}  // namespace

Result<std::unique_ptr<WeightsFile>> WeightsFile::open(const std::string& path, std::uint64_t nodes) {
    auto file = NpzWriter::open(path);
    if (!file) return file.error();
    std::unique_ptr<WeightsFile> weights(new WeightsFile(std::move(*file), path, nodes));
    if (Status spill = weights->status(); !spill) return spill.error();
    weights->file_->begin("data", "<f8");
    return weights;
}

void WeightsFile::write(std::span<const std::uint8_t> counts, std::span<const Mesh::Index> nodes,
                        std::span<const double> weights, std::span<const Mesh::Index> cells) {
    file_->write(bytes_of(weights));
    counts_.write(bytes_of(counts));
    indices_.write(bytes_of(nodes));
    cells_.write(bytes_of(cells));
    rows_ += counts.size();
    entries_ += weights.size();
}

Status WeightsFile::status() const {
    for (const base::SpillFile* const spill : {&counts_, &indices_, &cells_}) {
        if (Status good = spill->status(); !good) return good;
    }
    return Done{};
}

Status WeightsFile::commit() {
    file_->end({entries_});
    const bool narrow = entries_ <= 0x7fffffff;
    Status pattern = narrow ? write_pattern<std::int32_t>(*file_, counts_, indices_, rows_, entries_)
                            : write_pattern<std::int64_t>(*file_, counts_, indices_, rows_, entries_);
    if (!pattern) return pattern;
    file_->begin("cell", "<i8");
    const auto same = [](Mesh::Index x) { return x; };
    if (Status read =
            cells_.read([&](std::string_view bytes) { write_changed<Mesh::Index, std::int64_t>(bytes, *file_, same); });
        !read)
        return read;
    file_->end({rows_});
    const std::uint64_t shape[] = {rows_, nodes_};
    file_->begin("shape", "<i8");
    file_->write(bytes_of(std::span<const std::uint64_t>(shape)));
    file_->end({2});
    file_->begin("format", "|S3");
    file_->write("csr");
    file_->end({});
    return file_->commit();
}

}  // namespace barycert::io

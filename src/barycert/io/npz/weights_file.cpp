#include "barycert/io/npz/weights_file.hpp"

#include <algorithm>
#include <bit>
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

/// All numbers as numbers of type To, each changed by `change`, piece by piece.
template <class To, class From, class Change>
void write_changed(std::span<const From> all, NpzWriter& file, Change change) {
    constexpr std::size_t piece = std::size_t{1} << 16;
    std::vector<To> out;
    for (std::size_t first = 0; first < all.size(); first += out.size()) {
        out.clear();
        for (const From x : all.subspan(first, std::min(piece, all.size() - first)))
            out.push_back(static_cast<To>(change(x)));
        file.write(bytes_of(std::span<const To>(out)));
    }
}

constexpr auto unchanged = [](auto x) { return x; };

template <class Offset>
void write_pattern(NpzWriter& file, std::span<const std::uint8_t> counts, std::span<const Mesh::Index> indices) {
    const char* const type = sizeof(Offset) == 4 ? "<i4" : "<i8";
    file.begin("indices", type);
    write_changed<Offset>(indices, file, unchanged);
    file.end({indices.size()});
    file.begin("indptr", type);
    Offset at = 0;
    file.write(bytes_of(std::span<const Offset>(&at, 1)));
    write_changed<Offset>(counts, file, [&at](std::uint8_t count) { return at = static_cast<Offset>(at + count); });
    file.end({counts.size() + 1});
}

}  // namespace

Result<std::unique_ptr<WeightsFile>> WeightsFile::open(const std::string& path, std::uint64_t nodes) {
    auto file = NpzWriter::open(path);
    if (!file) return file.error();
    std::unique_ptr<WeightsFile> weights(new WeightsFile(std::move(*file), path, nodes));
    weights->file_->begin("data", "<f8");
    return weights;
}

Status WeightsFile::write(std::span<const std::uint8_t> counts, std::span<const Mesh::Index> nodes,
                          std::span<const double> weights, std::span<const Mesh::Index> cells) {
    file_->write(bytes_of(weights));
    if (Status kept = counts_.append(counts); !kept) return kept;
    if (Status kept = indices_.append(nodes); !kept) return kept;
    return cells_.append(cells);
}

Status WeightsFile::commit() {
    for (base::Spool* const spool : {&counts_, &indices_, &cells_}) {
        if (Status kept = spool->finish(); !kept) return kept;
    }
    const auto counts = counts_.values<std::uint8_t>();
    const auto indices = indices_.values<Mesh::Index>();
    const auto cells = cells_.values<Mesh::Index>();
    file_->end({indices.size()});
    const bool narrow = indices.size() <= 0x7fffffff;
    narrow ? write_pattern<std::int32_t>(*file_, counts, indices)
           : write_pattern<std::int64_t>(*file_, counts, indices);
    file_->begin("cell", "<i8");
    write_changed<std::int64_t>(cells, *file_, unchanged);
    file_->end({cells.size()});
    const std::uint64_t shape[] = {cells.size(), nodes_};
    file_->begin("shape", "<i8");
    file_->write(bytes_of(std::span<const std::uint64_t>(shape)));
    file_->end({2});
    file_->begin("format", "|S3");
    file_->write("csr");
    file_->end({});
    return file_->commit();
}

}  // namespace barycert::io

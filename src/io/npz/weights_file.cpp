// Format of NPZ: a ZIP archive of NPY files, as numpy.savez writes it. Format of ZIP: APPNOTE.TXT 6.3 of PKWARE.
#include "io/npz/weights_file.hpp"

#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "files/output_file.hpp"
#include "files/spool.hpp"
#include "io/npy/npy.hpp"
#include "io/vtk/numbers.hpp"

namespace barycert::io {
namespace {

// The header of an array has one size whatever the shape, for that is known last: NumPy reads past the blanks.
constexpr std::size_t npz_npy_header = 192;
constexpr std::uint64_t zip_limit = 0xffffffff;  // sizes and offsets from here on stand in a ZIP64 field
constexpr unsigned zip_version = 20, zip64_version = 45;
constexpr unsigned zip64_field = 0x0001, padding_field = 0xd935;  // the latter: data that readers pass over
constexpr unsigned zip_date = 0x21;                               // 1 January 1980: files depend on their content alone

/// Little-endian numbers in a row.
struct Bytes {
    std::string all;

    Bytes& two(std::uint64_t x) { return put(x, 2); }
    /// A larger number is the limit, which says that it stands in a ZIP64 field.
    Bytes& four(std::uint64_t x) { return put(std::min(x, zip_limit), 4); }
    Bytes& eight(std::uint64_t x) { return put(x, 8); }
    Bytes& text(std::string_view text) {
        all += text;
        return *this;
    }
    Bytes& put(std::uint64_t x, int size) {
        for (int i = 0; i < size; ++i) all += static_cast<char>(x >> 8 * i & 0xff);
        return *this;
    }
};

static_assert(std::endian::native == std::endian::little, "NPY files are written as numbers stand in memory");

/// Arrays one after the other, not compressed, of any size. The file appears whole at commit(), or not at all.
class NpzWriter final : public WeightsFile {
public:
    NpzWriter(const std::string& path, std::uint64_t nodes)
        : file_(path), counts_(path), indices_(path), cells_(path), nodes_(nodes) {
        begin("data", "<f8");
    }

    /// Error: the file cannot be written, or is a pipe or device: sizes are known only at the end of an array.
    Status check(const std::string& path) const {
        if (!file_.status() || file_.can_replace()) return file_.status();
        return file_error("file.pipe", path, "cannot write NPZ to a pipe or device",
                          "a regular file: sizes are written into its headers at the end", {}, "name a regular file");
    }

    Status write(std::span<const std::uint8_t> counts, std::span<const Mesh::Index> nodes,
                 std::span<const double> weights, std::span<const Mesh::Index> cells) override {
        write(bytes_of(weights));
        if (Status kept = counts_.append(counts); !kept) return kept;
        if (Status kept = indices_.append(nodes); !kept) return kept;
        return cells_.append(cells);
    }

    Status commit() override {
        for (base::Spool* const spool : {&counts_, &indices_, &cells_}) {
            if (Status kept = spool->finish(); !kept) return kept;
        }
        const auto counts = counts_.values<std::uint8_t>();
        const auto indices = indices_.values<Mesh::Index>();
        const auto cells = cells_.values<Mesh::Index>();
        end({indices.size()});
        const bool narrow = indices.size() <= 0x7fffffff;
        narrow ? write_pattern<std::int32_t>(counts, indices) : write_pattern<std::int64_t>(counts, indices);
        begin("cell", "<i8");
        write_changed<std::int64_t>(cells, std::identity());
        end({cells.size()});
        const std::array<std::uint64_t, 2> shape{cells.size(), nodes_};
        begin("shape", "<i8");
        write(bytes_of(shape));
        end({2});
        begin("format", "|S3");
        write("csr");
        end({});
        write_directory();
        return file_.commit();
    }

private:
    struct Member {
        std::string name, descr;
        std::uint64_t offset = 0, size = 0;
        std::uint32_t checksum = 0;
    };

    /// Begins the array NAME.npy. `descr`: NumPy's name of the type, such as <f8.
    void begin(const std::string& name, const std::string& descr) {
        members_.push_back({name + ".npy", descr, size_});
        put(local_header(members_.back()));
        put(npy_header_of("'" + descr + "'", {}, npz_npy_header));
        numbers_ = 0;
    }

    void write(std::string_view bytes) {
        numbers_ = libdeflate_crc32(numbers_, bytes.data(), bytes.size());
        members_.back().size += bytes.size();
        put(bytes);
    }

    /// All numbers as numbers of type To, each changed by `change`, piece by piece.
    template <class To, class From, class Change>
    void write_changed(std::span<const From> all, Change change) {
        constexpr std::size_t piece = std::size_t{1} << 16;
        std::vector<To> out;
        for (std::size_t first = 0; first < all.size(); first += out.size()) {
            out.clear();
            for (const From x : all.subspan(first, std::min(piece, all.size() - first)))
                out.push_back(static_cast<To>(change(x)));
            write(bytes_of(out));
        }
    }

    template <class Offset>
    void write_pattern(std::span<const std::uint8_t> counts, std::span<const Mesh::Index> indices) {
        const char* const type = sizeof(Offset) == 4 ? "<i4" : "<i8";
        begin("indices", type);
        write_changed<Offset>(indices, std::identity());
        end({indices.size()});
        begin("indptr", type);
        Offset at = 0;
        write(bytes_of(std::span(&at, 1)));
        write_changed<Offset>(counts, [&at](std::uint8_t count) { return at = static_cast<Offset>(at + count); });
        end({counts.size() + 1});
    }

    /// `shape`: as many numbers as were written.
    void end(const std::vector<std::uint64_t>& shape) {
        Member& m = members_.back();
        const std::string header = npy_header_of("'" + m.descr + "'", shape, npz_npy_header);
        m.checksum = static_cast<std::uint32_t>(
            crc32_combine(libdeflate_crc32(0, header.data(), header.size()), numbers_, static_cast<z_off_t>(m.size)));
        m.size += header.size();
        file_.replace(m.offset, local_header(m) + header);
    }

    void write_directory() {
        const std::uint64_t begin = size_;
        for (const Member& m : members_) put(central_header(m));
        const std::uint64_t end = size_, count = members_.size();
        Bytes b;
        if (begin >= zip_limit || end - begin >= zip_limit) {
            b.four(0x06064b50).eight(44).two(3U << 8 | zip64_version).two(zip64_version).four(0).four(0);
            b.eight(count).eight(count).eight(end - begin).eight(begin);
            b.four(0x07064b50).four(0).eight(end).four(1);
        }
        b.four(0x06054b50).two(0).two(0).two(count).two(count).four(end - begin).four(begin).two(0);
        put(b.all);
    }

    void put(std::string_view bytes) {
        file_.write(bytes);
        size_ += bytes.size();
    }

    /// With room for the sizes in 8 bytes, which is used only where it is needed.
    static std::string local_header(const Member& m) {
        const bool large = m.size >= zip_limit;
        Bytes b;
        b.four(0x04034b50).two(large ? zip64_version : zip_version).two(0).two(0).two(0).two(zip_date);
        b.four(m.checksum).four(m.size).four(m.size).two(m.name.size()).two(20).text(m.name);
        b.two(large ? zip64_field : padding_field).two(16).eight(large ? m.size : 0).eight(large ? m.size : 0);
        return b.all;
    }

    static std::string central_header(const Member& m) {
        Bytes field;
        if (m.size >= zip_limit) field.eight(m.size).eight(m.size);
        if (m.offset >= zip_limit) field.eight(m.offset);
        const std::size_t extra = field.all.empty() ? 0 : 4 + field.all.size();
        const unsigned version = extra == 0 ? zip_version : zip64_version;
        Bytes b;
        b.four(0x02014b50).two(3U << 8 | version).two(version).two(0).two(0).two(0).two(zip_date);
        b.four(m.checksum).four(m.size).four(m.size).two(m.name.size()).two(extra);
        b.two(0).two(0).two(0).four(0100644ULL << 16).four(m.offset).text(m.name);
        if (extra != 0) b.two(zip64_field).two(field.all.size()).text(field.all);
        return b.all;
    }

    base::OutputFile file_;
    base::Spool counts_, indices_, cells_;
    std::uint64_t nodes_, size_ = 0;
    std::vector<Member> members_;
    std::uint32_t numbers_ = 0;  ///< CRC-32 of the numbers of the array that was begun
};

}  // namespace

Result<std::unique_ptr<WeightsFile>> WeightsFile::open(const std::string& path, std::uint64_t nodes) {
    auto file = std::make_unique<NpzWriter>(path, nodes);
    if (Status opened = file->check(path); !opened) return opened.error();
    return std::unique_ptr<WeightsFile>(std::move(file));
}

}  // namespace barycert::io

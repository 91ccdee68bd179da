#include "barycert/io/npz/npz_writer.hpp"

#include <zlib.h>

#include <cstddef>
#include <memory>
#include <utility>

#include "barycert/io/npy/npy_header.hpp"

namespace barycert::io {
namespace {

// The header of an array has one size whatever the shape, for that is known last: NumPy reads past the blanks.
constexpr std::size_t npz_npy_header = 192;
constexpr std::uint64_t zip_limit = 0xffffffff;  // sizes and offsets from here on stand in a ZIP64 field
constexpr unsigned zip_version = 20, zip64_version = 45;
constexpr unsigned zip64_field = 0x0001, padding_field = 0xd935;  // the latter: data that readers pass over
constexpr unsigned zip_date = 0x21;                               // 1 January 1980: files depend on their content alone

/// Little-endian numbers in a row.
class Bytes {
public:
    Bytes& two(std::uint64_t x) { return put(x, 2); }
    Bytes& four(std::uint64_t x) { return put(x, 4); }
    Bytes& eight(std::uint64_t x) { return put(x, 8); }
    Bytes& text(std::string_view text) {
        bytes_ += text;
        return *this;
    }
    const std::string& all() const { return bytes_; }

private:
    Bytes& put(std::uint64_t x, int size) {
        for (int i = 0; i < size; ++i) bytes_ += static_cast<char>(x >> 8 * i & 0xff);
        return *this;
    }
    std::string bytes_;
};

static_assert(sizeof(z_off_t) == 8, "sizes of arrays beyond 2 GiB");

std::uint64_t or_limit(std::uint64_t x) {
    return x < zip_limit ? x : zip_limit;
}

std::string npy_header_of(const std::string& descr, const std::vector<std::uint64_t>& shape) {
    std::string text = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (";
    for (const std::uint64_t n : shape) text += std::to_string(n) + (shape.size() == 1 ? "," : ", ");
    if (shape.size() > 1) text.resize(text.size() - 2);
    text += "), }";
    constexpr std::size_t head = 10;
    text.resize(npz_npy_header - head - 1, ' ');
    text += '\n';
    return Bytes().text(npy_magic).text({"\1\0", 2}).two(text.size()).text(text).all();
}

std::uint32_t checksum_of(std::uint32_t checksum, std::string_view bytes) {
    return static_cast<std::uint32_t>(
        ::crc32_z(checksum, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace

Result<std::unique_ptr<NpzWriter>> NpzWriter::open(const std::string& path) {
    std::unique_ptr<NpzWriter> writer(new NpzWriter(path));
    if (Status opened = writer->file_.status(); !opened) return opened.error();
    if (!writer->file_.can_replace())
        return Error{.what = "cannot write NPZ to a pipe or device",
                     .file = path,
                     .expected = "a regular file: sizes are written into its headers at the end",
                     .remedy = "name a regular file"};
    return writer;
}

void NpzWriter::put(std::string_view bytes) {
    file_.write(bytes);
    size_ += bytes.size();
}

/// With room for the sizes in 8 bytes, which is used only where it is needed.
std::string NpzWriter::local_header(const Member& m) const {
    const bool large = m.size >= zip_limit;
    Bytes b;
    b.four(0x04034b50).two(large ? zip64_version : zip_version).two(0).two(0).two(0).two(zip_date);
    b.four(m.checksum).four(or_limit(m.size)).four(or_limit(m.size)).two(m.name.size()).two(20).text(m.name);
    b.two(large ? zip64_field : padding_field).two(16).eight(large ? m.size : 0).eight(large ? m.size : 0);
    return b.all();
}

std::string NpzWriter::central_header(const Member& m) const {
    Bytes field;
    if (m.size >= zip_limit) field.eight(m.size).eight(m.size);
    if (m.offset >= zip_limit) field.eight(m.offset);
    const std::size_t extra = field.all().empty() ? 0 : 4 + field.all().size();
    const unsigned version = extra == 0 ? zip_version : zip64_version;
    Bytes b;
    b.four(0x02014b50).two(3U << 8 | version).two(version).two(0).two(0).two(0).two(zip_date);
    b.four(m.checksum).four(or_limit(m.size)).four(or_limit(m.size)).two(m.name.size()).two(extra).two(0).two(0).two(0);
    b.four(0100644ULL << 16).four(or_limit(m.offset)).text(m.name);
    if (extra != 0) b.two(zip64_field).two(field.all().size()).text(field.all());
    return b.all();
}

void NpzWriter::begin(const std::string& name, const std::string& descr) {
    members_.push_back({name + ".npy", descr, size_});
    put(local_header(members_.back()));
    put(npy_header_of(descr, {}));
    numbers_ = checksum_of(0, {});
}

void NpzWriter::write(std::string_view bytes) {
    numbers_ = checksum_of(numbers_, bytes);
    members_.back().size += bytes.size();
    put(bytes);
}

void NpzWriter::end(const std::vector<std::uint64_t>& shape) {
    Member& m = members_.back();
    const std::string header = npy_header_of(m.descr, shape);
    m.checksum =
        static_cast<std::uint32_t>(::crc32_combine(checksum_of(0, header), numbers_, static_cast<z_off_t>(m.size)));
    m.size += header.size();
    file_.replace(m.offset, local_header(m) + header);
}

Status NpzWriter::commit() {
    const std::uint64_t begin = size_;
    for (const Member& m : members_) put(central_header(m));
    const std::uint64_t end = size_, count = members_.size();
    Bytes b;
    if (begin >= zip_limit || end - begin >= zip_limit) {
        b.four(0x06064b50).eight(44).two(3U << 8 | zip64_version).two(zip64_version).four(0).four(0);
        b.eight(count).eight(count).eight(end - begin).eight(begin);
        b.four(0x07064b50).four(0).eight(end).four(1);
    }
    b.four(0x06054b50).two(0).two(0).two(count).two(count).four(or_limit(end - begin)).four(or_limit(begin)).two(0);
    put(b.all());
    return file_.commit();
}

}  // namespace barycert::io

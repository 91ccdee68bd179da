#include <libdeflate.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/result.hpp"
#include "files/descriptor.hpp"
#include "files/input_file.hpp"

namespace barycert::base {
namespace {

/// Half of the machine's memory, and no more than any table of numbers takes: 200 times its size and 256 MiB.
std::size_t most_unpacked(std::size_t packed) {
    const auto memory =
        static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    constexpr std::size_t least = std::size_t{256} << 20;
    return std::min(memory / 2, least + 200 * std::min(packed, memory / 200));
}

/// All members, one after the other, and how many bytes that made. The file has `room`, memory as far as it is filled.
libdeflate_result unpack_members(std::string_view packed, int plain, std::size_t room, std::size_t& size) {
    const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> own(
        libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (own == nullptr || ::ftruncate(plain, static_cast<off_t>(room)) != 0) return LIBDEFLATE_INSUFFICIENT_SPACE;
    const Mapping bytes = map_memory(room, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, plain);
    libdeflate_result result = bytes == nullptr ? LIBDEFLATE_INSUFFICIENT_SPACE : LIBDEFLATE_SUCCESS;
    for (size = 0; !packed.empty() && result == LIBDEFLATE_SUCCESS;) {
        std::size_t in = 0, out = 0;
        result = libdeflate_gzip_decompress_ex(own.get(), packed.data(), packed.size(), bytes.get() + size, room - size,
                                               &in, &out);
        packed.remove_prefix(result == LIBDEFLATE_SUCCESS ? in : 0);
        size += out;
    }
    return result;
}

bool is_packed(int descriptor, struct stat& status) {
    std::array<char, 2> magic{};
    return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
           ::pread(descriptor, magic.data(), magic.size(), 0) == 2 && magic == std::array<char, 2>{'\x1f', '\x8b'};
}

/// Checked out without Git LFS, a file is a few lines that say where it is.
bool is_lfs_pointer(int descriptor) {
    constexpr std::string_view begin = "version https://git-lfs.github.com/spec/";
    std::array<char, begin.size()> head{};
    return ::pread(descriptor, head.data(), head.size(), 0) == static_cast<ssize_t>(head.size()) &&
           std::string_view(head.data(), head.size()) == begin;
}

}  // namespace

std::optional<std::string> unpacked_head(int descriptor, std::size_t size) {
    struct stat status {};
    z_stream stream{};
    // Deflated bytes are never much longer than what they stand for.
    std::string packed(size + size / 4 + 4096, '\0'), head(size, '\0');
    const Result<std::size_t> there =
        is_packed(descriptor, status) ? read_at(descriptor, 0, packed, "") : std::size_t{0};
    constexpr int gzip = 16, largest_window = 15;
    if (!there || ::inflateInit2(&stream, largest_window + gzip) != Z_OK) return std::nullopt;
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(*there);
    stream.next_out = reinterpret_cast<Bytef*>(head.data());
    stream.avail_out = static_cast<uInt>(size);
    const int state = ::inflate(&stream, Z_SYNC_FLUSH);
    head.resize(size - stream.avail_out);
    ::inflateEnd(&stream);
    return state == Z_OK || state == Z_STREAM_END ? std::optional(std::move(head)) : std::nullopt;
}

Status unpack(int& descriptor, const std::string& path, Text text) {
    if (is_lfs_pointer(descriptor))
        return file_error("file.format", path, "this is a pointer of Git LFS, and not the file that it stands for", {},
                          {}, "fetch the file with `git lfs pull`");
    struct stat status {};
    if (!is_packed(descriptor, status)) return Done{};
    if (text != Text::none) {
        const std::string head = unpacked_head(descriptor, first_block).value_or("");
        if (Status begins = check_beginning(head, text, path); !begins) return begins;
    }
    std::string packed(static_cast<std::size_t>(status.st_size), '\0');
    const Result<std::size_t> there = read_at(descriptor, 0, packed, path);
    if (!there) return there.error();
    packed.resize(*there);  // it may have become shorter
    Descriptor plain(::memfd_create("barycert-unpacked", MFD_CLOEXEC));
    if (!plain) return read_failure(path, errno);
    // The last four bytes are the size of the last member, which is mostly the only one.
    const std::size_t most = most_unpacked(packed.size());
    std::uint32_t hint = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, packed.size()); ++i)
        hint = hint << 8 | static_cast<unsigned char>(packed[packed.size() - 1 - i]);
    libdeflate_result result = LIBDEFLATE_INSUFFICIENT_SPACE;
    std::size_t size = 0;
    for (const std::size_t length : {std::clamp<std::size_t>(hint, 1, most), most}) {
        if (result == LIBDEFLATE_INSUFFICIENT_SPACE) result = unpack_members(packed, plain.number, length, size);
    }
    if (result == LIBDEFLATE_SUCCESS && ::ftruncate(plain.number, static_cast<off_t>(size)) == 0) {
        std::swap(descriptor, plain.number);
        return Done{};
    }
    if (result == LIBDEFLATE_INSUFFICIENT_SPACE)
        return file_error("file.too-large", path,
                          "the file is packed by gzip, and takes too much memory once it is unpacked",
                          "at most " + std::to_string(most) + " bytes", "more", "unpack it before, if you trust it");
    return file_error("file.packed", path, "the file is packed by gzip, and cannot be unpacked",
                      "whole members, each with its checksum", "others", "copy it again, or pack it again");
}

}  // namespace barycert::base

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "audit/kernels/registry.hpp"
#include "barycert/result.hpp"
#include "files/input_file.hpp"

namespace barycert::kernels {
namespace {

// ElfW names the structures of this process's class, which a library it loads must share.
using FileHeader = ElfW(Ehdr);
using ProgramHeader = ElfW(Phdr);
using SectionHeader = ElfW(Shdr);

constexpr unsigned char own_class = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
constexpr unsigned char own_order = std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;
#if defined(__x86_64__)
constexpr std::uint16_t own_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr std::uint16_t own_machine = EM_AARCH64;
#else
constexpr std::uint16_t own_machine = EM_NONE;  // left to dlopen, which tells it less clearly
#endif

constexpr const char* cannot_load = "cannot load the kernel library";

class ElfFile {
public:
    ElfFile(const std::string& path, base::InputFile file) : path_(path), file_(std::move(file)) {}

    /// Throws an Exception, as all below do.
    void check() {
        read_header();
        check_parts<ProgramHeader>(header_.e_phoff, header_.e_phnum, header_.e_phentsize);
        check_parts<SectionHeader>(header_.e_shoff, header_.e_shnum, header_.e_shentsize);
    }

private:
    void read_header() {
        const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(file_.size(), sizeof header_));
        if (size == 0) foreign("an empty file");
        read(0, &header_, size);
        if (std::memcmp(header_.e_ident, ELFMAG, std::min<std::size_t>(size, SELFMAG)) != 0) foreign("another format");
        if (size < sizeof header_) cut();
        if (header_.e_ident[EI_CLASS] != own_class || header_.e_ident[EI_DATA] != own_order ||
            (own_machine != EM_NONE && header_.e_machine != own_machine))
            foreign("ELF for another machine");
        if (header_.e_type != ET_DYN) foreign("ELF of another kind, as object files are");
    }

    /// The table of `count` headers at `offset`, and the part of the file that each of them names.
    template <class Header>
    void check_parts(std::uint64_t offset, std::size_t count, std::size_t entry) const {
        if (count != 0 && entry != sizeof(Header)) foreign("ELF with headers of another size");
        if (!within(offset, count * sizeof(Header))) cut();
        std::vector<Header> headers(count);
        if (count != 0) read(offset, headers.data(), count * sizeof(Header));
        if (!std::ranges::all_of(headers, [&](const Header& h) { return holds(h); })) cut();
    }
    bool holds(const ProgramHeader& h) const { return h.p_type == PT_NULL || within(h.p_offset, h.p_filesz); }
    bool holds(const SectionHeader& h) const {
        return h.sh_type == SHT_NULL || h.sh_type == SHT_NOBITS || within(h.sh_offset, h.sh_size);
    }
    bool within(std::uint64_t offset, std::uint64_t size) const {
        return offset <= file_.size() && size <= file_.size() - offset;
    }

    void read(std::uint64_t offset, void* to, std::size_t size) const {
        if (file_.read_at(offset, {static_cast<char*>(to), size}, path_).value() != size) cut();
    }

    [[noreturn]] void foreign(const char* found) const {
        throw Exception(file_error("kernel.load", path_, cannot_load, "a shared library (ELF) for this machine", found,
                                   "build it on this machine with -shared -fPIC"));
    }
    [[noreturn]] void cut() const {
        throw Exception(file_error("kernel.load", path_, cannot_load, "a complete file, as its headers declare",
                                   "the end of the file, after " + std::to_string(file_.size()) + " bytes",
                                   "the file is truncated: build or copy it again"));
    }

    const std::string& path_;
    base::InputFile file_;
    FileHeader header_{};
};

}  // namespace

Status check_shared_library(const std::string& path) try {
    Result<base::InputFile> file = base::InputFile::open(path, "copy the library to a regular file first");
    if (!file) {
        Error error = file.error();
        error.what = cannot_load;
        return error;
    }
    ElfFile(path, std::move(*file)).check();
    return Done{};
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert::kernels

#include "barycert/base/mapped_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <span>
#include <utility>

#include "barycert/base/large_pages.hpp"
#include "barycert/base/workers.hpp"

namespace barycert::base {
namespace {

/// What a thread reads at a time: a few large pages.
constexpr std::size_t block_size = 4 * large_page;

}  // namespace

Result<MappedFile> MappedFile::open(const std::string& path, int threads, Text text, const Header& header) {
    const Result<InputFile> file = InputFile::open(path);
    if (!file) return file.error();
    if (Status begins = file->check(text, path, header); !begins) return begins.error();
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    MappedFile result;
    const auto size = static_cast<std::size_t>(file->size());
    const std::size_t whole = (size + page - 1) / page * page + page;
    void* const memory = ::mmap(nullptr, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return read_failure(path, errno);
    ask_for_large_pages(memory, whole);
    char* const bytes = static_cast<char*>(memory);
    result.begin_ = bytes;
    result.mapped_ = whole;
    result.size_ = size;

    std::mutex mutex;
    Status status = Done{};
    share_work(threads, (size + block_size - 1) / block_size, [&](std::size_t block) {
        const std::size_t from = block * block_size;
        const std::span<char> part(bytes + from, std::min(block_size, size - from));
        const Result<std::size_t> got = file->read_at(from, part, path);
        if (got && *got == part.size()) return true;
        const std::lock_guard lock(mutex);
        if (!got) status = got.error();
        return false;
    });
    if (status) status = file->unchanged(path);
    if (!status) return status.error();
    return result;
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : begin_(std::exchange(other.begin_, "")),
      size_(std::exchange(other.size_, 0)),
      mapped_(std::exchange(other.mapped_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(begin_, other.begin_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

MappedFile::~MappedFile() {
    if (mapped_ != 0) ::munmap(const_cast<char*>(begin_), mapped_);
}

}  // namespace barycert::base

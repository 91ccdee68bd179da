#include "barycert/base/input_file.hpp"

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <span>

#include "barycert/base/large_pages.hpp"
#include "barycert/base/workers.hpp"

namespace barycert::base {
namespace {

/// What a thread reads at a time: a few large pages.
constexpr std::size_t block_size = 4 * large_page;

}  // namespace

Result<MappedFile> MappedFile::open(const std::string& path, int threads, Text text, const Header& header) {
    const Result<InputFile> file = InputFile::open(path, "save the data to a regular file first", text);
    if (!file) return file.error();
    if (Status begins = file->check(text, path, header); !begins) return begins.error();
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    MappedFile result;
    const auto size = static_cast<std::size_t>(file->size());
    const std::size_t whole = (size + page - 1) / page * page + page;
    result.memory_ = map_memory(whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS);
    result.size_ = size;
    char* const bytes = result.memory_.get();
    if (bytes == nullptr) return read_failure(path, errno);
    ask_for_large_pages(bytes, whole);

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

}  // namespace barycert::base

#include "barycert/base/mapped_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "barycert/base/input_file.hpp"

namespace barycert::base {

Result<MappedFile> MappedFile::open(const std::string& path) {
    const Result<InputFile> file = InputFile::open(path);
    if (!file) return file.error();
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const auto size = static_cast<std::size_t>(file->size());
    MappedFile result;
    const std::size_t whole = (size + page - 1) / page * page + page;
    // Zero pages first, the file over them; what the file does not cover stays zero.
    void* const zeros = ::mmap(nullptr, whole, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (zeros == MAP_FAILED) return read_failure(path, errno);
    result.begin_ = static_cast<const char*>(zeros);
    result.mapped_ = whole;
    if (size != 0 && ::mmap(zeros, size, PROT_READ, MAP_PRIVATE | MAP_FIXED, file->descriptor(), 0) == MAP_FAILED) {
        return read_failure(path, errno);
    }
    result.size_ = size;
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

void MappedFile::let_go(std::string_view part) const {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const auto offset = static_cast<std::size_t>(part.data() - begin_);
    const std::size_t first = (offset + page - 1) / page * page, last = (offset + part.size()) / page * page;
    if (first < last) ::madvise(const_cast<char*>(begin_) + first, last - first, MADV_DONTNEED);
}

}  // namespace barycert::base

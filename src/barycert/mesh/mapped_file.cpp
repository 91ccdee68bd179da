#include "barycert/mesh/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace barycert::detail {
namespace {

Error failure(const std::string& path, const char* what, std::string found, const char* remedy) {
    return {.what = what, .file = path, .line = 0, .expected = {}, .found = std::move(found), .remedy = remedy};
}

Error system_failure(const std::string& path, int error_number) {
    const char* remedy = "check the path and the disk";
    if (error_number == ENOENT || error_number == ENOTDIR) remedy = "check the path";
    if (error_number == EACCES) remedy = "ask for permission to read it";
    return failure(path, "cannot read the file", std::strerror(error_number), remedy);
}

/// Closes the descriptor at the end of the scope; the mapping outlives it.
struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

}  // namespace

Result<MappedFile> MappedFile::open(const std::string& path) {
    // O_NONBLOCK: a named pipe without a writer must not hang here.
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    if (file.number < 0) return system_failure(path, errno);
    struct stat status {};
    if (::fstat(file.number, &status) != 0) return system_failure(path, errno);
    if (S_ISDIR(status.st_mode)) {
        return failure(path, "cannot read the file", "a folder", "name a file inside the folder");
    }
    if (!S_ISREG(status.st_mode)) {
        return failure(path, "cannot read the file", "a pipe or device", "save the data to a regular file first");
    }

    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const auto size = static_cast<std::size_t>(status.st_size);
    MappedFile result;
    const std::size_t whole = (size + page - 1) / page * page + page;
    // Zero pages first, the file over them; what the file does not cover stays zero.
    void* const zeros = ::mmap(nullptr, whole, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (zeros == MAP_FAILED) return system_failure(path, errno);
    result.begin_ = static_cast<const char*>(zeros);
    result.mapped_ = whole;
    if (size != 0 && ::mmap(zeros, size, PROT_READ, MAP_PRIVATE | MAP_FIXED, file.number, 0) == MAP_FAILED) {
        return system_failure(path, errno);
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

}  // namespace barycert::detail

#include "barycert/base/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace barycert::base {
namespace {

Error unfit(const std::string& path, std::string expected, const char* found, const char* remedy) {
    return {.what = "cannot read the file",
            .file = path,
            .expected = std::move(expected),
            .found = found,
            .remedy = remedy};
}

/// Opens and looks: without O_NONBLOCK a named pipe without a writer would hang here.
int open_without_waiting(const std::string& path, struct stat& status) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor >= 0 && ::fstat(descriptor, &status) != 0) {
        const int reason = errno;
        ::close(descriptor);
        errno = reason;
        return -1;
    }
    return descriptor;
}

}  // namespace

Error read_failure(const std::string& path, int error_number) {
    const char* remedy = "check the path and the disk";
    if (error_number == ENOENT || error_number == ENOTDIR) remedy = "check the path";
    if (error_number == EACCES) remedy = "ask for permission to read it";
    if (error_number == EISDIR) remedy = "name a file inside the folder";
    return {.what = "cannot read the file", .file = path, .found = std::strerror(error_number), .remedy = remedy};
}

Error unended_number(std::string path, std::size_t line) {
    return {.what = "the last row has no line end, so the file may be cut short",
            .file = std::move(path),
            .line = line,
            .expected = "a line end",
            .found = "the end of the file",
            .remedy = "if nothing is missing, end the last line, as echo >> FILE does"};
}

Result<InputFile> InputFile::open(const std::string& path, const char* remedy) {
    struct stat status {};
    InputFile file;
    file.descriptor_ = open_without_waiting(path, status);
    if (file.descriptor_ < 0) return read_failure(path, errno);
    if (S_ISDIR(status.st_mode)) return unfit(path, "a regular file", "a folder", "name a file inside the folder");
    if (!S_ISREG(status.st_mode)) return unfit(path, "a regular file", "a pipe or device", remedy);
    file.size_ = static_cast<std::uint64_t>(status.st_size);
    return file;
}

InputFile::InputFile(InputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), size_(std::exchange(other.size_, 0)) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(size_, other.size_);
    return *this;
}

InputFile::~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Result<std::size_t> InputFile::read_at(std::uint64_t offset, std::span<char> bytes, const std::string& path) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got =
            ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return read_failure(path, errno);
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

Result<std::string> read_file(const std::string& path, std::size_t longest) {
    struct stat status {};
    InputFile file;
    file.descriptor_ = open_without_waiting(path, status);
    if (file.descriptor_ < 0) return read_failure(path, errno);
    const bool pipe = S_ISFIFO(status.st_mode);
    if (S_ISDIR(status.st_mode)) {
        return unfit(path, "a regular file or a pipe", "a folder", "name a file inside the folder");
    }
    if (!pipe && !S_ISREG(status.st_mode)) {
        return unfit(path, "a regular file or a pipe", "a device", "save the data to a regular file first");
    }
    // From now on a pipe waits for those who have it open, and has ended if nobody has.
    if (pipe && ::fcntl(file.descriptor_, F_SETFL, 0) != 0) return read_failure(path, errno);

    // The size is a hint: files of the system tell 0, and a file may grow.
    std::string bytes(pipe ? 0 : static_cast<std::size_t>(status.st_size) + 1, '\0');
    std::size_t have = 0;
    while (true) {
        if (have == bytes.size()) bytes.resize(have + std::max<std::size_t>(have / 2, std::size_t{1} << 16));
        const ssize_t got = ::read(file.descriptor_, bytes.data() + have, bytes.size() - have);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return read_failure(path, errno);
        if (got == 0) break;
        have += static_cast<std::size_t>(got);
        if (pipe && have > longest) {
            return unfit(path, "at most " + std::to_string(longest) + " bytes from a pipe", "more",
                         "save the data to a regular file first");
        }
    }
    if (pipe && have == 0) {
        return unfit(path, "data", "nothing: a pipe that nobody writes to",
                     "start its writer first, or name a regular file");
    }
    bytes.resize(have);
    return bytes;
}

}  // namespace barycert::base

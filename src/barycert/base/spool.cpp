#include "barycert/base/spool.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

namespace barycert::base {
namespace {

constexpr std::size_t spool_memory = std::size_t{1} << 20;

/// A file that nobody else can name, open for reading and writing; -1 if the folder has no place for it.
int nameless_file(const std::string& folder) {
    int descriptor = -1;
#ifdef O_TMPFILE
    descriptor = ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0600);
#endif
    if (descriptor >= 0) return descriptor;
    std::string name = folder + "/barycert-XXXXXX";
    descriptor = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor >= 0) ::unlink(name.c_str());
    return descriptor;
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

}  // namespace

Spool::Spool(Spool&& other) noexcept
    : target_(std::move(other.target_)),
      held_(std::move(other.held_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(std::exchange(other.size_, 0)),
      mapped_(std::exchange(other.mapped_, nullptr)) {}

Spool::~Spool() {
    if (mapped_ != nullptr) ::munmap(const_cast<char*>(mapped_), size_);
    if (descriptor_ >= 0) ::close(descriptor_);
}

Error Spool::failure(const char* what, int error_number) const {
    return {.what = what,
            .file = target_,
            .found = std::strerror(error_number),
            .remedy = "free some space there, or in the folder for temporary files (TMPDIR)"};
}

Status Spool::spill() {
    if (descriptor_ < 0) {
        descriptor_ = nameless_file(folder_of(target_));
        const char* const temporary = std::getenv("TMPDIR");
        if (descriptor_ < 0)
            descriptor_ = nameless_file(temporary != nullptr && *temporary != '\0' ? temporary : "/tmp");
        if (descriptor_ < 0) return failure("cannot make a file for rows beside the target", errno);
    }
    std::string_view rest = held_;
    while (!rest.empty()) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written >= 0) {
            rest.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            return failure("cannot keep rows beside the target", errno);
        }
    }
    held_.clear();
    return Done{};
}

Status Spool::append_bytes(std::string_view bytes) {
    size_ += bytes.size();
    held_ += bytes;
    return held_.size() < spool_memory ? Status(Done{}) : spill();
}

Status Spool::finish() {
    if (descriptor_ < 0) return Done{};
    if (Status done = spill(); !done) return done;
    void* const mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor_, 0);
    if (mapped == MAP_FAILED) return failure("cannot read rows that were kept beside the target", errno);
    mapped_ = static_cast<const char*>(mapped);
    return Done{};
}

}  // namespace barycert::base

#include "files/spool.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "barycert/result.hpp"
#include "files/descriptor.hpp"

namespace barycert::base {
namespace {

constexpr std::size_t spool_memory = std::size_t{1} << 20;

/// A file that nobody else can name, open for reading and writing; none if the folder has no place for it.
Descriptor nameless_file(const std::string& folder) {
#ifdef O_TMPFILE
    if (Descriptor file(::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0600)); file) return file;
#endif
    std::string name = folder + "/barycert-XXXXXX";
    Descriptor file(::mkostemp(name.data(), O_CLOEXEC));
    if (file) ::unlink(name.c_str());
    return file;
}

}  // namespace

Error Spool::failure(const char* what, int error_number) const {
    return file_error("file.unwritable", target_, what, {}, std::strerror(error_number),
                      "free some space there, or in the folder for temporary files (TMPDIR)");
}

Status Spool::spill() {
    if (!file_) {
        file_ = nameless_file(folder_of(target_));
        const char* const temporary = std::getenv("TMPDIR");
        if (!file_) file_ = nameless_file(temporary != nullptr && *temporary != '\0' ? temporary : "/tmp");
        if (!file_) return failure("cannot make a file for rows beside the target", errno);
    }
    if (!file_.write(held_)) return failure("cannot keep rows beside the target", errno);
    held_.clear();
    return Done{};
}

Status Spool::append_bytes(std::string_view bytes) {
    size_ += bytes.size();
    held_ += bytes;
    return held_.size() < spool_memory ? Status(Done{}) : spill();
}

Status Spool::finish() {
    if (!file_) return Done{};
    if (Status done = spill(); !done) return done;
    mapped_ = map_memory(size_, PROT_READ, MAP_PRIVATE, file_.number);
    if (mapped_ == nullptr) return failure("cannot read rows that were kept beside the target", errno);
    return Done{};
}

}  // namespace barycert::base

#include "barycert/base/spill_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace barycert::base {
namespace {

constexpr std::size_t spill_buffer = std::size_t{1} << 18;

}  // namespace

SpillFile::SpillFile(std::string beside) : beside_(std::move(beside)) {
    const std::size_t slash = beside_.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : beside_.substr(0, slash + 1);
#ifdef O_TMPFILE
    descriptor_ = ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_EXCL | O_CLOEXEC, 0600);
#endif
    if (descriptor_ >= 0) return;
    std::string name = beside_ + ".spill-XXXXXX";
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) {
        fail(errno);
    } else {
        ::unlink(name.c_str());
    }
}

SpillFile::~SpillFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void SpillFile::write(std::string_view bytes) {
    size_ += bytes.size();
    while (!bytes.empty()) {
        const std::size_t step = std::min(bytes.size(), spill_buffer - buffer_.size());
        buffer_.append(bytes.substr(0, step));
        bytes.remove_prefix(step);
        if (buffer_.size() == spill_buffer) flush();
    }
}

void SpillFile::flush() {
    std::string_view rest = buffer_;
    while (!rest.empty() && error_.what.empty()) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written >= 0) {
            rest.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            fail(errno);
        }
    }
    buffer_.clear();
}

Status SpillFile::status() const {
    if (!error_.what.empty()) return error_;
    return Done{};
}

Status SpillFile::read(const std::function<void(std::string_view)>& take) {
    flush();
    std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(size_, spill_buffer)), '\0');
    for (std::uint64_t at = 0; at < size_ && error_.what.empty();) {
        const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(size_ - at, bytes.size()));
        std::size_t have = 0;
        while (have < wanted && error_.what.empty()) {
            const ssize_t got = ::pread(descriptor_, bytes.data() + have, wanted - have, static_cast<off_t>(at + have));
            if (got > 0) {
                have += static_cast<std::size_t>(got);
            } else if (got == 0 || errno != EINTR) {
                fail(got == 0 ? EIO : errno);
            }
        }
        if (error_.what.empty()) take(std::string_view(bytes).substr(0, wanted));
        at += wanted;
    }
    return status();
}

void SpillFile::fail(int error_number) {
    if (!error_.what.empty()) return;
    error_.file = beside_;
    error_.what = "cannot keep data in a temporary file beside the output";
    error_.found = std::strerror(error_number);
    error_.remedy = "free some space, or write to another folder";
}

}  // namespace barycert::base

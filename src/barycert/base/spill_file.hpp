/// Bytes that are kept on disk for a while, because they may be too many for memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "barycert/result.hpp"

namespace barycert::base {

/// A file without a name in the folder of `beside`, where there will be room for the output that it is for; it is gone
/// with the object, and with the process by whatever end. Errors are kept and told by status() and read().
class SpillFile {
public:
    explicit SpillFile(std::string beside);
    ~SpillFile();
    SpillFile(const SpillFile&) = delete;
    SpillFile& operator=(const SpillFile&) = delete;

    void write(std::string_view bytes);
    std::uint64_t size() const { return size_; }
    Status status() const;

    /// Calls take(bytes) with all that was written, in its order, piece by piece: each but the last a multiple of 2^16
    /// bytes.
    Status read(const std::function<void(std::string_view)>& take);

private:
    void fail(int error_number);
    void flush();

    std::string beside_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    std::string buffer_;
    Error error_;
};

}  // namespace barycert::base

/// A file's bytes in memory.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "barycert/base/input_file.hpp"
#include "barycert/result.hpp"

namespace barycert::base {

/// A regular file, read whole. At least one page of zero bytes follows the last byte, so that a scanner may look ahead,
/// and stops at a NUL instead of comparing with the end at every step.
///
/// The memory is the process's own: the system ends a process that touches bytes of a mapped file when they are gone.
class MappedFile {
public:
    MappedFile() = default;
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;
    ~MappedFile();

    /// Reads on so many threads, 0: one per core. Errors: missing, unreadable, a folder, not a regular file, one that
    /// does not begin as `text` and `header` say, changed while it was read, larger than the memory.
    static Result<MappedFile> open(const std::string& path, int threads = 1, Text text = Text::none,
                                   const Header& header = {});

    std::string_view bytes() const { return {begin_, size_}; }

private:
    const char* begin_ = "";
    std::size_t size_ = 0;
    std::size_t mapped_ = 0;  // the size of the whole mapping; 0: none
};

}  // namespace barycert::base

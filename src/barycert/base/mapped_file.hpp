/// A file's bytes in memory, without a copy.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "barycert/result.hpp"

namespace barycert::base {

/// A regular file, mapped for reading. At least one page of zero bytes follows the last byte, so that a scanner may
/// look ahead, and stops at a NUL instead of comparing with the end at every step.
///
/// The file must not shrink while it is mapped: the system ends a process that touches bytes that are gone.
class MappedFile {
public:
    MappedFile() = default;
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;
    ~MappedFile();

    /// Errors: missing, unreadable, a folder, not a regular file.
    static Result<MappedFile> open(const std::string& path);

    std::string_view bytes() const { return {begin_, size_}; }

    /// Lets go of the memory of whole pages within `part` of the bytes. They can still be read, and then come back.
    void let_go(std::string_view part) const;

private:
    const char* begin_ = "";
    std::size_t size_ = 0;
    std::size_t mapped_ = 0;  // the size of the whole mapping; 0: none
};

}  // namespace barycert::base

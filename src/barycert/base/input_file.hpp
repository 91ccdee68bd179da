/// Files that are read, opened without waiting, and told apart from folders, pipes and devices in one place.
///
/// The rule. A file that is mapped or read by places (meshes, NPY, maps, kernel libraries) is a regular file. One that
/// is read whole and once (PLCs, witnesses) may be a pipe, too, such as a shell makes for <(...). Neither waits for
/// somebody to open the other end of a named pipe. Streams of points are no such files: see io/csv/line_reader.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "barycert/result.hpp"

namespace barycert::base {

/// A regular file open for reading; closed at the end.
class InputFile {
public:
    /// Errors: missing, unreadable, a folder, a pipe or device (for which `remedy` says what to do).
    static Result<InputFile> open(const std::string& path,
                                  const char* remedy = "save the data to a regular file first");

    InputFile() = default;
    InputFile(InputFile&& other) noexcept;
    InputFile& operator=(InputFile&& other) noexcept;
    ~InputFile();

    int descriptor() const { return descriptor_; }

    /// Fills `bytes` from `offset` on and returns how many there were: fewer only where the file ends. `path`: for the
    /// Error if it cannot be read.
    Result<std::size_t> read_at(std::uint64_t offset, std::span<char> bytes, const std::string& path) const;

    /// In bytes, when it was opened.
    std::uint64_t size() const { return size_; }

private:
    friend Result<std::string> read_file(const std::string& path, std::size_t longest);

    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// What is read of a pipe at most, for it does not tell its size: 256 MiB.
inline constexpr std::size_t longest_pipe = std::size_t{1} << 28;

/// All bytes of a regular file, or of a pipe up to its end. Errors: missing, unreadable, a folder, a device, a pipe
/// that nobody writes to, one that holds more than `longest` bytes.
Result<std::string> read_file(const std::string& path, std::size_t longest = longest_pipe);

/// That the system could not open or read the file, in its words, and what to do.
Error read_failure(const std::string& path, int error_number);

/// That a text ends in a number and not in a line end: what is there may be cut, and 0.2 the beginning of 0.25.
Error unended_number(std::string path, std::size_t line);

}  // namespace barycert::base

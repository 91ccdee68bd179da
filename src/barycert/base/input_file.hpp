/// Files that are read, opened without waiting, and told apart from folders, pipes and devices in one place.
///
/// The rule. A file that is read at once or by places (meshes, NPY, maps, kernel libraries) is a regular file. One that
/// is read whole and once (PLCs, witnesses) may be a pipe, too, such as a shell makes for <(...). Neither waits for
/// somebody to open the other end of a named pipe. What gzip packed is unpacked (unpack.hpp). Streams of points are no
/// such files: see io/csv/line_reader.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "barycert/result.hpp"

namespace barycert::base {

/// What a file that is to be read is asked for by its first block, so that gigabytes of zeros or of something else are
/// an error at once.
enum class Text : std::uint8_t {
    none,   ///< nothing
    words,  ///< something but blanks
    head,   ///< text up to the first line end or tag, by which such formats begin; data may follow
    all,    ///< text
    json,   ///< text of an object or array of JSON
};
inline constexpr std::size_t first_block = std::size_t{1} << 16;

/// What the format says to the first block of a larger file, of `size` bytes: the error of its header, if it has one
/// there. A NUL follows the block.
using Header = std::function<Status(std::string_view block, std::uint64_t size)>;

/// Whether `block`, the first of a file, can begin one: no NUL byte, a word that ends. A smaller block always can.
Status check_beginning(std::string_view block, Text text, const std::string& path);

/// What tells that a file was changed.
struct FileState {
    std::uint64_t size = 0;  ///< in bytes
    timespec written{};
};

/// Error: the file has another state than then.
Status unchanged(int descriptor, const FileState& then, const std::string& path);

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

    /// check_beginning() of its first block, and what the format says to it.
    Status check(Text text, const std::string& path, const Header& header = {}) const;

    /// Fills `bytes` from `offset` on and returns how many there were: fewer only where the file ends. `path`: for the
    /// Error if it cannot be read.
    Result<std::size_t> read_at(std::uint64_t offset, std::span<char> bytes, const std::string& path) const;

    /// In bytes, when it was opened.
    std::uint64_t size() const { return then_.size; }

    /// Error: it has another size than when it was opened, or was written to.
    Status unchanged(const std::string& path) const { return base::unchanged(descriptor_, then_, path); }

private:
    friend Result<std::string> read_file(const std::string& path, std::size_t longest, Text text, const Header& header);

    int descriptor_ = -1;
    FileState then_;
};

/// What is read of a pipe at most, for it does not tell its size: 256 MiB.
inline constexpr std::size_t longest_pipe = std::size_t{1} << 28;

/// All bytes of a regular file, or of a pipe up to its end. Errors: missing, unreadable, a folder, a device, a pipe
/// that nobody writes to, one that holds more than `longest` bytes, one that does not begin as `text` and `header` say.
Result<std::string> read_file(const std::string& path, std::size_t longest = longest_pipe, Text text = Text::none,
                              const Header& header = {});

/// That the system could not open or read the file, in its words, and what to do.
Error read_failure(const std::string& path, int error_number);

/// That a text ends in a number and not in a line end: what is there may be cut, and 0.2 the beginning of 0.25.
Error unended_number(std::string path, std::size_t line);

/// That memory was short while the file was read.
Error too_little_memory(std::string path);

}  // namespace barycert::base

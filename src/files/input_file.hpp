/// Files that are read, opened without waiting, and told apart from folders, pipes and devices in one place.
///
/// A file that is read at once or by places (meshes, NPY, maps, kernel libraries) is a regular file; one that is read
/// whole and once (PLCs, witnesses) may be a pipe, as of <(...). Neither waits for the other end of a named pipe. What
/// gzip packed is unpacked: unpack(). Streams of points: io/csv/line_reader.hpp.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <ctime>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/result.hpp"
#include "files/descriptor.hpp"

namespace barycert::base {

/// Kinds of first blocks that a reader accepts, so that gigabytes of zeros or of something else are an error at once.
enum class Text : std::uint8_t {
    none,   ///< nothing
    words,  ///< something but blanks
    head,   ///< text up to the first line end or tag, by which such formats begin; data may follow
    all,    ///< text
    json,   ///< text of an object or array of JSON
};
inline constexpr std::size_t first_block = std::size_t{1} << 16;

/// Checks the header in the first block of a larger file of `size` bytes. Error: the header is wrong. A NUL follows the
/// block.
using Header = std::function<Status(std::string_view block, std::uint64_t size)>;

/// Whether `block`, the first of a file, can begin one: no NUL byte, a word that ends. A smaller block always can.
Status check_beginning(std::string_view block, Text text, const std::string& path);

struct FileState {
    std::uint64_t size = 0;  ///< in bytes
    timespec written{};
};

/// Error: the file has another state than then.
Status unchanged(int descriptor, const FileState& then, const std::string& path);

/// Fills `bytes` from `offset` on and returns how many there were: fewer only where the file ends. `path`: for errors.
Result<std::size_t> read_at(int descriptor, std::uint64_t offset, std::span<char> bytes, const std::string& path);

/// The remedy for a pipe or device where only a regular file will do.
inline constexpr const char* save_first = "save the data to a regular file first";

/// A regular file open for reading; closed at the end.
class InputFile {
public:
    /// Errors: missing, unreadable, a folder, a pipe or device (for which `remedy` says what to do), packed and not
    /// beginning as `text` says. `pipe`, if given, lets it be a pipe, and is set if it is one.
    static Result<InputFile> open(const std::string& path, const char* remedy = save_first, Text text = Text::none,
                                  bool* pipe = nullptr);

    /// Its first bytes, as many as that or fewer where it ends: of a packed file these alone are unpacked.
    static Result<std::string> head(const std::string& path, std::size_t size);

    int descriptor() const { return file_.number; }

    /// check_beginning() of its first block, and what the format says to it.
    Status check(Text text, const std::string& path, const Header& header = {}) const;

    Result<std::size_t> read_at(std::uint64_t offset, std::span<char> bytes, const std::string& path) const {
        return base::read_at(file_.number, offset, bytes, path);
    }

    /// In bytes, when it was opened.
    std::uint64_t size() const { return then_.size; }

    Status unchanged(const std::string& path) const { return base::unchanged(file_.number, then_, path); }

private:
    Descriptor file_;
    FileState then_;
};

/// The most that is read of a pipe, which does not tell its size: 256 MiB.
inline constexpr std::size_t longest_pipe = std::size_t{1} << 28;

/// All bytes of a regular file, or of a pipe up to its end. Errors: missing, unreadable, a folder, a device, a pipe
/// that nobody writes to, one that holds more than `longest` bytes, one that does not begin as `text` and `header` say.
Result<std::string> read_file(const std::string& path, std::size_t longest = longest_pipe, Text text = Text::none,
                              const Header& header = {});

/// Returns the error that the system could not open or read the file, in the system's words, and what to do.
Error read_failure(const std::string& path, int error_number);

/// Returns the error that a text ends in a number and not in a line end: it may be cut, and 0.2 the beginning of 0.25.
Error unended_number(std::string path, std::size_t line);

Error too_little_memory(std::string path);

/// A regular file, read whole. At least one page of zero bytes follows the last byte, so that a scanner may look ahead,
/// and stops at a NUL instead of comparing with the end at every step.
///
/// The memory is the process's own: the system ends a process that touches bytes of a mapped file when they are gone.
class MappedFile {
public:
    /// Reads on so many threads, 0: one per core. Errors: also, it was changed meanwhile, or is larger than the memory.
    static Result<MappedFile> open(const std::string& path, int threads = 1, Text text = Text::none,
                                   const Header& header = {});

    /// The first `size` bytes of an open file, as many as there are; those behind stand as zeros.
    static Result<MappedFile> read(const InputFile& file, const std::string& path, std::size_t size, int threads = 1);

    std::string_view bytes() const { return memory_ ? std::string_view(memory_.get(), size_) : ""; }

private:
    Mapping memory_;
    std::size_t size_ = 0;
};

/// A run lasts as long as this lives, on the thread that made it: whatever InputFile, read_file and readers of streams
/// open there is recorded, and an OutputFile refuses to replace it. A run within a run hands on what it has recorded.
/// Without a run nothing is recorded: who reads a file and then writes it by two calls of a library may do so.
class RunFiles {
public:
    RunFiles();
    ~RunFiles();
    RunFiles(const RunFiles&) = delete;
    RunFiles& operator=(const RunFiles&) = delete;

private:
    friend void record_input(int descriptor, const std::string& path);
    friend const std::string* input_of_run(const std::string& path);

    RunFiles* outer_;
    std::map<std::pair<dev_t, ino_t>, std::string> inputs_;  ///< by device and inode, whatever names lead there
};

/// The open file, if it is a regular one, is read by the run of this thread, if there is one.
void record_input(int descriptor, const std::string& path);

/// The path by which the run of this thread has opened the file that `path` leads to; nullptr if it has not.
const std::string* input_of_run(const std::string& path);

/// Where `descriptor` is a regular file packed by gzip, it becomes one of the unpacked bytes, without a name, in
/// memory. Error: it is damaged, too large (most_unpacked()), or does not begin as `text`.
Status unpack(int& descriptor, const std::string& path, Text text);

/// The first bytes of such a file, unpacked, or fewer where its first member ends. None: it is another, or damaged.
std::optional<std::string> unpacked_head(int descriptor, std::size_t size);

}  // namespace barycert::base

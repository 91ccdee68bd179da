#include "files/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/workers.hpp"
#include "files/descriptor.hpp"

namespace barycert::base {
namespace {

thread_local RunFiles* run_of_thread = nullptr;

constexpr const char* cannot_read = "cannot read the file";

/// Opens and looks: without O_NONBLOCK a named pipe without a writer would hang here.
Result<Descriptor> open_without_waiting(const std::string& path, struct stat& status) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file || ::fstat(file.number, &status) != 0) return read_failure(path, errno);
    record_input(file.number, path);
    return file;
}

}  // namespace

Error read_failure(const std::string& path, int error_number) {
    std::string remedy = "check the path and the disk";
    if (error_number == ENOENT || error_number == ENOTDIR) {
        const std::string near = near_file(path);
        remedy = near.empty() ? "check the path" : "did you mean " + near + "?";
    }
    if (error_number == EACCES) remedy = "ask for permission to read it";
    if (error_number == ENOMEM) remedy = "free some memory, or use a machine with more";
    if (error_number == EISDIR) remedy = "name a file inside the folder";
    return file_error(error_number == ENOENT ? ErrorCode("file.missing") : ErrorCode("file.unreadable"), path,
                      cannot_read, {}, std::strerror(error_number), remedy);
}

Error unended_number(std::string path, std::size_t line) {
    return {"file.truncated",
            "the last row has no line end, so the file may be cut short",
            std::move(path),
            line,
            "a line end",
            "the end of the file",
            "if nothing is missing, end the last line, as echo >> FILE does"};
}

Error too_little_memory(std::string path) {
    return file_error("memory.short", std::move(path), "too little memory to read the file", {}, {},
                      "free some memory, or check whether the file is damaged");
}

Result<InputFile> InputFile::open(const std::string& path, const char* remedy, Text text, bool* pipe) {
    struct stat status {};
    Result<Descriptor> opened = open_without_waiting(path, status);
    if (!opened) return opened.error();
    InputFile file;
    file.file_ = std::move(*opened);
    const char* const expected = pipe != nullptr ? "a regular file or a pipe" : "a regular file";
    const bool is_pipe = pipe != nullptr && S_ISFIFO(status.st_mode);
    if (S_ISDIR(status.st_mode))
        return file_error("file.unreadable", path, cannot_read, expected, "a folder", "name a file inside the folder");
    if (!is_pipe && !S_ISREG(status.st_mode))
        return file_error("file.pipe", path, cannot_read, expected, pipe != nullptr ? "a device" : "a pipe or device",
                          remedy);
    // From now on a pipe waits for those who have it open, and has ended if nobody has.
    if (is_pipe && ::fcntl(file.file_.number, F_SETFL, 0) != 0) return read_failure(path, errno);
    if (Status plain = unpack(file.file_.number, path, text); !plain) return plain.error();
    if (::fstat(file.file_.number, &status) != 0) return read_failure(path, errno);
    file.then_ = {static_cast<std::uint64_t>(status.st_size), status.st_mtim};
    if (pipe != nullptr) *pipe = is_pipe;
    return file;
}

Result<std::string> InputFile::head(const std::string& path, std::size_t size) {
    // A pipe is opened once: its writer would lose a reader who closes it.
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode)) {
        const Result<Descriptor> opened = open_without_waiting(path, status);
        if (!opened) return opened.error();
        if (std::optional<std::string> head = unpacked_head(opened->number, size)) return *std::move(head);
    }
    const Result<InputFile> file = open(path);
    if (!file) return file.error();
    std::string head(size, '\0');
    const Result<std::size_t> got = file->read_at(0, head, path);
    if (!got) return got.error();
    head.resize(*got);
    return head;
}

Status unchanged(int descriptor, const FileState& then, const std::string& path) {
    struct stat now {};
    if (::fstat(descriptor, &now) != 0) return read_failure(path, errno);
    const auto size = static_cast<std::uint64_t>(now.st_size);
    const bool same = size == then.size;
    if (same && now.st_mtim.tv_sec == then.written.tv_sec && now.st_mtim.tv_nsec == then.written.tv_nsec) return Done{};
    return file_error("file.changed", path, "the file was changed while it was read",
                      same ? "" : std::to_string(then.size) + " bytes, as when it was opened",
                      same ? "" : std::to_string(size), "read it again when its writer has finished");
}

Result<std::size_t> read_at(int descriptor, std::uint64_t offset, std::span<char> bytes, const std::string& path) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = TEMP_FAILURE_RETRY(
            ::pread(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done)));
        if (got < 0) return read_failure(path, errno);
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

Status check_beginning(std::string_view block, Text text, const std::string& path) {
    // The reader says more about a smaller file.
    if (text == Text::none || block.size() < first_block) return Done{};
    const std::string_view line = text != Text::head ? block : block.substr(0, block.find_first_of("\n>"));
    const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    const auto end = [&](char c) {
        return blank(c) || std::string_view(",;:\"[]{}()<>=").find(c) != std::string_view::npos;
    };
    const auto word = std::find_if_not(line.begin(), line.end(), blank);
    const auto* const first = std::find_if_not(block.begin(), block.end(), blank);
    std::string found;
    if (first == block.end()) {
        found = std::to_string(block.size()) + " bytes of blanks and line ends";
    } else if (text == Text::json && *first != '{' && *first != '[') {
        found = "no JSON";
    } else if (text != Text::words && line.find('\0') != std::string_view::npos) {
        found = "NUL bytes";
    } else if (text != Text::words && line.size() == block.size() &&
               std::find_if(word, line.end(), end) == line.end()) {
        found = std::to_string(block.size()) + " bytes without a word that ends";
    } else if (text == Text::head && word != line.end() &&
               std::string_view("<{#$(\xEF").find(*word) == std::string_view::npos) {
        found = "neither a tag nor a keyword";
    } else {
        return Done{};
    }
    return file_error("file.format", path, "the file does not begin as text", "words", std::move(found),
                      "check the path, or write the file again");
}

Status InputFile::check(Text text, const std::string& path, const Header& header) const {
    if (text == Text::none) return Done{};
    std::string block(first_block, '\0');
    const Result<std::size_t> size = read_at(0, block, path);
    if (!size) return size.error();
    // The format has more to say of what it knows.
    if (header && *size == first_block && then_.size > first_block) {
        if (Status begins = header(block, then_.size); !begins) return begins;
    }
    return check_beginning(std::string_view(block).substr(0, *size), text, path);
}

Result<std::string> read_file(const std::string& path, std::size_t longest, Text text, const Header& header) {
    bool pipe = false;
    const Result<InputFile> file = InputFile::open(path, save_first, text, &pipe);
    if (!file) return file.error();
    if (Status begins = pipe ? Status(Done{}) : file->check(text, path, header); !begins) return begins.error();
    // The size is a hint: files of the system tell 0, and a file may grow.
    std::string bytes(pipe ? 0 : static_cast<std::size_t>(file->size()) + 1, '\0');
    std::size_t have = 0;
    while (true) {
        if (have == bytes.size()) bytes.resize(have + std::max<std::size_t>(have / 2, std::size_t{1} << 16));
        const ssize_t got = TEMP_FAILURE_RETRY(::read(file->descriptor(), bytes.data() + have, bytes.size() - have));
        if (got < 0) return read_failure(path, errno);
        if (got == 0) break;
        have += static_cast<std::size_t>(got);
        if (pipe && have > longest)
            return file_error("file.too-large", path, cannot_read,
                              "at most " + std::to_string(longest) + " bytes from a pipe", "more", save_first);
    }
    if (pipe && have == 0)
        return file_error("file.empty", path, cannot_read, "data", "nothing: a pipe that nobody writes to",
                          "start its writer first, or name a regular file");
    bytes.resize(have);
    return bytes;
}

Result<MappedFile> MappedFile::open(const std::string& path, int threads, Text text, const Header& header) {
    const Result<InputFile> file = InputFile::open(path, save_first, text);
    if (!file) return file.error();
    if (Status begins = file->check(text, path, header); !begins) return begins.error();
    return read(*file, path, static_cast<std::size_t>(file->size()), threads);
}

Result<MappedFile> MappedFile::read(const InputFile& file, const std::string& path, std::size_t most, int threads) {
    // A thread reads a few large pages at a time.
    constexpr std::size_t block_size = 4 * large_page;
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    MappedFile result;
    const auto all = static_cast<std::size_t>(file.size());
    const std::size_t size = std::min(all, most), whole = (all + page - 1) / page * page + page;
    // Bytes that are not read need no memory.
    const int reserve = size == all ? 0 : MAP_NORESERVE;
    result.memory_ = map_memory(whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | reserve);
    result.size_ = all;
    char* const bytes = result.memory_.get();
    if (bytes == nullptr) return read_failure(path, errno);
    if (size == all) ask_for_large_pages(bytes, whole);

    std::mutex mutex;
    Status status = Done{};
    share_work(threads, (size + block_size - 1) / block_size, [&](std::size_t block) {
        const std::size_t from = block * block_size;
        const std::span<char> part(bytes + from, std::min(block_size, size - from));
        const Result<std::size_t> got = file.read_at(from, part, path);
        if (got && *got == part.size()) return true;
        const std::lock_guard lock(mutex);
        if (!got) status = got.error();
        return false;
    });
    if (status) status = file.unchanged(path);
    if (!status) return status.error();
    return result;
}

RunFiles::RunFiles() : outer_(run_of_thread) {
    run_of_thread = this;
}

RunFiles::~RunFiles() {
    run_of_thread = outer_;
    if (outer_ != nullptr) outer_->inputs_.merge(inputs_);
}

void record_input(int descriptor, const std::string& path) {
    struct stat status {};
    if (run_of_thread == nullptr || ::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;
    run_of_thread->inputs_.emplace(std::pair(status.st_dev, status.st_ino), path);
}

const std::string* input_of_run(const std::string& path) {
    struct stat status {};
    if (run_of_thread == nullptr || ::stat(path.c_str(), &status) != 0) return nullptr;
    for (const RunFiles* run = run_of_thread; run != nullptr; run = run->outer_) {
        const auto found = run->inputs_.find({status.st_dev, status.st_ino});
        if (found != run->inputs_.end()) return &found->second;
    }
    return nullptr;
}

}  // namespace barycert::base

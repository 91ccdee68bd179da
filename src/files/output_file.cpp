#include "files/output_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "barycert/result.hpp"
#include "files/descriptor.hpp"
#include "files/input_file.hpp"

namespace barycert::base {

/// The name of an unfinished file, in a list that only grows: a signal handler may walk it at any moment, without a
/// lock.
struct BegunName {
    const std::string path;
    std::atomic<bool> live{true};
    BegunName* next = nullptr;
};

namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 18;
constexpr const char* cannot_write_it = "cannot write the file";
constexpr const char* put_in_place = "cannot put the finished file in its place";

const char* remedy_for(int error_number) {
    const auto is = [&](std::initializer_list<int> numbers) { return std::ranges::count(numbers, error_number) != 0; };
    if (is({ENOENT, ENOTDIR})) return "make the folder first, or name another one";
    if (is({EISDIR})) return "name a file, not a folder";
    if (is({EACCES, EPERM, EROFS})) return "choose a folder and a file that you may write";
    if (is({ENOSPC, EDQUOT, EFBIG})) return "free some space, or write to another disk";
    if (is({EPIPE})) return "whatever read the output has stopped reading";
    return "check the path and the disk";
}

/// Where an open file can be found even if it has no name.
std::string path_of(int descriptor) {
    return "/proc/self/fd/" + std::to_string(descriptor);
}

/// The names of unfinished files, which are removed when a signal ends the process.
std::atomic<BegunName*> names{nullptr};
static_assert(std::atomic<BegunName*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "the signal handler reads them");

/// A name beside the target that no other file of this process has. Safe to call from any thread.
BegunName* begin_name(const std::string& target) {
    static std::atomic<unsigned> count{0};
    std::string path = target + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
    auto* const name = new BegunName{.path = std::move(path), .next = names.load()};
    while (!names.compare_exchange_weak(name->next, name)) {
    }
    return name;
}

/// Known before the handler is; on a terminal it begins a line, for progress may stand in this one.
std::string_view ended_by_signal;

/// Only calls that POSIX allows in a handler: unlink, write, sigaction, raise.
extern "C" void remove_and_end(int signal) {
    const int error_number = errno;
    remove_begun_files();
    const bool asked = signal == SIGINT || signal == SIGTERM || signal == SIGHUP;
    // Nobody is left to be told that this failed.
    [[maybe_unused]] const ssize_t told =
        asked ? ::write(STDERR_FILENO, ended_by_signal.data(), ended_by_signal.size()) : 0;
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    ::sigaction(signal, &usual, nullptr);
    ::raise(signal);  // blocked in its own handler: it ends the process when this returns
    errno = error_number;
}

}  // namespace

std::string resolved_path(std::string path) {
    constexpr int max_links = 40;  // the system's own limit
    for (int links = 0; links < max_links; ++links) {
        if (char* const real = ::realpath(path.c_str(), nullptr)) {
            std::string result = real;
            std::free(real);
            return result;
        }
        std::error_code none;
        const std::filesystem::path target = std::filesystem::read_symlink(path, none);
        if (none) return path;
        path = (std::filesystem::path(path).parent_path() / target).string();
    }
    return path;
}

OutputFile::OutputFile(std::string target) : target_(std::move(target)), real_path_(resolved_path(target_)) {
    if (target_.ends_with(".gz")) {
        error_ = file_error("file.suffix", target_, "files are not packed when they are written", "a name without .gz",
                            {}, "leave .gz out, then pack the file with gzip");
        return;
    }
    struct stat status {};
    const bool exists = ::stat(real_path_.c_str(), &status) == 0;
    if (!exists && errno == ELOOP) fail(cannot_write_it, ELOOP);
    if (exists && S_ISDIR(status.st_mode)) fail(cannot_write_it, EISDIR);
    refuse_input();
    // A rename would replace even a file that is write-protected.
    if (exists && ::access(real_path_.c_str(), W_OK) != 0) fail(cannot_write_it, errno);
    if (error_) return;
    if (exists && !S_ISREG(status.st_mode)) {
        file_ = Descriptor(::open(real_path_.c_str(), O_WRONLY | O_CLOEXEC));
        if (!file_) fail("cannot open the file for writing", errno);
        return;
    }
    if (!open_nameless()) open_beside();
    if (exists && file_ && ::fchmod(file_.number, status.st_mode & 07777U) != 0)
        fail("cannot give the new file the permissions of the old one", errno);
}

OutputFile::OutputFile()
    : target_("standard output"),
      // A copy, so that it can be closed and tell of errors. Not 0 to 2: a process may run with those closed.
      file_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
    if (!file_) fail("cannot open the file for writing", errno);
}

bool OutputFile::open_nameless() {
#ifdef O_TMPFILE
    file_ = Descriptor(::open(folder_of(real_path_).c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666));
    if (!file_) return false;  // the reason, where it is not just O_TMPFILE, is told by open_beside()
    // The name is given by way of /proc, which may not be there.
    struct stat status {};
    nameless_ = ::stat(path_of(file_.number).c_str(), &status) == 0 && S_ISREG(status.st_mode);
    if (!nameless_) file_.close();
#endif
    return nameless_;
}

void OutputFile::open_beside() {
    // O_EXCL: a name left over by a killed run, or planted as a link, is passed over.
    do {
        forget_name();
        begun_ = begin_name(real_path_);
        file_ = Descriptor(::open(begun_->path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    } while (!file_ && errno == EEXIST);
    if (file_) return;
    fail("cannot make a file beside the target", errno);
    forget_name();
}

OutputFile::~OutputFile() {
    file_.close();
    if (begun_ != nullptr) ::unlink(begun_->path.c_str());
    forget_name();
}

/// It is gone, or belongs to a finished file.
void OutputFile::forget_name() {
    if (begun_ != nullptr) begun_->live = false;
    begun_ = nullptr;
}

void OutputFile::write(std::string_view bytes) {
    if (!file_) return;
    if (buffer_.size() + bytes.size() > buffer_size) flush();
    if (bytes.size() >= buffer_size) return put(bytes);  // gathering it would be a copy for nothing
    buffer_ += bytes;
}

void OutputFile::replace(std::uint64_t offset, std::string_view bytes) {
    if (!file_) return;
    flush();
    put(bytes, static_cast<std::size_t>(offset));
}

void OutputFile::flush() {
    put(buffer_);
    buffer_.clear();
}

void OutputFile::put(std::string_view bytes, std::optional<std::size_t> offset) {
    if (!error_ && !file_.write(bytes, offset)) fail(cannot_write_it, errno);
}

Status OutputFile::close() {
    if (file_) flush();
    // Network file systems report a full disk only here. They know no nameless files, which must stay open.
    if (!nameless_ && !file_.close()) fail(cannot_write_it, errno);
    return status();
}

Status OutputFile::status() const {
    return error_ ? Status(*error_) : Done{};
}

/// True if the target itself is the name, so that nothing is left to rename.
bool OutputFile::give_name() {
    const std::string from = path_of(file_.number);
    const auto link = [&](const std::string& to) {
        return ::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), AT_SYMLINK_FOLLOW) == 0;
    };
    if (link(real_path_)) return true;
    // A link never replaces a file: an existing target takes a second name and a rename.
    while (errno == EEXIST) {
        forget_name();
        begun_ = begin_name(real_path_);
        if (link(begun_->path)) return false;
    }
    fail(put_in_place, errno);
    forget_name();
    return false;
}

void OutputFile::refuse_input() {
    const std::string* const input = input_of_run(real_path_);
    if (input == nullptr || error_) return;
    error_ = file_error("file.overwrite", target_, "the output would overwrite a file that is read", {}, *input,
                        "choose another name for the output");
}

Status OutputFile::commit() {
    refuse_input();
    if (Status closed = close(); !closed) return closed;
    if (nameless_) {
        const bool in_place = give_name();
        nameless_ = false;
        if (!file_.close()) fail(cannot_write_it, errno);
        if (in_place || error_) return status();
    }
    if (begun_ == nullptr) return Done{};
    if (std::rename(begun_->path.c_str(), real_path_.c_str()) != 0) {
        fail(put_in_place, errno);
    } else {
        forget_name();
    }
    return status();
}

void OutputFile::fail(const char* what, int error_number) {
    if (!error_)
        error_ =
            file_error("file.unwritable", target_, what, {}, std::strerror(error_number), remedy_for(error_number));
}

void remove_begun_files() noexcept {
    for (const BegunName* name = names.load(); name != nullptr; name = name->next) {
        if (name->live) ::unlink(name->path.c_str());
    }
}

void remove_begun_files_on_signals(bool tell) {
    constexpr std::string_view text = "\nerror: interrupted: no file was left half-written\n";
    if (tell) ended_by_signal = text.substr(::isatty(STDERR_FILENO) == 1 ? 0 : 1);
    for (const int signal : std::array{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGXCPU}) {
        struct sigaction now {};
        if (::sigaction(signal, nullptr, &now) != 0 || now.sa_handler == SIG_IGN) continue;
        struct sigaction removing {};
        removing.sa_handler = remove_and_end;
        removing.sa_flags = SA_RESTART;
        ::sigaction(signal, &removing, nullptr);
    }
}

}  // namespace barycert::base

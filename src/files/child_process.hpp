/// Child processes: started, listened to and ended.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/descriptor.hpp"

namespace barycert::base {

/// Two ends that no program that is started inherits; none where the system has no more, in errno.
struct Pipe {
    Descriptor out, in;
    Pipe();
};

/// Bytes that arrive at a descriptor: the first `most` bytes are kept, all others read and left out.
struct Stream {
    int descriptor = -1;
    std::string text = {};
    std::size_t most = std::numeric_limits<std::size_t>::max();
};

/// Returns whether there is something to read within that time, the end included; without a time it waits for that.
/// Signals do not prolong the time.
bool readable(int descriptor, std::optional<std::chrono::milliseconds> limit);

/// Has this process get the signal when `parent` ends, and ends it where that has happened. Call it in a copy that
/// `parent` has made of itself.
void end_with(pid_t parent, int signal);

/// A process that this one has started. It is ended with the object.
class ChildProcess {
public:
    ChildProcess() = default;
    ChildProcess(ChildProcess&& other) noexcept { *this = std::move(other); }
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    ~ChildProcess() { end(); }

    /// Starts a copy of this process, which does the work and exits with code 0. An exception that the work throws ends
    /// the copy by SIGABRT.
    ///
    /// Requires: this process has one thread, or the work calls only what is safe after fork().
    template <typename Work>
    static ChildProcess copy(const Work& work) {
        const pid_t id = ::fork();
        // noexcept: it must not unwind into the parent's code.
        if (id == 0)
            [&]() noexcept {
                work();
                ::_exit(0);
            }();
        return {id, id < 0 ? errno : 0, false};
    }

    /// Starts a program, looked for as a shell does, in a session of its own. Its descriptors 0, 1, ... are the given
    /// ones; it has no others, and every signal as at the start of a program. Not by fork(): from any thread.
    static ChildProcess run(const std::string& program, const std::vector<std::string>& arguments,
                            std::span<const int> descriptors);

    explicit operator bool() const { return id_ > 0; }
    pid_t id() const { return id_; }
    int failure() const { return failure_; }  ///< why it could not be started, as errno; else 0

    bool has_ended() const;

    /// Waits for its end. Returns its status as waitpid() tells it.
    int wait();

    /// Kills it, unless it has ended, and with a program all that this has started in its session. Returns its status.
    int end();

    /// Reads the streams up to their ends, or up to the end of the process, whoever else holds the other ends. Returns
    /// false if that takes too long.
    bool listen(std::span<Stream> streams, std::optional<std::chrono::milliseconds> limit = {}) const;

private:
    ChildProcess(pid_t id, int failure, bool leads) : id_(id), failure_(failure), leads_(leads) {}
    pid_t id_ = -1;
    int failure_ = 0;
    bool leads_ = false;  ///< a group of processes
};

}  // namespace barycert::base

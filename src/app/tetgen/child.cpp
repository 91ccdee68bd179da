#include "child.hpp"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>

#include "files/input_file.hpp"
#include "files/output_file.hpp"

namespace barycert {
namespace {

/// noexcept: what `work` throws must end the child, not unwind into the parent's code.
[[noreturn]] void be_child(const std::function<void(const Answer&)>& work, pid_t parent, const base::Descriptor& answer,
                           int print) noexcept {
#ifdef __linux__
    // No orphan goes on meshing. Not SIGKILL: what it has begun to write may have to be removed.
    std::signal(SIGTERM, SIG_DFL);
    base::remove_begun_files_on_signals();
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(0);  // it ended before
#endif
    const rlimit no_core{0, 0};  // a crash of TetGen's is an expected answer, not something to debug
    setrlimit(RLIMIT_CORE, &no_core);
    dup2(print, STDOUT_FILENO);
    dup2(print, STDERR_FILENO);
    work([&](std::string_view text) { answer.write(text); });  // it fails where the parent is gone
    std::fflush(nullptr);
    _exit(finished_code);
}

/// Reads until the child closes its end. False if the time was up before the first byte.
bool receive(int descriptor, double timeout_seconds, std::string& answer) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    for (;;) {
        int wait_ms = -1;
        if (timeout_seconds > 0 && answer.empty()) {
            const double passed = std::chrono::duration<double>(Clock::now() - start).count();
            if (passed >= timeout_seconds) return false;
            wait_ms = static_cast<int>(std::min((timeout_seconds - passed) * 1000 + 1, 1e6));
        }
        pollfd waiting{descriptor, POLLIN, 0};
        if (poll(&waiting, 1, wait_ms) <= 0) continue;
        std::array<char, 4096> block{};
        const ssize_t got = read(descriptor, block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return true;
        answer.append(block.data(), static_cast<std::size_t>(got));
    }
}

}  // namespace

ChildOutcome run_in_child(const std::function<void(const Answer&)>& work, double timeout_seconds) {
    ChildOutcome outcome;
    std::fflush(nullptr);  // or the child would print it again
    std::array<int, 2> ends{-1, -1};
    const auto close = [](std::FILE* file) { std::fclose(file); };
    const std::unique_ptr<std::FILE, decltype(close)> print(std::tmpfile(), close);
    const bool ready = print != nullptr && pipe(ends.data()) == 0;
    base::Descriptor from_child(ends[0]), to_parent(ends[1]);
    const pid_t parent = getpid(), child = ready ? fork() : -1;
    if (child == 0) {
        from_child.close();
        be_child(work, parent, to_parent, fileno(print.get()));
    }
    if (child < 0) {
        outcome.failure = std::strerror(errno);
        return outcome;
    }
    to_parent.close();
    outcome.timed_out = !receive(from_child.number, timeout_seconds, outcome.answer);
    if (outcome.timed_out) kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    const int printed = fileno(print.get());
    outcome.printed.resize(static_cast<std::size_t>(lseek(printed, 0, SEEK_END)));
    base::read_at(printed, 0, outcome.printed, "what the child printed").value();
    return outcome;
}

}  // namespace barycert

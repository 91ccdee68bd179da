#include "app/tetgen/child.hpp"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "files/child_process.hpp"
#include "files/descriptor.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"

namespace barycert {
namespace {

/// The child's side, up to its end.
void be_child(const std::function<void(const Answer&)>& work, pid_t parent, const base::Descriptor& answer, int print) {
    // No orphan goes on meshing. Not SIGKILL: what it has begun to write may have to be removed.
    std::signal(SIGTERM, SIG_DFL);
    base::remove_begun_files_on_signals();
    base::end_with(parent, SIGTERM);
    const rlimit no_core{0, 0};  // a crash of TetGen's is an expected answer, not something to debug
    setrlimit(RLIMIT_CORE, &no_core);
    dup2(print, STDOUT_FILENO);
    dup2(print, STDERR_FILENO);
    work([&](std::string_view text) { answer.write(text); });  // it fails where the parent is gone
    std::fflush(nullptr);
    _exit(finished_code);
}

/// The time up to the first answer; none: no limit.
std::optional<std::chrono::milliseconds> limit_of(double seconds) {
    if (!(seconds > 0)) return {};
    return std::chrono::ceil<std::chrono::milliseconds>(std::chrono::duration<double>(std::min(seconds, 1e9)));
}

}  // namespace

ChildOutcome run_in_child(const std::function<void(const Answer&)>& work, double timeout_seconds) {
    ChildOutcome outcome;
    std::fflush(nullptr);  // or the child would print it again
    const auto close = [](std::FILE* file) { std::fclose(file); };
    const std::unique_ptr<std::FILE, decltype(close)> print(std::tmpfile(), close);
    base::Pipe answers;
    const pid_t parent = getpid();
    base::ChildProcess child;
    if (print != nullptr && answers.out) {
        child = base::ChildProcess::copy([&] {
            answers.out.close();
            be_child(work, parent, answers.in, fileno(print.get()));
        });
    }
    if (!child) {
        outcome.failure = std::strerror(child.failure() != 0 ? child.failure() : errno);
        return outcome;
    }
    answers.in.close();
    outcome.timed_out = !base::readable(answers.out.number, limit_of(timeout_seconds));
    base::Stream answer{.descriptor = answers.out.number};
    if (!outcome.timed_out) child.listen(std::span(&answer, 1));
    const int status = outcome.timed_out ? child.end() : child.wait();
    outcome.answer = std::move(answer.text);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    const int printed = fileno(print.get());
    outcome.printed.resize(static_cast<std::size_t>(lseek(printed, 0, SEEK_END)));
    base::read_at(printed, 0, outcome.printed, "what the child printed").value();
    return outcome;
}

}  // namespace barycert

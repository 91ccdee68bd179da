#include "files/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

extern char** environ;

namespace barycert::base {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// How often it is looked whether a process has ended whose descriptors others hold.
constexpr milliseconds tick{50};

/// The time that is left, as poll() takes it: -1 without a limit.
int left_for_poll(std::optional<Clock::time_point> until) {
    if (!until) return -1;
    const std::int64_t left = std::chrono::ceil<milliseconds>(*until - Clock::now()).count();
    return static_cast<int>(std::clamp<std::int64_t>(left, 0, 1'000'000));
}

std::optional<Clock::time_point> end_of(std::optional<milliseconds> limit) {
    if (!limit) return {};
    return Clock::now() + *limit;
}

/// False at the end of the stream.
bool read_some(Stream& stream) {
    std::array<char, 4096> bytes{};
    const ssize_t got = TEMP_FAILURE_RETRY(::read(stream.descriptor, bytes.data(), bytes.size()));
    if (got <= 0) return false;
    if (stream.text.size() < stream.most) stream.text.append(bytes.data(), static_cast<std::size_t>(got));
    return true;
}

}  // namespace

Pipe::Pipe() {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
    out.number = ends[0];
    in.number = ends[1];
}

bool readable(int descriptor, std::optional<milliseconds> limit) {
    const std::optional<Clock::time_point> until = end_of(limit);
    for (;;) {
        const int left = left_for_poll(until);
        pollfd ready{descriptor, POLLIN, 0};
        const int count = ::poll(&ready, 1, left);
        if (count > 0 || (count < 0 && errno != EINTR)) return true;
        if (count == 0 && Clock::now() >= *until) return false;
    }
}

void end_with(pid_t parent, int signal) {
    ::prctl(PR_SET_PDEATHSIG, signal);
    if (::getppid() != parent) ::_exit(0);  // it ended before that was set
}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(failure_, other.failure_);
    std::swap(leads_, other.leads_);
    return *this;
}

ChildProcess ChildProcess::run(const std::string& program, const std::vector<std::string>& arguments,
                               std::span<const int> descriptors) {
    const int count = static_cast<int>(descriptors.size());
    if (std::ranges::any_of(descriptors, [](int descriptor) { return descriptor < 0; })) return {-1, EMFILE, true};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    // Onto high numbers first: one of them may be in the place of another.
    constexpr int aside = 100;
    for (int i = 0; i < count; ++i)
        posix_spawn_file_actions_adddup2(&files, descriptors[static_cast<std::size_t>(i)], aside + i);
    for (int i = 0; i < count; ++i) posix_spawn_file_actions_adddup2(&files, aside + i, i);
    posix_spawn_file_actions_addclosefrom_np(&files, count);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> words{const_cast<char*>(program.c_str())};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    pid_t id = -1;
    const int failure = ::posix_spawnp(&id, program.c_str(), &files, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return {failure == 0 ? id : -1, failure, true};
}

bool ChildProcess::has_ended() const {
    siginfo_t found{};
    return ::waitid(P_PID, static_cast<id_t>(id_), &found, WEXITED | WNOHANG | WNOWAIT) == 0 && found.si_pid == id_;
}

int ChildProcess::wait() {
    if (id_ <= 0) return 0;
    int status = 0;
    (void)TEMP_FAILURE_RETRY(::waitpid(std::exchange(id_, -1), &status, 0));
    return status;
}

int ChildProcess::end() {
    if (id_ <= 0) return 0;
    ::kill(leads_ ? -id_ : id_, SIGKILL);
    return wait();
}

bool ChildProcess::listen(std::span<Stream> streams, std::optional<milliseconds> limit) const {
    const std::optional<Clock::time_point> until = end_of(limit);
    std::vector<pollfd> open;
    for (const Stream& stream : streams) open.push_back({stream.descriptor, POLLIN, 0});
    while (std::ranges::any_of(open, [](const pollfd& one) { return one.fd >= 0; })) {
        if (until && Clock::now() >= *until) return false;
        const bool ended = has_ended();  // what it wrote before can be read now
        const int left = left_for_poll(until), look = static_cast<int>(tick.count());
        const int ready = ::poll(open.data(), open.size(), ended ? 0 : until ? std::min(left, look) : look);
        if (ready <= 0 && ended) break;
        if (ready <= 0) continue;
        for (std::size_t i = 0; i < streams.size(); ++i)
            if (open[i].fd >= 0 && open[i].revents != 0 && !read_some(streams[i])) open[i].fd = -1;
    }
    return true;
}

}  // namespace barycert::base

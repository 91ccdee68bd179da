// The process that forks workers: it has one thread, so that it may. Limits of a worker, and the end of all that a
// kernel started.
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>

#include "audit/kernels/channel.hpp"
#include "files/child_process.hpp"

namespace barycert::kernels {
namespace {

/// The request and, for fork_worker, the socket that came with it; false when the program is gone.
bool receive(int socket, ServerRequest& request, int& with) {
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    iovec part{&request, sizeof request};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    const ssize_t got = TEMP_FAILURE_RETRY(recvmsg(socket, &message, MSG_CMSG_CLOEXEC));
    if (got != sizeof request) return false;
    with = -1;
    if (const cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr && c->cmsg_type == SCM_RIGHTS)
        std::memcpy(&with, CMSG_DATA(c), sizeof with);
    return true;
}

/// The beginning of a file of the system; empty if there is none. Without memory of the heap, which a kernel may have
/// spoilt.
template <std::size_t n>
const char* text_of(const char* path, std::array<char, n>& text) {
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    const ssize_t got = file < 0 ? 0 : read(file, text.data(), n - 1);
    if (file >= 0) close(file);
    text[static_cast<std::size_t>(std::max<ssize_t>(got, 0))] = '\0';
    return text.data();
}

/// Lowers a limit, for good; one that is lower stays.
void lower(__rlimit_resource_t resource, rlim_t most) {
    rlimit now{};
    if (getrlimit(resource, &now) != 0) return;
    const rlimit then{std::min(now.rlim_cur, most), std::min(now.rlim_max, most)};
    setrlimit(resource, &then);
}

/// Limits this process in what it writes, in memory and in how many processes and threads it starts.
void limit_worker() {
    lower(RLIMIT_CORE, 0);
    lower(RLIMIT_FSIZE, rlim_t{1} << 26);  // a kernel that prints without end does not fill the memory
    std::array<char, 256> text{};
    // Limits memory that may be written and is not shared: addresses that are only set aside, as runtimes do, are free.
    // The program's own memory, of which this process is a copy, counts; the kernel has a part of half the machine's.
    unsigned long long data = 0;
    if (std::sscanf(text_of("/proc/self/statm", text), "%*u %*u %*u %*u %*u %llu", &data) == 1) {
        const auto pages = static_cast<rlim_t>(std::max(sysconf(_SC_PHYS_PAGES), 0L)),
                   page = static_cast<rlim_t>(sysconf(_SC_PAGESIZE)),
                   workers = static_cast<rlim_t>(std::max(sysconf(_SC_NPROCESSORS_ONLN), 1L));
        lower(RLIMIT_DATA, data * page + std::max(pages * page / 2 / workers, rlim_t{1} << 30));
    }
    // The system counts all threads of the user, and none of root's: those of the machine bound them from above, and
    // 4096 more are room for 64 workers with 64 threads each.
    unsigned long long threads = 0;
    if (std::sscanf(text_of("/proc/loadavg", text), "%*s %*s %*s %*u/%llu", &threads) == 1)
        lower(RLIMIT_NPROC, threads + 4096);
}

[[noreturn]] void become_worker(Channel& channel, pid_t server, int socket, const char* path) {
    base::end_with(server, SIGKILL);
    setsid();  // signals to its group are its own affair
    // Descriptors of the server are no affair of the library's.
    const int printed = memfd_create("printed", 0);
    if (printed < 0 || dup2(printed, 3) < 0 || dup2(socket, 4) < 0) _exit(127);
    close_range(5, ~0U, 0);
    limit_worker();
    run_worker(channel, 4, 3, path);
}

}  // namespace

bool end_children(std::span<const pid_t> kept) {
    using Clock = std::chrono::steady_clock;
    // A kernel that starts processes faster than they can be killed must not hold up the program's end.
    const auto until = Clock::now() + std::chrono::seconds(10);
    bool any = false;
    for (bool more = true; more && Clock::now() < until;) {
        siginfo_t child{};
        if (waitid(P_ALL, 0, &child, WEXITED | WNOHANG | WNOWAIT | __WALL) != 0) break;  // there are none
        std::array<char, 1 << 14> list{};
        const char* at = text_of("/proc/thread-self/children", list);
        std::array<pid_t, list.size() / 2> ended;
        std::size_t count = 0;
        for (char* next = nullptr;; at = next) {
            const auto pid = static_cast<pid_t>(std::strtol(at, &next, 10));
            if (next == at) break;
            if (*next != '\0' && std::ranges::find(kept, pid) == kept.end()) ended[count++] = pid;
        }
        for (std::size_t i = 0; i < count; ++i) kill(ended[i], SIGKILL);
        for (std::size_t i = 0; i < count; ++i) (void)TEMP_FAILURE_RETRY(waitpid(ended[i], nullptr, __WALL));
        more = count != 0;
        any = any || more;
    }
    return any;
}

void run_server(Channel* channels, int socket, const char* path) {
    const pid_t self = getpid();
    setsid();
    prctl(PR_SET_CHILD_SUBREAPER, 1);  // what leaves its parent comes here, and is ended
    std::array<base::ChildProcess, max_workers> workers;
    ServerRequest request;
    int with = -1;
    while (receive(socket, request, with)) {
        int answer = -1;
        if (request.channel < max_workers) {
            base::ChildProcess& worker = workers[request.channel];
            if (request.kind == ServerRequest::fork_worker) {
                worker = base::ChildProcess::copy([&] { become_worker(channels[request.channel], self, with, path); });
                answer = worker ? worker.id() : -worker.failure();
            } else if (worker) {
                for (int ms = 0; ms < request.milliseconds && !worker.has_ended(); ++ms) usleep(1000);
                answer = worker.end();
                std::array<pid_t, max_workers> kept{};
                std::ranges::transform(workers, kept.begin(), &base::ChildProcess::id);
                end_children(kept);
            }
        }
        if (with >= 0) close(with);
        if (send(socket, &answer, sizeof answer, MSG_NOSIGNAL) != sizeof answer) break;
    }
    end_children({});
    _exit(0);
}

}  // namespace barycert::kernels

// Limits of a worker, and the end of all that a kernel started.
#include "barycert/kernels/channel.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace barycert::kernels {
namespace {

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

}  // namespace

void limit_worker() {
    lower(RLIMIT_CORE, 0);
    lower(RLIMIT_FSIZE, output_limit);
    std::array<char, 256> text{};
    // What may be written to and is not shared: addresses that are only set aside, as runtimes do, are free. The
    // program's own memory, of which this process is a copy, counts; the kernel has a part of half the machine's.
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
            if (*next != '\0' && std::find(kept.begin(), kept.end(), pid) == kept.end()) ended[count++] = pid;
        }
        for (std::size_t i = 0; i < count; ++i) kill(ended[i], SIGKILL);
        for (std::size_t i = 0; i < count; ++i) {
            while (waitpid(ended[i], nullptr, __WALL) < 0 && errno == EINTR) {
            }
        }
        more = count != 0;
        any = any || more;
    }
    return any;
}

}  // namespace barycert::kernels

/// Traces that runs of kernels and programs leave behind.
#pragma once

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

namespace barycert::test {

/// Processes that this one has forked, and those that came to it.
inline std::vector<pid_t> children() {
    std::vector<pid_t> list;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        std::ifstream file(task.path() / "children");
        for (pid_t p = 0; file >> p;) list.push_back(p);
    }
    return list;
}

/// From now on what loses its parent among the descendants of this process comes to it.
class Orphanage {
public:
    Orphanage() : before_(children()) { prctl(PR_SET_CHILD_SUBREAPER, 1); }
    ~Orphanage() { prctl(PR_SET_CHILD_SUBREAPER, 0); }

    /// How many processes run that did not before, when they have had 5 seconds for their end; they are ended.
    std::size_t left_behind() const {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
        for (;;) {
            std::vector<pid_t> now = children();
            std::erase_if(now, [&](pid_t p) {
                return std::find(before_.begin(), before_.end(), p) != before_.end() ||
                       waitpid(p, nullptr, WNOHANG | __WALL) == p;
            });
            if (now.empty()) return 0;
            if (std::chrono::steady_clock::now() > until) {
                for (const pid_t p : now) kill(p, SIGKILL);
                return now.size();
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }

private:
    std::vector<pid_t> before_;
};

}  // namespace barycert::test

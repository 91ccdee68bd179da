#include "sampling_signals.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <utility>

namespace barycert::cli {
namespace {

namespace fs = std::filesystem;

/// Tells the waiting thread to end; from outside it ends the process, as it would have.
constexpr int wake = SIGUSR1;

sigset_t awaited() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction now {};
        if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) sigaddset(&set, signal);
    }
    return set;
}

/// As OutputFile names what it writes: TARGET.tmp-<process>-<count>, beside the target with links resolved.
void remove_begun(const std::string& target) {
    std::error_code ignored;
    const fs::path real = fs::weakly_canonical(fs::absolute(target, ignored), ignored);
    const std::string begun = real.filename().string() + ".tmp-" + std::to_string(getpid()) + "-";
    for (fs::directory_iterator it(real.parent_path(), ignored), end; !ignored && it != end; it.increment(ignored)) {
        if (it->path().filename().string().starts_with(begun)) fs::remove(it->path(), ignored);
    }
}

}  // namespace

RemoveOnSignal::RemoveOnSignal(std::vector<std::string> targets) {
    sigset_t all = awaited();
    sigaddset(&all, wake);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    waiting_ = std::thread([this, targets = std::move(targets), all] {
        int signal = 0;
        if (sigwait(&all, &signal) != 0 || over_) return;
        for (const std::string& target : targets) {
            if (!target.empty() && target != "-") remove_begun(target);
        }
        sigset_t one;
        sigemptyset(&one);
        sigaddset(&one, signal);
        struct sigaction usual {};
        usual.sa_handler = SIG_DFL;
        sigaction(signal, &usual, nullptr);
        pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
        raise(signal);
    });
}

RemoveOnSignal::~RemoveOnSignal() {
    over_ = true;
    pthread_kill(waiting_.native_handle(), wake);
    waiting_.join();
    sigset_t all = awaited();
    sigaddset(&all, wake);
    pthread_sigmask(SIG_UNBLOCK, &all, nullptr);
}

}  // namespace barycert::cli

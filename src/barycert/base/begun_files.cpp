#include "barycert/base/output_file.hpp"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <utility>

namespace barycert::base {
namespace {

std::atomic<BegunName*> names{nullptr};
static_assert(std::atomic<BegunName*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "the signal handler reads them");

}  // namespace

BegunName* begin_name(std::string path) {
    auto* const name = new BegunName{.path = std::move(path), .next = names.load()};
    while (!names.compare_exchange_weak(name->next, name)) {
    }
    return name;
}

void remove_begun_files() noexcept {
    for (const BegunName* name = names.load(); name != nullptr; name = name->next) {
        if (name->live) ::unlink(name->path.c_str());
    }
}

namespace {

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

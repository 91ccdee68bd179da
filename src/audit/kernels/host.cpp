// The program's side: workers are asked for answers, and replaced where they die.
#include "audit/kernels/host.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>

#include "audit/kernels/channel.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/base/text.hpp"
#include "files/child_process.hpp"
#include "files/descriptor.hpp"

namespace barycert::kernels {
namespace {

Error no_process(const std::string& path, std::string found) {
    return about("job.in_process",
                 file_error("kernel.process", path, "cannot run the kernel library in a process of its own", "",
                            std::move(found), "run it in this process with job.in_process if you trust it"));
}

/// The time that loading the library may take, or the limit for a case if that is more.
constexpr int min_loading_milliseconds = 10000;

/// How a process ended, in words.
std::string ending(int status) {
    if (WIFSIGNALED(status)) {
        const char* const name = sigabbrev_np(WTERMSIG(status));
        const char* const text = sigdescr_np(WTERMSIG(status));
        return fmt::format("SIG{} ({})", name == nullptr ? "?" : name, text == nullptr ? "" : text);
    }
    return fmt::format("it called exit, status {}", WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

std::string not_loaded_within(int milliseconds) {
    return fmt::format("it did not load within {} s", milliseconds / 1000.0);
}

[[noreturn]] void become_server(Channel* channels, int socket, const char* path) {
    for (int signal = 1; signal < 32; ++signal) std::signal(signal, SIG_DFL);
    // Signals of the terminal are meant for the program, and this process ends when the program ends.
    for (const int signal : {SIGINT, SIGQUIT, SIGHUP}) std::signal(signal, SIG_IGN);
    if (socket != 3) dup2(socket, 3);
    close_range(4, ~0U, 0);
    const int null = open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) dup2(null, stream);
    if (null > 3) close(null);
    // A kernel that kills the server leaves what it has forked to this process, which ends it. The program itself might
    // adopt it, too, but has children that are no affair of the library's.
    setsid();
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    const pid_t keeper = getpid();
    base::ChildProcess server = base::ChildProcess::copy([&] {
        base::end_with(keeper, SIGKILL);
        run_server(channels, 3, path);
    });
    close(3);
    server.wait();
    end_children({});
    _exit(0);
}

}  // namespace

Result<std::shared_ptr<Host>> Host::start(const std::string& path, double seconds) {
    const std::shared_ptr<Host> host(new Host);
    // Without a slash dlopen would search the system's library folders instead of the working directory.
    const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
    host->milliseconds_ = seconds > 1e-3 ? static_cast<int>(std::min(seconds * 1000, 1e9)) : 1;
    host->loading_milliseconds_ = std::max(host->milliseconds_, min_loading_milliseconds);
    host->memory_ = base::map_memory(max_workers * sizeof(Channel), PROT_READ | PROT_WRITE,
                                     MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE);
    if (!host->memory_) return no_process(path, std::strerror(errno));
    for (std::uint32_t i = 0; i < max_workers; ++i) host->free_.push_back({.channel = max_workers - 1 - i});
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return no_process(path, std::strerror(errno));
    host->server_socket_ = base::Descriptor(ends[0]);
    host->server_ = base::ChildProcess::copy([&] { become_server(host->channels(), ends[1], file.c_str()); });
    close(ends[1]);
    if (!host->server_) return no_process(path, std::strerror(host->server_.failure()));

    Worker worker = host->take();
    const End end = host->begin(worker);
    if (end != End::done) {
        const int status = host->end(worker);
        host->give_back(std::move(worker));
        if (end == End::no_process) return no_process(path, "no process for it could be started");
        return file_error("kernel.load", path, "cannot load the kernel library", "",
                          end == End::hung ? not_loaded_within(host->loading_milliseconds_)
                                           : "its process ended while it was loaded: " + ending(status),
                          "look at its constructors and at barycert_kernel_describe");
    }
    host->description_ = host->channel(worker).description;
    host->give_back(std::move(worker));
    return host;
}

Host::~Host() {
    free_.clear();
    server_socket_.close();
    server_.wait();
}

Host::Worker Host::take() {
    std::unique_lock lock(mutex_);
    freed_.wait(lock, [&] { return !free_.empty(); });
    Worker worker = std::move(free_.back());
    free_.pop_back();
    return worker;
}

void Host::give_back(Worker&& worker) {
    {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(worker));
    }
    freed_.notify_one();
}

/// -1 if the server is gone.
int Host::ask_server(ServerRequest request, int with_socket) {
    const std::lock_guard lock(server_mutex_);
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    iovec part{&request, sizeof request};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    if (with_socket >= 0) {
        message.msg_control = control.data();
        message.msg_controllen = control.size();
        cmsghdr* const c = CMSG_FIRSTHDR(&message);
        c->cmsg_level = SOL_SOCKET;
        c->cmsg_type = SCM_RIGHTS;
        c->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(c), &with_socket, sizeof with_socket);
    }
    if (sendmsg(server_socket_.number, &message, MSG_NOSIGNAL) < 0) return -1;
    int answer = -1;
    const ssize_t got = TEMP_FAILURE_RETRY(recv(server_socket_.number, &answer, sizeof answer, 0));
    return got == sizeof answer ? answer : -1;
}

/// Loading the library is no part of a case: it has a limit of its own whenever a process is started.
Host::End Host::begin(Worker& worker) {
    if (worker.socket) return End::done;
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return End::no_process;
    new (&channel(worker)) Channel;
    base::Descriptor socket(ends[0]);
    const int pid = ask_server({ServerRequest::fork_worker, worker.channel, 0}, ends[1]);
    close(ends[1]);
    if (pid <= 0) return End::no_process;
    worker.socket = std::move(socket);
    return command(worker, Command::describe, loading_milliseconds_);
}

/// Ends the worker, unless it does so in time, and returns its status; -1 if the server, and with it every worker, is
/// gone.
int Host::end(Worker& worker, int milliseconds) {
    if (!worker.socket) return 0;
    worker.socket.close();
    return ask_server({ServerRequest::end_worker, worker.channel, milliseconds}, -1);
}

/// Returns when it is done, dead, or in the same case for too long: at two looks, so that a program that was stopped
/// and goes on again does not take that time for the kernel's.
Host::End Host::command(Worker& worker, Command command, int milliseconds) {
    char letter = static_cast<char>(command);
    if (send(worker.socket.number, &letter, 1, MSG_NOSIGNAL) != 1) return End::died;
    constexpr std::uint64_t nothing = ~std::uint64_t{0};
    for (std::uint64_t seen = nothing;;) {
        if (!base::readable(worker.socket.number, std::chrono::milliseconds(milliseconds))) {
            const std::uint64_t begun = channel(worker).begun.load(std::memory_order_relaxed);
            if (begun == seen || command == Command::describe) return End::hung;
            seen = begun;
            continue;
        }
        const ssize_t got = recv(worker.socket.number, &letter, 1, 0);
        if (got < 0 && errno == EINTR) continue;
        return got == 1 ? End::done : End::died;
    }
}

Asked Host::run(std::span<const Case> cases, std::span<Statement> statements, Asking asking) {
    Asked batch;
    std::ranges::fill(statements, Statement{{}, false, false});
    const auto count = static_cast<std::uint32_t>(std::min(cases.size(), batch_size));
    if (count == 0) return batch;
    Worker worker = take();
    std::uint32_t first = 0;
    std::string end_of_last;
    bool again = false;
    const bool timed = asking == Asking::timed;
    while (first < count && (patience_left_ > 0 || asking == Asking::given_up_too)) {
        const End begun = begin(worker);
        if (begun == End::no_process) {
            patience_left_ = 0;
            break;
        }
        Channel& c = channel(worker);
        c.simplex = cases[0].simplex;
        c.stride = cases[0].stride();
        c.first = first;
        c.count = count;
        c.timed = timed && !again;
        c.beside = c.closed = false;
        c.current = c.complete = first;
        std::copy_n(cases.begin(), count, c.cases.begin());
        const End how = begun == End::done ? command(worker, Command::run, milliseconds_) : begun;
        // One whose kernel has closed its socket is at work yet.
        int status = how == End::died ? end(worker, 100) : 0;
        const std::uint32_t complete = std::clamp(c.complete.load(std::memory_order_acquire), first, count);
        const std::uint32_t answered = how == End::done ? count : complete;
        for (std::uint32_t i = first; i < answered; ++i) {
            statements[i] = {c.answers[i], true, true};
            if ((c.answers[i].incidents & incident_forked) != 0) --patience_left_;
        }
        if (how == End::done) {
            if (timed && c.ns > 0) batch.ns = c.ns;
            c.detail[sizeof c.detail - 1] = '\0';
            if (batch.detail.empty()) batch.detail = base::printable(c.detail);
            break;
        }
        // All answered: it died when it ran again, against the clock.
        const std::uint32_t culprit =
            complete < count ? complete : std::min(c.current.load(std::memory_order_relaxed), count - 1);
        const bool beside = c.beside, closed = c.closed;
        if (how == End::hung) status = end(worker);
        if (status < 0) {  // not the kernel's doing
            patience_left_ = 0;
            break;
        }
        if (closed && complete == count &&
            !again) {  // in which case, if not against the clock? A new worker looks after each
            again = true;
            continue;
        }
        statements[culprit] = {{}, true, false};
        statements[culprit].incidents = how == End::hung ? incident_hung : beside ? incident_beside : incident_crashed;
        end_of_last = begun == End::hung ? not_loaded_within(loading_milliseconds_)
                      : how == End::hung ? fmt::format("no answer within {} s", milliseconds_ / 1000.0)
                      : beside           ? std::string("touched memory beside its arrays, or wrote to its input")
                      : closed           ? std::string("closed descriptors that it had not opened")
                                         : ending(status);
        patience_left_ -= how == End::hung ? patience_for_hang : 1;
        first = complete < count ? culprit + 1 : count;
    }
    give_back(std::move(worker));
    if (!end_of_last.empty()) batch.detail = end_of_last;
    return batch;
}

}  // namespace barycert::kernels

// The process that forks workers: it has one thread, so that it may.
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "barycert/kernels/channel.hpp"

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
    ssize_t got = 0;
    do {
        got = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
    } while (got < 0 && errno == EINTR);
    if (got != sizeof request) return false;
    with = -1;
    if (const cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr && c->cmsg_type == SCM_RIGHTS)
        std::memcpy(&with, CMSG_DATA(c), sizeof with);
    return true;
}

[[noreturn]] void become_worker(Channel& channel, pid_t server, int socket, const char* path) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != server) _exit(0);  // it ended before that was set
    setsid();                           // signals to its group are its own affair
    // Descriptors of the server are no affair of the library's.
    const int printed = memfd_create("printed", 0);
    if (printed < 0 || dup2(printed, 3) < 0 || dup2(socket, 4) < 0) _exit(127);
    close_range(5, ~0U, 0);
    limit_worker();
    run_worker(channel, 4, 3, path);
}

}  // namespace

void run_server(Channel* channels, int socket, const char* path) {
    const pid_t self = getpid();
    setsid();
    prctl(PR_SET_CHILD_SUBREAPER, 1);  // what leaves its parent comes here, and is ended
    std::array<pid_t, max_workers> workers{};
    ServerRequest request;
    int with = -1;
    while (receive(socket, request, with)) {
        int answer = -1;
        if (request.channel < max_workers) {
            pid_t& worker = workers[request.channel];
            if (request.kind == ServerRequest::fork_worker) {
                worker = fork();
                if (worker == 0) become_worker(channels[request.channel], self, with, path);
                answer = worker < 0 ? -errno : worker;
            } else if (worker > 0) {
                pid_t ended = 0;
                for (int ms = 0; ms < request.milliseconds; ++ms) {
                    ended = waitpid(worker, &answer, WNOHANG);
                    if (ended != 0) break;
                    usleep(1000);
                }
                if (ended == 0) kill(worker, SIGKILL);
                while (ended == 0 && waitpid(worker, &answer, 0) < 0 && errno == EINTR) {
                }
                worker = 0;
                end_children(workers);
            }
        }
        if (with >= 0) close(with);
        if (send(socket, &answer, sizeof answer, MSG_NOSIGNAL) != sizeof answer) break;
    }
    end_children({});
    _exit(0);
}

}  // namespace barycert::kernels

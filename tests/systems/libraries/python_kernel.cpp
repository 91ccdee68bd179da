// A formula of a Python package: BARYCERT_PACKAGE "scipy" or "matplotlib", BARYCERT_DIMENSION 2 or 3.
//
// A Python process answers, one for each thread that asks: python_kernel.py, the first python3 that has the package. If
// it ends, this process ends in the same way, so that the audit tells it of the case that was asked.
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <string>
#include <string_view>

#include "library.hpp"

namespace {

constexpr int dimension = BARYCERT_DIMENSION, corners = dimension + 1;
constexpr bool is_scipy = std::string_view(BARYCERT_PACKAGE) == "scipy";

struct Question {
    double kind = 0;  ///< 1: the value
    std::array<double, corners * dimension> vertices{};
    std::array<double, dimension> point{};
    std::array<double, corners> values{};

    Question(const double* v, const double* p) {
        std::copy_n(v, vertices.size(), vertices.begin());
        std::copy_n(p, point.size(), point.begin());
    }
};

struct Answer {
    double refused = 0, inside = 0;
    std::array<double, corners> weights{};
};

class Python {
public:
    Python() {
        for (const char* const program : {"python3", "/usr/bin/python3"}) {
            start(program);
            // A kernel's name has none of the signs that distributions add: 3.10.1+dfsg1.
            for (char c = 0; receive(&c, 1) && c != '\n';) version_ += c == '+' ? '.' : c;
            if (!version_.empty()) return;
            end();
        }
    }
    ~Python() { end(); }
    Python(const Python&) = delete;
    Python& operator=(const Python&) = delete;

    /// Empty if no python3 has the package.
    const std::string& version() const { return version_; }

    Answer ask(const Question& question) {
        Answer answer;
        if (socket_ < 0 || send(socket_, &question, sizeof question, MSG_NOSIGNAL) != sizeof question ||
            !receive(&answer, sizeof answer))
            end_alike();
        return answer;
    }

private:
    void start(const char* program) {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
        socket_ = ends[0];
        child_ = fork();
        if (child_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            std::signal(SIGINT, SIG_IGN);
            dup2(ends[1], 0);
            dup2(ends[1], 1);
            execlp(program, program, "-B", BARYCERT_PYTHON_KERNEL, BARYCERT_PACKAGE, dimension == 2 ? "2" : "3",
                   static_cast<char*>(nullptr));
            _exit(127);
        }
        close(ends[1]);
    }

    /// Returns its status, as waitpid tells it.
    int end() {
        int status = 0;
        if (socket_ >= 0) close(socket_);
        while (child_ > 0 && waitpid(child_, &status, 0) < 0 && errno == EINTR) {
        }
        socket_ = child_ = -1;
        return status;
    }

    [[noreturn]] void end_alike() {
        const int status = end();
        if (WIFSIGNALED(status)) {
            std::signal(WTERMSIG(status), SIG_DFL);
            raise(WTERMSIG(status));
        }
        _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 1);
    }

    bool receive(void* to, std::size_t size) {
        for (char* at = static_cast<char*>(to); size > 0;) {
            const ssize_t got = recv(socket_, at, size, 0);
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return false;
            at += got;
            size -= static_cast<std::size_t>(got);
        }
        return true;
    }

    int socket_ = -1;
    pid_t child_ = -1;
    std::string version_;
};

Python& python() {
    thread_local Python made;
    return made;
}

/// The weights' answer has the region as well, which is mostly asked for next.
const Answer& answer_for(const double* vertices, const double* point) {
    thread_local Question last(vertices, point);
    thread_local Answer answer = python().ask(last);
    const Question question(vertices, point);
    if (question.vertices != last.vertices || question.point != last.point) {
        answer = python().ask(question);
        last = question;
    }
    return answer;
}

}  // namespace

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    // There is no way to refuse: what is no name tells why.
    static const std::string name =
        python().version().empty() ? "no python3 has " BARYCERT_PACKAGE
                                   : BARYCERT_PACKAGE "-" + python().version() + (is_scipy ? ".transform" : ".plane");
    barycert::libraries::describe(info, name.c_str(), dimension == 2 ? "triangle" : "tetrahedron",
                                  is_scipy ? "an inverse matrix times p - r; the last weight is 1 - sum"
                                           : "a x + b y + c, the plane over the triangle that is 1 at one vertex",
                                  is_scipy ? "scipy.spatial.Delaunay.transform, find_simplex"
                                           : "matplotlib.tri.LinearTriInterpolator, TrapezoidMapTriFinder",
                                  true);
}

extern "C" int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    const Answer& answer = answer_for(vertices, point);
    std::copy_n(answer.weights.begin(), corners, weights);
    return answer.refused != 0 ? 1 : 0;
}

extern "C" int barycert_kernel_classify(const double* vertices, const double* point, const double*) {
    return answer_for(vertices, point).inside != 0 ? BARYCERT_INTERIOR : BARYCERT_OUTSIDE;
}

#ifdef BARYCERT_OWN_VALUE
extern "C" double barycert_kernel_value(const double* vertices, const double* point, const double* values) {
    Question question(vertices, point);
    question.kind = 1;
    std::copy_n(values, corners, question.values.begin());
    return python().ask(question).weights[0];
}
#endif

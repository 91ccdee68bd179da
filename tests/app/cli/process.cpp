#include "process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

namespace barycert::cli_test {
namespace {

namespace fs = std::filesystem;

void redirect(int descriptor, const std::string& path, bool close_it, int otherwise) {
    if (close_it) {
        ::close(descriptor);
    } else if (!path.empty()) {
        ::dup2(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), descriptor);
    } else if (otherwise >= 0) {
        ::dup2(otherwise, descriptor);
    }
}

[[noreturn]] void become(const Words& arguments, const How& how, int out, int err) {
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    redirect(STDERR_FILENO, how.stderr_path, how.close_stderr, err);
    redirect(STDOUT_FILENO, how.stdout_path, how.close_stdout, out);
    for (const std::string& variable : how.environment) {
        const auto equals = variable.find('=');
        if (equals == std::string::npos) {
            ::unsetenv(variable.c_str());
        } else {
            ::setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
        }
    }
    if (!how.folder.empty() && ::chdir(how.folder.c_str()) != 0) ::_exit(126);
    if (how.max_file != 0) {
        const struct rlimit limit { how.max_file, how.max_file };
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    constexpr uid_t nobody = 65534;
    if (how.as_nobody && ::getuid() == 0 && (::setgid(nobody) != 0 || ::setuid(nobody) != 0)) ::_exit(126);
    std::vector<char*> words{const_cast<char*>(how.program.c_str())};
    for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
    words.push_back(nullptr);
    ::execv(how.program.c_str(), words.data());
    ::_exit(127);
}

/// Appends what the descriptor has to say; false at its end.
bool drain(int descriptor, std::string& into) {
    std::array<char, 65536> buffer{};
    const ssize_t n = ::read(descriptor, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) return true;
    if (n <= 0) return false;  // a terminal whose other side is gone says EIO
    into.append(buffer.data(), static_cast<std::size_t>(n));
    return true;
}

void listen(pid_t child, const How& how, std::array<struct pollfd, 2> ends, Ended& result) {
    using Clock = std::chrono::steady_clock;
    const auto deadline = Clock::now() + std::chrono::minutes(1);
    bool to_kill = how.kill_with != 0;
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) {
            ADD_FAILURE() << "the process did not end within a minute";
            ::kill(child, SIGKILL);
            break;
        }
        if (::poll(ends.data(), ends.size(), static_cast<int>(left)) <= 0) continue;
        if (ends[0].fd >= 0 && ends[0].revents != 0 && !drain(ends[0].fd, result.out)) ends[0].fd = -1;
        if (ends[1].fd >= 0 && ends[1].revents != 0 && !drain(ends[1].fd, result.err)) ends[1].fd = -1;
        if (to_kill && (contains(result.out, how.kill_on) || contains(result.err, how.kill_on))) {
            ::kill(child, how.kill_with);
            to_kill = false;
        }
    }
}

}  // namespace

Ended run(const Words& arguments, const How& how) {
    Ended result;
    std::array<int, 2> out{-1, -1}, err{-1, -1};
    int terminal = -1;
    pid_t child = -1;
    if (how.terminal) {
        child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
        if (child == 0) become(arguments, how, -1, -1);
    } else {
        EXPECT_EQ(::pipe2(out.data(), O_CLOEXEC), 0);
        EXPECT_EQ(::pipe2(err.data(), O_CLOEXEC), 0);
        child = ::fork();
        if (child == 0) become(arguments, how, out[1], err[1]);
        ::close(out[1]);
        ::close(err[1]);
    }
    EXPECT_GT(child, 0);
    if (how.kill_after.count() > 0) {
        std::this_thread::sleep_for(how.kill_after);
        ::kill(child, SIGKILL);
    }
    listen(child, how, {{{how.terminal ? terminal : out[0], POLLIN, 0}, {err[0], POLLIN, 0}}}, result);
    for (const int descriptor : {terminal, out[0], err[0]}) {
        if (descriptor >= 0) ::close(descriptor);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    return result;
}

Ended run_shell(const std::string& line, How how) {
    const char* path = std::getenv("PATH");
    how.environment.push_back("PATH=" + fs::path(how.program).parent_path().string() + ":" +
                              (path == nullptr ? "/usr/bin:/bin" : path));
    how.program = "/bin/sh";
    return run({"-c", line}, how);
}

std::string read_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    EXPECT_TRUE(in) << path;
    return {std::istreambuf_iterator<char>(in), {}};
}

nlohmann::json parse(const std::string& text) {
    auto j = nlohmann::json::parse(text, nullptr, false);
    EXPECT_FALSE(j.is_discarded()) << "not JSON: " << text.substr(0, 200);
    return j;
}

Words lines_of(const std::string& text) {
    std::istringstream in(text);
    Words lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string mesh(const std::string& name) {
    return std::string(BARYCERT_DATA_DIR) + "/meshes/" + name + ".node";
}

}  // namespace barycert::cli_test

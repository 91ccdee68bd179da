#include "job_process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "sample_subject.hpp"

namespace barycert::bench {
namespace {

double seconds(const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

[[noreturn]] void execute(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::execv(arguments.front(), arguments.data());
    std::perror(arguments.front());
    ::_exit(127);
}

}  // namespace

Spent run_process(const std::vector<std::string>& words) {
    std::fflush(stdout);
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = ::fork();
    require(child >= 0, "no process can be made");
    if (child == 0) execute(words);
    int status = 0;
    rusage used{};
    require(::wait4(child, &status, 0, &used) == child, "a process was lost");
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    std::string line;
    for (const std::string& word : words) line += word + ' ';
    require(WIFEXITED(status) && WEXITSTATUS(status) == 0, "this failed: " + line);
    return {wall.count(), seconds(used.ru_utime) + seconds(used.ru_stime), static_cast<double>(used.ru_maxrss) / 1024};
}

void apart(const std::function<void()>& work) {
    std::fflush(stdout);
    const pid_t child = ::fork();
    require(child >= 0, "no process can be made");
    if (child == 0) {
        work();
        std::fflush(stdout);
        ::_exit(0);
    }
    int status = 0;
    require(::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0,
            "a part of the bench failed");
}

}  // namespace barycert::bench

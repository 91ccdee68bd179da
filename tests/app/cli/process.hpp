/// The executable as its users meet it: a process with arguments, an environment, streams and an end.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/scratch.hpp"

namespace barycert::cli_test {

using Words = std::vector<std::string>;

/// How a process is started; by default as from a script: no terminal, stdin empty.
struct How {
    Words environment = {};                  ///< "NAME=VALUE" to set, "NAME" to unset, on top of the test's own
    std::string folder = {};                 ///< working directory; the test's own if empty
    std::string stdout_path = {};            ///< stdout goes to that file instead of Ended::out
    std::string stderr_path = {};            ///< likewise
    bool close_stdout = false;               ///< as `>&-`
    bool close_stderr = false;               ///< as `2>&-`
    bool terminal = false;                   ///< stdout and stderr are one terminal; what it shows is Ended::out
    bool as_nobody = false;                  ///< with no more rights than the user nobody, where the test runs as root
    std::size_t max_file = 0;                ///< in bytes, as `ulimit -f`; 0 is no limit
    std::string kill_on = {};                ///< once this has been read from the process ...
    int kill_with = 0;                       ///< ... it gets this signal
    std::chrono::microseconds kill_after{};  ///< this long after its start it gets SIGKILL; 0 is never
    std::string program = BARYCERT_PROGRAM;
};

struct Ended {
    int code = -1;   ///< exit code, or -1 if a signal ended the process
    int signal = 0;  ///< that signal
    std::string out;
    std::string err;
};

/// Runs the program to its end, at most a minute (then it is killed: signal is SIGKILL).
Ended run(const Words& arguments, const How& how = {});

/// Runs a line of shell in which `barycert` is the program.
Ended run_shell(const std::string& line, How how = {});

using test::Scratch;

std::string read_file(const std::string& path);
nlohmann::json parse(const std::string& text);  ///< discarded, and a failure of the test, if it is not JSON
Words lines_of(const std::string& text);
bool contains(const std::string& text, const std::string& part);

/// A mesh of barycert's own, by name: "plate" is 2D, "bracket" 3D.
std::string mesh(const std::string& name);

}  // namespace barycert::cli_test

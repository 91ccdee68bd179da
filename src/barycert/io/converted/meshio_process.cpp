#include "barycert/io/converted/meshio_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "barycert/base/input_file.hpp"
#include "barycert/io/converted/meshio_script.hpp"

extern char** environ;

namespace barycert::io {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds most_time{600};
constexpr std::int64_t tick = 50;                        // milliseconds after which it is looked at
constexpr std::size_t most_text = std::size_t{1} << 18;  // of each stream

/// Both ends, closed when it goes.
struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe() {
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) ends = {-1, -1};
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close(0);
        close(1);
    }
    void close(std::size_t end) {
        if (ends[end] >= 0) ::close(std::exchange(ends[end], -1));
    }
};

struct Process {
    pid_t id = -1;
    Pipe life, answer, messages;
    int failure = 0;

    Process(const std::string& python, const std::vector<std::string>& arguments, int output, int input) {
        posix_spawn_file_actions_t files;
        posix_spawnattr_t attributes;
        posix_spawn_file_actions_init(&files);
        posix_spawnattr_init(&attributes);
        const std::array<int, 5> from{life.ends[0], answer.ends[1], messages.ends[1], output, input};
        for (const int end : from) failure = end < 0 ? EMFILE : failure;
        // Onto high numbers first: one of them may be in the place of another.
        for (int i = 0; i < 5; ++i)
            posix_spawn_file_actions_adddup2(&files, from[static_cast<std::size_t>(i)], 100 + i);
        for (int i = 0; i < 5; ++i) posix_spawn_file_actions_adddup2(&files, 100 + i, i);
        posix_spawn_file_actions_addclosefrom_np(&files, 5);
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        std::vector<char*> words{const_cast<char*>(python.c_str())};
        for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
        words.push_back(nullptr);
        // Threads of linear algebra would each reserve memory; lines of messages are not to be broken.
        std::vector<std::string> own{"OPENBLAS_NUM_THREADS=1", "OMP_NUM_THREADS=1", "COLUMNS=1000", "NO_COLOR=1"};
        std::vector<char*> variables;
        for (std::string& variable : own) variables.push_back(variable.data());
        for (char** variable = environ; *variable != nullptr; ++variable) variables.push_back(*variable);
        variables.push_back(nullptr);
        if (failure == 0)
            failure = ::posix_spawnp(&id, python.c_str(), &files, &attributes, words.data(), variables.data());
        if (failure != 0) id = -1;
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&files);
        life.close(0);
        answer.close(1);
        messages.close(1);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process() { end(); }

    /// Ends it and all that it started; its status.
    int end() {
        if (id < 0) return 0;
        ::kill(-id, SIGKILL);
        int status = 0;
        while (::waitpid(id, &status, 0) < 0 && errno == EINTR) {
        }
        id = -1;
        return status;
    }

    bool has_ended() const {
        siginfo_t found{};
        return ::waitid(P_PID, static_cast<id_t>(id), &found, WEXITED | WNOHANG | WNOWAIT) == 0 && found.si_pid == id;
    }

    /// All that it prints, up to its end, whoever else holds the other ends. False: it takes too long.
    bool listen(std::string& text, std::string& errors) {
        std::array<pollfd, 2> open{{{answer.ends[0], POLLIN, 0}, {messages.ends[0], POLLIN, 0}}};
        const auto until = Clock::now() + most_time;
        while (open[0].fd >= 0 || open[1].fd >= 0) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
            if (left <= 0) return false;
            const bool ended = has_ended();  // what it wrote before can be read now
            const int ready = ::poll(open.data(), open.size(), ended ? 0 : static_cast<int>(std::min(left, tick)));
            if (ready <= 0 && ended) break;
            if (ready <= 0) continue;
            for (pollfd& one : open) {
                if (one.fd < 0 || one.revents == 0) continue;
                std::array<char, 4096> bytes{};
                const ssize_t got = ::read(one.fd, bytes.data(), bytes.size());
                if (got < 0 && errno == EINTR) continue;
                std::string& to = &one == open.data() ? text : errors;
                if (got <= 0) {
                    one.fd = -1;
                } else if (to.size() < most_text) {
                    to.append(bytes.data(), static_cast<std::size_t>(got));
                }
            }
        }
        return true;
    }
};

Error not_installed(const std::string& path, const std::string& tried) {
    return {.what = "this file is read by way of meshio, which is not installed",
            .file = path,
            .expected = "a Python with the module meshio",
            .found = tried,
            .remedy =
                "install it: `apt install python3-meshio`, or `python3 -m pip install 'meshio[all]'`; "
                "BARYCERT_MESHIO names the Python to use"};
}

/// Of formats in HDF5 and NetCDF the first bytes tell.
base::Text beginning_of(const base::InputFile& file, const std::string& path, const std::string& format) {
    std::array<char, 4> magic{};
    const Result<std::size_t> size = file.read_at(0, magic, path);
    const std::string_view head(magic.data(), size ? *size : 0);
    if (head == "\x89HDF" || head.starts_with("CDF") || format == "ugrid") return base::Text::none;
    return format == "ansys" ? base::Text::head : base::Text::all;
}

std::string half_of_memory() {
    return std::to_string(static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) / 2 *
                          static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)));
}

}  // namespace

MeshioFile::MeshioFile(MeshioFile&& other) noexcept
    : vtu(std::move(other.vtu)),
      answer(std::move(other.answer)),
      messages(std::move(other.messages)),
      descriptor(std::exchange(other.descriptor, -1)) {}

MeshioFile::~MeshioFile() {
    if (descriptor >= 0) ::close(descriptor);
}

Result<MeshioFile> run_meshio(const std::string& path, const std::string& format) {
    const char* const named = std::getenv("BARYCERT_MESHIO");
    if (named != nullptr && *named == '\0')
        return Error{.what = "this file is read by way of meshio, which BARYCERT_MESHIO turns off",
                     .file = path,
                     .remedy = "unset BARYCERT_MESHIO, or set it to a Python that has meshio"};
    const Result<base::InputFile> input = base::InputFile::open(path);
    if (!input) return input.error();
    const auto keyword = [&](std::string_view block, std::uint64_t) -> Status {
        if (format != "abaqus" || block.starts_with('*') || block.find("\n*") != std::string_view::npos) return Done{};
        return Error{.what = "not a mesh of Abaqus",
                     .file = path,
                     .expected = "a keyword, such as *NODE, in the first " + std::to_string(block.size()) + " bytes",
                     .found = "none",
                     .remedy = "check the path, or write the file again"};
    };
    if (Status begins = input->check(beginning_of(*input, path, format), path, keyword); !begins) return begins.error();
    std::vector<std::string> pythons{"python3", "/usr/bin/python3"};
    if (named != nullptr) pythons = {named};
    const std::string memory = half_of_memory();
    const bool packed = path.ends_with(".gz");  // formats that name files beside them are not packed
    const std::vector<std::string> arguments{"-c",   meshio_script, packed ? "/dev/fd/4" : path,      format,
                                             memory, memory,        std::to_string(most_time.count())};
    std::string tried;
    for (const std::string& python : pythons) {
        MeshioFile file;
        file.descriptor = ::memfd_create("barycert-meshio", MFD_CLOEXEC);
        if (file.descriptor < 0) return base::read_failure(path, errno);
        file.vtu = "/proc/self/fd/" + std::to_string(file.descriptor);
        Process process(python, arguments, file.descriptor, input->descriptor());
        const bool ended = process.failure != 0 || process.listen(file.answer, file.messages);
        const int status = process.end();
        tried += (tried.empty() ? "" : ", ") + python + ": ";
        if (process.failure != 0) {
            tried += std::strerror(process.failure);
        } else if (file.answer.find("\"missing\"") != std::string::npos) {
            tried += "no such module";
        } else if (!file.answer.empty()) {
            return file;
        } else {
            return Error{.what = "meshio did not come to its end",
                         .file = path,
                         .expected = "an answer within " + std::to_string(most_time.count()) +
                                     " s, in half of the memory of this machine",
                         .found = !ended                ? "none"
                                  : WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status))
                                                        : "an end without an answer: " + file.messages.substr(0, 500),
                         .remedy = "convert the file to .vtu with the program that it is of"};
        }
    }
    return not_installed(path, tried);
}

}  // namespace barycert::io

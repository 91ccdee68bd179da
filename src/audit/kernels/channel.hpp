/// The memory that the program shares with the process of a user's kernel, and what the two say to each other.
///
/// Four processes: the program; its server, forked when the library is named, which has no other thread and so may fork
/// at any time; between the two a keeper, which waits for the server's end and then ends what that has left behind; and
/// the workers, which the server forks, one for each thread that asks. A worker loads the library and answers batches.
/// When it dies, the program has the server fork another.
///
/// Processes are started by base::ChildProcess, as elsewhere. The pool is the kernels' own: workers live from case to
/// case, are forked without exec (a worker shares the channels and needs no program to be found), and what a kernel
/// leaves behind has to be found and ended, which no other child of this project's does.
#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>

#include "barycert/kernel.h"
#include "barycert/kernels.hpp"
#include "barycert/simplex.hpp"

namespace barycert::kernels {

/// Workers of one library at a time: more threads wait for each other.
inline constexpr std::uint32_t max_workers = 64;

/// Cases in one batch.
inline constexpr std::size_t batch_size = 256;

/// Things that a kernel does besides answering, as bits: bit i is the audit's finding i.
enum Incident : std::uint8_t {
    incident_crashed = 1,       ///< its process ended; there is no answer
    incident_raised = 2,        ///< a callable raised an exception; there is no answer
    incident_hung = 4,          ///< no answer in time; there is no answer
    incident_beside = 8,        ///< touched memory beside its arrays, or wrote to its input
    incident_forked = 16,       ///< left a process behind
    incident_environment = 32,  ///< came back with another rounding mode or flush-to-zero
    incident_printed = 64,      ///< wrote to stdout or stderr
};

/// Weights that are no answer: a kernel gets them to overwrite.
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::array<double, 4> unset_weights{unset, unset, unset, unset};

/// Answer of a kernel to one case.
struct Answer {
    int status = 0;  ///< 1: declared degenerate
    int region = 0;  ///< of the kernel's own classification
    std::array<double, 4> weights = unset_weights;
    double value = unset;        ///< of the interpolated field
    std::uint8_t incidents = 0;  ///< Incident
};

/// Texts of barycert_kernel_info, cut to their room.
struct Description {
    int abi = 0, declares_degenerate = 0, certifies = 0;
    bool classifies = false, interpolates = false;
    char name[256] = {}, simplex[64] = {}, formula[1024] = {}, source[1024] = {};
    char error[1024] = {};  ///< why it could not be loaded; then nothing else is set
    char missing[64] = {};  ///< the function that it has not
    char note[128] = {};    ///< what loading it did to the floating-point environment
};

/// The text, cut to its room.
template <std::size_t n>
void put(char (&to)[n], const char* text) {
    std::snprintf(to, n, "%s", text == nullptr ? "" : text);
}

/// The functions of barycert/kernel.h in a library, null where it has none of the name.
struct LibraryFunctions {
    void (*describe)(barycert_kernel_info* info) = nullptr;
    WeightsFunction weights = nullptr;
    ClassifyFunction classify = nullptr;
    CaseValueFunction value = nullptr;

    LibraryFunctions() = default;
    explicit LibraryFunctions(void* library);

    /// Returns the library's description of itself, or which function is missing.
    Description described() const;
};

enum class Command : char { describe = 'd', run = 'r' };

struct Channel {
    // From the program.
    Simplex simplex = Simplex::tetrahedron;
    int stride = 3;  ///< numbers of a vertex
    std::uint32_t first = 0, count = 0;
    bool timed = false;  ///< also run all of it again, without checks, against the clock
    std::array<Case, batch_size> cases;

    // From the worker.
    std::atomic<std::uint64_t> begun{0};     ///< cases begun since it started, those run again counted again
    std::atomic<std::uint32_t> current{0};   ///< the case that is being run
    std::atomic<std::uint32_t> complete{0};  ///< answers below this one are complete
    std::atomic<bool> beside{false};         ///< it died of a touch beside its arrays
    std::atomic<bool> closed{false};         ///< it ended since descriptors were closed that the kernel had not opened
    std::array<Answer, batch_size> answers;  ///< nothing of them is believed: a kernel may have written there
    double ns = -1;                          ///< per evaluation, if timed
    char detail[160] = {};                   ///< of the first incident of the batch that it survived
    Description description;                 ///< after Command::describe
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<std::uint32_t>::is_always_lock_free,
              "shared by processes");

/// Loads the library at `path` and answers commands from the socket until it closes. Called in a process of its own,
/// which it ends. `printed` is a file for what the library writes to stdout or stderr.
[[noreturn]] void run_worker(Channel& channel, int socket, int printed, const char* path);

/// Forks workers for the program at the other end of the socket, until that closes. Likewise.
[[noreturn]] void run_server(Channel* channels, int socket, const char* path);

/// The program's request to the server, with the worker's socket for `fork_worker`; the answer is an int.
struct ServerRequest {
    enum Kind : std::uint32_t {
        fork_worker,  ///< answers the process id, or -errno
        end_worker,   ///< ends the worker of the channel if it runs still; answers its status as waitpid tells it
    } kind = fork_worker;
    std::uint32_t channel = 0;
    int milliseconds = 0;  ///< for `end_worker`: time that it has to end by itself
};

/// Kills the children of this process but those `kept` and waits for them, and for the orphans that come to it
/// thereby if it adopts them (PR_SET_CHILD_SUBREAPER). True if there were any.
bool end_children(std::span<const pid_t> kept);

}  // namespace barycert::kernels

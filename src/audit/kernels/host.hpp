/// The process of a user's kernel, seen from the program.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "audit/kernels/channel.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "files/child_process.hpp"
#include "files/descriptor.hpp"

namespace barycert::kernels {

/// Statement of a kernel about a case, whether it runs in this process or in one of its own.
struct Statement : Answer {
    bool ran = true;                      ///< false: the kernel has been given up, and was not asked
    bool answered = true;                 ///< false: it ran and gave no answer
    Region claimed = Region::degenerate;  ///< by the kernel's rule
};

struct Asked {
    double ns = -1;      ///< per evaluation; -1 unless asked for
    std::string detail;  ///< what it did besides answering, in words; empty if nothing
};

class Host {
public:
    /// Cases that it may fail to answer, or leave a process behind in, before it is given up: a hang costs as much as
    /// 64 crashes.
    static constexpr int patience = 1024, patience_for_hang = 64;

    /// Starts the processes and loads the library once. Errors as of load_kernel_library().
    static Result<std::shared_ptr<Host>> start(const std::string& path, double seconds);
    ~Host();
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    /// The kernel's description of itself, without error, missing and note.
    const Description& description() const { return description_; }

    enum class Asking {
        usual,
        timed,         ///< also against the clock
        given_up_too,  ///< even if it has been given up
    };

    /// Asks for at most batch_size cases of one simplex, and sets as many statements, `claimed` aside. The detail is of
    /// the last case that it did not survive, else of the first with an incident. From any thread.
    Asked run(std::span<const Case> cases, std::span<Statement> statements, Asking asking);

private:
    struct Worker {
        std::uint32_t channel = 0;
        base::Descriptor socket{};  ///< none: none runs
    };
    enum class End { done, died, hung, no_process };

    Host() = default;
    Worker take();
    void give_back(Worker&& worker);
    int ask_server(ServerRequest request, int with_socket);
    End begin(Worker& worker);
    int end(Worker& worker, int milliseconds = 0);
    End command(Worker& worker, Command command, int milliseconds);
    Channel* channels() { return reinterpret_cast<Channel*>(memory_.get()); }
    Channel& channel(const Worker& worker) { return channels()[worker.channel]; }

    int milliseconds_ = 1000, loading_milliseconds_ = 0;
    base::Mapping memory_;
    base::Descriptor server_socket_;
    base::ChildProcess server_;  // its keeper, which ends with it
    Description description_;
    std::mutex mutex_, server_mutex_;
    std::condition_variable freed_;
    std::vector<Worker> free_;
    std::atomic<int> patience_left_{patience};
};

}  // namespace barycert::kernels

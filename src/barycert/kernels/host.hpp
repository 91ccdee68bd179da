/// The process of a user's kernel, seen from the program.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>

#include "barycert/kernels/channel.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert::kernels {

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

    /// What it says of itself; error, missing and note aside.
    const Description& description() const { return description_; }

    /// Cases that were put to it are `ran`; others were left out because it has been given up.
    struct Reply {
        Answer answer;
        bool ran = false, answered = false;
    };
    struct Batch {
        double ns = -1;      ///< per evaluation; -1 unless asked for
        std::string detail;  ///< of the last case that it did not survive, else of the first with an incident
    };

    enum class Asking {
        usual,
        timed,         ///< also against the clock
        given_up_too,  ///< even if it has been given up
    };

    /// Asks for at most batch_size cases of one simplex. From any thread.
    Batch run(std::span<const Case> cases, std::span<Reply> replies, Asking asking);

private:
    struct Worker {
        std::uint32_t channel = 0;
        int socket = -1;  ///< -1: none runs
    };
    enum class End { done, died, hung, no_process };

    Host() = default;
    Worker take();
    void give_back(const Worker& worker);
    int ask_server(const ServerRequest& request, int with_socket);
    End begin(Worker& worker);
    int end(Worker& worker, int milliseconds = 0);
    End command(Worker& worker, Command command, int milliseconds);
    Channel& channel(const Worker& worker) { return channels_[worker.channel]; }

    std::string path_;
    int milliseconds_ = 1000, loading_milliseconds_ = 0;
    Channel* channels_ = nullptr;
    int server_socket_ = -1;
    int server_ = -1;  // its keeper, which ends with it
    Description description_;
    std::mutex mutex_, server_mutex_;
    std::condition_variable freed_;
    std::vector<Worker> free_;
    std::atomic<int> patience_left_{patience};
};

}  // namespace barycert::kernels

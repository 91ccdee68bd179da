/// A run that is told to end leaves no half files behind.
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace barycert::cli {

/// While it lives, SIGINT, SIGTERM and SIGHUP first remove what OutputFile has begun beside these targets, then end the
/// process as they would have. What a SIGKILL leaves is TARGET.tmp-..., never a half target. Make it before the first
/// thread: signals are blocked in all that are started later. Signals that the process ignores stay ignored.
class RemoveOnSignal {
public:
    explicit RemoveOnSignal(std::vector<std::string> targets);
    ~RemoveOnSignal();
    RemoveOnSignal(const RemoveOnSignal&) = delete;
    RemoveOnSignal& operator=(const RemoveOnSignal&) = delete;

private:
    std::atomic<bool> over_ = false;
    std::thread waiting_;
};

}  // namespace barycert::cli

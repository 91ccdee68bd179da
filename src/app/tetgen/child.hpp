/// Runs a piece of work in a child process, so that whatever it does, the parent can tell what happened.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace barycert {

/// Tells the parent something, while the child lives. The clock of the timeout stops at the first answer.
using Answer = std::function<void(std::string_view text)>;

struct ChildOutcome {
    std::string answer;   ///< everything sent
    std::string printed;  ///< everything written to stdout and stderr
    bool timed_out = false;
    std::optional<int> signal;  ///< the signal that ended it
    int exit_code = 0;          ///< where no signal did; finished_code if `work` returned
    std::string failure;        ///< why there was no child at all; else empty
};

/// The code of a child whose work returned: no other code of the child's means that.
inline constexpr int finished_code = 86;

/// Runs `work` in a child with its stdout and stderr captured, and waits for it. A child that has sent no answer
/// after `timeout_seconds` (0: no limit) is killed. The caller must not have started threads.
ChildOutcome run_in_child(const std::function<void(const Answer&)>& work, double timeout_seconds);

}  // namespace barycert

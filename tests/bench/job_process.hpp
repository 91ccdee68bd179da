/// Whole processes by the clock.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace barycert::bench {

struct Spent {
    double wall = 0, cpu = 0;  ///< seconds; cpu: user and system, of all threads
    double peak_mib = 0;       ///< resident memory at its peak
};

/// Runs a program, what it prints going nowhere, and ends this one if it fails.
Spent run_process(const std::vector<std::string>& words);

/// Does `work` in a process of its own and ends this one if that fails. The peak of a process counts from that of its
/// parent on: the one that measures must stay small.
void apart(const std::function<void()>& work);

}  // namespace barycert::bench

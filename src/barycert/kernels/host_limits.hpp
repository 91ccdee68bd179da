/// Bounds of the processes of a user's kernel.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdint>
#include <span>

namespace barycert::kernels {

/// Workers of one library at a time: more threads wait for each other.
inline constexpr std::uint32_t max_workers = 64;

/// Bytes of a file that a worker may write, so that a kernel that prints without end does not fill the memory.
inline constexpr rlim_t output_limit = rlim_t{1} << 26;

/// The time that loading the library may take, or the limit for a case if that is more.
inline constexpr int min_loading_milliseconds = 10000;

/// Limits this process in what it writes, in memory and in how many processes and threads it starts.
void limit_worker();

/// Kills the children of this process but those `kept` and waits for them, and for the orphans that come to it
/// thereby if it adopts them (PR_SET_CHILD_SUBREAPER). True if there were any.
bool end_children(std::span<const pid_t> kept);

}  // namespace barycert::kernels

/// Bounds of the processes of a user's kernel.
#pragma once

#include <sys/resource.h>

#include <cstdint>

namespace barycert::kernels {

/// Workers of one library at a time: more threads wait for each other.
inline constexpr std::uint32_t max_workers = 64;

/// Bytes of a file that a worker may write, so that a kernel that prints without end does not fill the memory.
inline constexpr rlim_t output_limit = rlim_t{1} << 26;

/// The time that loading the library may take, or the limit for a case if that is more.
inline constexpr int min_loading_milliseconds = 10000;

}  // namespace barycert::kernels

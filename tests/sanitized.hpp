/// Cost of sanitizers, for tests that bound time or memory.
#pragma once

namespace barycert::testing {

/// sanitized: the memory of the process is not that of the program alone. slowdown: times by which it may be slower.
#if defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
inline constexpr double slowdown = 20;
#elif defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
inline constexpr double slowdown = 5;
#else
inline constexpr bool sanitized = false;
inline constexpr double slowdown = 1;
#endif

}  // namespace barycert::testing

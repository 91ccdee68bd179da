/// How much memory of the heap a piece of work had at one time.
#pragma once

#include <cstddef>

namespace barycert::fuzz {

/// From now on.
void begin_memory();

/// The most bytes at one time since then, beyond those at that time; of all threads.
std::size_t peak_memory();

}  // namespace barycert::fuzz

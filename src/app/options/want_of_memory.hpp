/// The end of a program for want of memory.
#pragma once

namespace barycert::cli {

/// "error: out of memory; ..." on stderr, without memory of its own; returns 2, the exit code.
int fail_for_want_of_memory() noexcept;

/// For main functions: from now on that is also how the program ends where a library that promises to throw nothing
/// needs memory all the same (CLI11, std::filesystem, nlohmann::json). Unfinished files are removed.
void expect_want_of_memory() noexcept;

/// From now on at once, with no exception: nlohmann::json before 3.11.3 destroys what it had no memory to make.
void end_for_want_of_memory() noexcept;

}  // namespace barycert::cli

/// A target of the fuzzer: it takes bytes, and ends the process if anything is wrong with what is done with them.
///
/// A target is one source of targets/. libFuzzer runs it from an executable of its own (fuzzer.cpp, Clang), the tests
/// run all of them over the inputs in corpus/ and found/ (replay.cpp, any compiler).
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::fuzz {

/// Memory that a target may have at one time beyond what it had at the beginning: `fixed` bytes, and `per_byte` for
/// each byte of the input. Buffers of files are fixed, and so is what a small machine has to spare; a count in a header
/// that is believed is neither.
struct MemoryLimit {
    std::size_t fixed = std::size_t{4} << 20, per_byte = 256;
};

struct Target {
    const char* name;
    void (*run)(std::string_view input);
    MemoryLimit memory = {};
};

/// All that are linked in, in no order.
std::vector<Target>& targets();

struct Registered {
    explicit Registered(const Target& target) { targets().push_back(target); }
};

/// Runs a target on one thread, and holds it to its memory.
void run(const Target& target, std::string_view input);

/// Ends the process with these words.
[[noreturn]] void fail(std::string_view what, std::string_view detail = {});

inline void expect(bool holds, std::string_view what, std::string_view detail = {}) {
    if (!holds) fail(what, detail);
}

/// An Error that a user can do something with: it says what, in one line without control characters, and of which file;
/// a line that it names is one of the file's, or where the next one was missed. `lines`: of the longest file that was
/// given.
void expect_useful(const Error& error, std::size_t lines);

/// How many lines a text has: a line without an end is one.
std::size_t lines_of(std::string_view text);

}  // namespace barycert::fuzz

/// BARYCERT_FUZZ_TARGET(NAME) { ... input ... }, and perhaps a MemoryLimit after the name.
#define BARYCERT_FUZZ_TARGET(NAME, ...)                                                                           \
    static void NAME##_target(std::string_view input);                                                            \
    static const barycert::fuzz::Registered NAME##_registered({#NAME, NAME##_target __VA_OPT__(, ) __VA_ARGS__}); \
    static void NAME##_target(std::string_view input)

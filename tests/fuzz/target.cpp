#include "tests/fuzz/target.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/fuzz/memory.hpp"

namespace barycert::fuzz {

std::vector<Target>& targets() {
    static std::vector<Target> all;
    return all;
}

void run(const Target& target, std::string_view input) {
    // Threads would only make an execution slow, and a finding hard to repeat.
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    // Memory that is taken once and kept, such as the tables of a library, is not the input's.
    static const bool warm = (target.run({}), true);
    static_cast<void>(warm);
    begin_memory();
    target.run(input);
    const std::size_t peak = peak_memory(), most = target.memory.fixed + target.memory.per_byte * input.size();
    if (peak > most) {
        fail("more memory than the input explains",
             std::to_string(peak) + " bytes for " + std::to_string(input.size()) + ", at most " + std::to_string(most));
    }
}

void fail(std::string_view what, std::string_view detail) {
    std::fprintf(stderr, "fuzz: %.*s%s%.*s\n", static_cast<int>(what.size()), what.data(), detail.empty() ? "" : ": ",
                 static_cast<int>(detail.size()), detail.data());
    std::abort();
}

void expect_useful(const Error& error, std::size_t lines) {
    const std::string message = error.message();
    expect(!error.what.empty(), "an error that does not say what", message);
    expect(!error.file.empty(), "an error without a file", message);
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    expect(std::none_of(message.begin(), message.end(), control), "an error message with control characters", message);
    expect(error.line <= lines + 1, "an error in a line that the file has not", message);
}

std::size_t lines_of(std::string_view text) {
    const auto ends = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    return ends + (text.empty() || text.back() != '\n' ? 1 : 0);
}

}  // namespace barycert::fuzz

/// How readers and writers refuse a file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "files/input_file.hpp"

namespace barycert::io {

/// Throw an Error about a line of the file, or about the file, as an Exception.
[[noreturn]] inline void refuse_line(ErrorCode code, std::string file, std::size_t line, std::string what,
                                     std::string expected = {}, std::string found = {}, std::string remedy = {}) {
    throw Exception(
        {code, std::move(what), std::move(file), line, std::move(expected), std::move(found), std::move(remedy)});
}
[[noreturn]] inline void refuse_file(ErrorCode code, std::string file, std::string what, std::string expected = {},
                                     std::string found = {}, std::string remedy = {}) {
    refuse_line(code, std::move(file), 0, std::move(what), std::move(expected), std::move(found), std::move(remedy));
}

/// Returns the error that the suffix is not one of those `expected`.
Error unknown_suffix(const std::string& path, std::string what, std::string expected, std::string remedy);

/// read() in the environment of exact results. Error: what it throws as an Exception; memory is short.
template <class Read>
auto read_guarded(const std::string& path, const Read& read) -> decltype(Result(read())) try {
    const ExactEnvironment environment;
    return read();
} catch (const Exception& problem) {
    return problem.error();
} catch (const std::bad_alloc&) {
    return base::too_little_memory(path);
}

/// Calls f(); returns what it throws as an Exception as a Status.
template <class F>
Status status_of(const F& f) try {
    f();
    return Done{};
} catch (const Exception& problem) {
    return problem.error();
}

/// The line of a text in which `at` lies, from 1.
inline std::size_t line_of(std::string_view text, const char* at) {
    return static_cast<std::size_t>(std::count(text.data(), at, '\n')) + 1;
}

}  // namespace barycert::io

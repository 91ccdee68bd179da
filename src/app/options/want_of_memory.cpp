#include "app/options/want_of_memory.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "files/output_file.hpp"

namespace barycert::cli {
namespace {

[[noreturn]] void end() noexcept {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        base::remove_begun_files();
        std::_Exit(fail_for_want_of_memory());
    } catch (...) {
    }
    std::abort();
}

}  // namespace

int fail_for_want_of_memory() noexcept {
    constexpr std::string_view text =
        "error: out of memory; use a smaller mesh or picture, fewer threads or a machine with more memory\n";
    while (::write(STDERR_FILENO, text.data(), text.size()) < 0 && errno == EINTR) {
    }
    return 2;
}

void expect_want_of_memory() noexcept {
    std::set_terminate(end);
}

void end_for_want_of_memory() noexcept {
    std::set_new_handler([] {
        base::remove_begun_files();
        std::_Exit(fail_for_want_of_memory());
    });
}

}  // namespace barycert::cli

// Want of memory in CGAL's numbers. GMP cannot report a failed allocation: it aborts, and no exception may pass through
// it. An exception that passes through std::call_once needs a part of the C library that is loaded then.

#include <gmp.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <new>

#include "app/cli/command.hpp"
#include "app/options/want_of_memory.hpp"
#include "files/output_file.hpp"

namespace barycert::cli {
namespace {

void* or_end(void* memory) {
    if (memory != nullptr) return memory;
    base::remove_begun_files();
    ::_exit(fail_for_want_of_memory());
}

/// As early as what the loader does, for it needs memory.
const bool loaded = [] {
    try {
        std::once_flag never;
        std::call_once(never, [] { throw std::bad_alloc(); });
    } catch (const std::bad_alloc&) {
        return true;
    }
    return false;
}();

}  // namespace

void prepare_for_want_of_memory() {
    mp_set_memory_functions(
        [](std::size_t size) { return or_end(std::malloc(size)); },
        [](void* old, std::size_t /*old_size*/, std::size_t size) { return or_end(std::realloc(old, size)); },
        [](void* memory, std::size_t /*size*/) { std::free(memory); });
}

}  // namespace barycert::cli

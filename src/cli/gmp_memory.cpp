// GMP cannot report a failed allocation: by itself it aborts, and an exception may not pass through it.

#include <gmp.h>
#include <unistd.h>

#include <cstdlib>

#include "barycert/base/begun_files.hpp"
#include "command.hpp"

namespace barycert::cli {
namespace {

void* or_end(void* memory) {
    if (memory != nullptr) return memory;
    base::remove_begun_files();
    ::_exit(fail_for_want_of_memory());
}

void* allocate(std::size_t size) {
    return or_end(std::malloc(size));
}
void* resize(void* old, std::size_t /*old_size*/, std::size_t size) {
    return or_end(std::realloc(old, size));
}
void release(void* memory, std::size_t /*size*/) {
    std::free(memory);
}

}  // namespace

void end_when_gmp_wants_memory() {
    mp_set_memory_functions(allocate, resize, release);
}

}  // namespace barycert::cli

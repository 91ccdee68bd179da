// Shared libraries of kernels, looked at before the system loads them.
#include "audit/kernels/registry.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(elf) {
    static InputFile file("in.so");
    const Status status = kernels::check_shared_library(file.put(input));
    if (!status) expect_useful(status.error(), lines_of(input));
}

}  // namespace barycert::fuzz

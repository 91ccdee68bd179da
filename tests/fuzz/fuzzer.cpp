// The executable of one target: libFuzzer brings main.
#include <cstdint>

#include "tests/fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    barycert::fuzz::run(barycert::fuzz::targets().front(), {reinterpret_cast<const char*>(data), size});
    return 0;
}

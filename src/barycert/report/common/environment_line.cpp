#include <fmt/format.h>

#include "barycert/report.hpp"

namespace barycert {

std::string environment_line(const Environment& e) {
    return fmt::format("barycert {}, {}, rounding {}, contraction {}, subnormals {}, SIMD {}{}", e.version, e.compiler,
                       e.rounding, e.contraction ? "ON" : "off", e.flush_to_zero ? "FLUSHED" : "kept", e.simd,
                       e.fma ? ", FMA" : "");
}

}  // namespace barycert

/// Bytes packed by zlib.
#pragma once

#include <string>
#include <string_view>

namespace barycert::base {

/// The bytes in the format of zlib; empty where memory is short. `level`: 1 (fast) to 12 (small).
std::string deflated(std::string_view plain, int level);

}  // namespace barycert::base

/// Requirements that must hold before anything is timed.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace barycert::bench {

/// Says what is wrong and ends the program: nothing is timed whose answers are not right.
inline void require(bool holds, std::string_view what) {
    if (holds) return;
    std::fprintf(stderr, "wrong: %.*s\n", static_cast<int>(what.size()), what.data());
    std::exit(1);
}

}  // namespace barycert::bench

// Internal: what a source of SIMD lanes begins with. It is compiled once for each target, by including itself:
//
//     #undef HWY_TARGET_INCLUDE
//     #define HWY_TARGET_INCLUDE "core/lanes.cpp"
//     #include "core/foreach_target.hpp"
//
// No #pragma once: every pass needs it. Without HWY_TARGET_INCLUDE it is Highway for one target.
// clang-format off
#include "core/simd_targets.hpp"
#ifdef HWY_TARGET_INCLUDE
#include <hwy/foreach_target.h>
#endif
#include <hwy/highway.h>
// clang-format on

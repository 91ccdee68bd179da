/// The SIMD targets that lanes are compiled for. Comes before any header of Highway's, in every source and
/// header that includes one.
///
/// Three on x86-64: what every processor has (emulated by Highway 1.0, for which SSE2 lacks too much; with 1.2 SSE2
/// itself), AVX2 with fused multiply-add, AVX-512. The ones between cost compile time and serve few. Targets above
/// AVX-512 (AVX3_DL) add nothing here, but must be named: where the compiler is told of a processor that has them
/// (-march=native), Highway takes them for the least there is, and then refuses to compile for want of them among the
/// targets to choose from. Vectors without a size (SVE, RVV) do not go into structs.
#pragma once

#if defined(HWY_STATIC_TARGET)
#error "core/simd_targets.hpp must come before Highway's headers"
#endif

// Before the compiler's intrinsics, which Clang compiles to arithmetic.
#include "core/base/strict_math.hpp"

// Built for this machine alone (BARYCERT_SIMD in cmake/BarycertFlags.cmake), of two the one that it does not use is
// left out. Results are the same on any other, of those without it slower.
#if defined(BARYCERT_WITHOUT_AVX2)
#define BARYCERT_NOT_USED HWY_AVX2
#elif defined(BARYCERT_WITHOUT_AVX512)
#define BARYCERT_NOT_USED HWY_AVX3
#else
#define BARYCERT_NOT_USED 0
#endif

#define HWY_DISABLED_TARGETS \
    (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | BARYCERT_NOT_USED)

// On 64-bit ARM one target is left, NEON, which every such processor has: there is nothing to choose at run time. Told
// so, Highway leaves out attributes for that target (instructions for AES, which nothing here uses), by which GCC could
// not inline formulas where there are no lanes.
#if defined(__aarch64__) && !defined(TOOLCHAIN_MISS_SYS_AUXV_H)
#define TOOLCHAIN_MISS_SYS_AUXV_H
#endif

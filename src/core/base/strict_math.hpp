/// Refuses to compile where the compiler may change what is computed, or forbids it to. Included by all exact code,
/// before what computes, for those who compile without cmake/BarycertFlags.cmake.
///
/// GCC tells of every such flag by a macro: __GCC_IEC_559 is 0 under any part of -ffast-math that touches results.
/// Clang tells of -ffast-math and -ffinite-math-only alone; of the others (-funsafe-math-optimizations,
/// -fassociative-math, -freciprocal-math, -fno-signed-zeros, -fapprox-func) it says nothing, and the pragmas take them
/// back for what follows in the source. Neither tells of -ffp-contract, GCC's default of which is `fast`: that is
/// measured at run time (environment.hpp).
#pragma once

#include <cfloat>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0) ||        \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) || \
    (defined(__GCC_IEC_559) && __GCC_IEC_559 == 0)
#error "barycert is not correct under -ffast-math or a part of it: compile it without"
#endif

#ifdef __clang__
#pragma float_control(precise, on)
#pragma STDC FP_CONTRACT OFF
#endif

static_assert(FLT_EVAL_METHOD == 0, "barycert needs doubles evaluated as doubles: compile it with -mfpmath=sse");

namespace barycert::base {

/// x. Beside an ExactEnvironment: compilers move neither the computation of x nor what depends on it across this call.
template <class T>
[[gnu::always_inline]] inline T held(T x) {
    __asm__ volatile("" : "+m"(x) : : "memory");
    return x;
}

}  // namespace barycert::base

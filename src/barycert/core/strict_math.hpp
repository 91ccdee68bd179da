/// Internal: refuses to compile where the compiler may change what is computed. Included by all exact code.
#pragma once

#include <cfloat>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "barycert is not correct under -ffast-math: compile it without"
#endif

static_assert(FLT_EVAL_METHOD == 0, "barycert needs doubles evaluated as doubles: compile it with -mfpmath=sse");

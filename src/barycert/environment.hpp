/// The one way in which this library meets the floating-point environment: it sets its own for the call.
///
/// What exact and correctly rounded answers need of the calling thread: rounding to nearest, ties to even; subnormal
/// operands and results kept (no flush-to-zero, no denormals-are-zero); floating-point exceptions masked; where there
/// is x87 arithmetic, all 64 bits of its significands. That is the environment in which a process starts. A caller may
/// have changed it: fesetround, a library linked with -ffast-math, an audio or a simulation framework.
///
/// The rule. Every public function whose answer could depend on the environment begins with an ExactEnvironment: it
/// looks at the control registers (less than a nanosecond), and only where they are not as above sets them for the
/// calling thread, and the caller's again when it returns or throws. So answers, counts of tiers and the signs of zeros
/// are the same in every environment. Nothing is set by functions that answer by integers, or by a filter that holds in
/// every environment: signs (predicates.hpp) and inverse.hpp.
///
/// Threads. Those of std::thread start with the environment of the thread that starts them. Those of oneTBB take over
/// that in which the arena was made, not that of the caller of an algorithm: within the scope of an ExactEnvironment
/// work goes to an arena made there, or each task has an ExactEnvironment of its own.
///
/// Foreign code that the library calls (progress, sinks of grids, kernels under audit, factories of VTK) runs in the
/// exact environment; what it leaves behind ends with renew().
///
/// What no call can set is refused when it is compiled (strict_math.hpp) or told by check_environment
/// (environment.hpp): contraction, excess precision.
///
/// Exception flags are not preserved.
#pragma once

#include <cfenv>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"

// The one way in which this library meets the floating-point environment: it sets its own for the call.
//
// What exact and correctly rounded answers need of the calling thread: rounding to nearest, ties to even; subnormal
// operands and results kept (no flush-to-zero, no denormals-are-zero); floating-point exceptions masked; where there
// is x87 arithmetic, all 64 bits of its significands. That is the environment in which a process starts. A caller may
// have changed it: fesetround, a library linked with -ffast-math, an audio or a simulation framework.
//
// The rule. Every public function whose answer could depend on the environment begins with an ExactEnvironment: it
// looks at the control registers (less than a nanosecond), and only where they are not as above sets them for the
// calling thread, and the caller's again when it returns or throws. So answers, counts of tiers and the signs of zeros
// are the same in every environment. Nothing is set by functions that answer by integers, or by a filter that holds in
// every environment: signs (predicates.hpp) and inverse.hpp.
//
// Threads. Those of std::thread start with the environment of the thread that starts them. Those of oneTBB take over
// that in which the arena was made, not that of the caller of an algorithm: within the scope of an ExactEnvironment
// work goes to an arena made there, or each task has an ExactEnvironment of its own.
//
// Foreign code that the library calls (progress, sinks of grids, kernels under audit, factories of VTK) runs in the
// exact environment; what it leaves behind ends with renew().
//
// What no call can set is refused when it is compiled (strict_math.hpp) or told by check_environment
// (environment.hpp): contraction, excess precision.
//
// Exception flags are not preserved.

namespace barycert {

/// The control registers of the calling thread are as above: a quick look.
bool rounds_correctly();

/// The environment above, in the calling thread, for as long as it lives; after that what was before.
///
/// Compilers do not know that arithmetic depends on it. They keep loads and stores where they stand, for the functions
/// that set registers might look at memory; but arithmetic on arguments, and that of a result which is returned in a
/// register, they may carry across, calls of functions without side effects included (GCC 12 does). Such numbers are
/// `held`.
class ExactEnvironment {
public:
    ExactEnvironment() {
        if (!rounds_correctly()) [[unlikely]]
            enter();
    }
    ~ExactEnvironment() {
        if (changed_) [[unlikely]]
            leave();
    }
    ExactEnvironment(const ExactEnvironment&) = delete;
    ExactEnvironment& operator=(const ExactEnvironment&) = delete;

    /// Sets the environment once more, after foreign code. Precondition: an ExactEnvironment lives in this thread, or
    /// the thread is one of a pool that works for it.
    static void renew() {
        if (!rounds_correctly()) [[unlikely]]
            set();
    }

private:
    // Out of line and not to be looked into: see above.
    void enter();
    void leave() const;
    static void set();

    bool changed_ = false;
#if defined(__SSE2__)
    std::uint32_t sse_ = 0;  ///< the caller's MXCSR
    std::uint16_t x87_ = 0;  ///< the caller's x87 control word
#else
    std::fenv_t before_{};
#endif
};

/// x; what it is computed from is computed before, and what is computed from it after, what stands around.
template <class T>
[[gnu::always_inline]] inline T held(T x) {
    __asm__ volatile("" : "+m"(x) : : "memory");
    return x;
}

// The floating-point environment as it is measured, for reports.
//
// Exactness needs rounding to nearest, gradual underflow, doubles evaluated as doubles, and no contraction of
// a * b + c into one rounding. All four are measured at run time, in the code as it was compiled. The first two are
// what every call sets for itself (environment.hpp); the others are the compiler's, and nothing mends them at
// run time.

struct Environment {
    std::string rounding;           ///< "nearest", "upward", "downward", "toward-zero"
    bool flush_to_zero = false;     ///< subnormal results or operands are replaced by zero
    bool contraction = false;       ///< a * b + c was rounded once
    bool excess_precision = false;  ///< intermediate results carry more than 53 bits
    std::string simd;               ///< target that batches run on, see simd.hpp
    bool fma = false;               ///< the processor has fused multiply-add
    std::string compiler;
    std::string version;  ///< of barycert
    int hardware_threads = 1;
};

/// Measures the environment of the calling thread.
Environment measure_environment();

/// An Error naming what breaks exactness and the remedy, if anything does.
Status check_environment(const Environment& environment);

// Which SIMD target batches run on. Answers never depend on it; time does.

/// Names of the targets that this build has and this processor can run, the widest first: on x86-64 "AVX-512", "AVX2"
/// and "scalar", the fallback that every processor can run.
std::vector<std::string> simd_targets();

/// The target in use.
std::string simd_target();

/// Use this target from now on; an empty name restores the choice at start. Returns false, and changes nothing, if the
/// name is none of simd_targets(). For tests and measurements: not to be called while a batch runs.
bool use_simd_target(std::string_view name);

}  // namespace barycert

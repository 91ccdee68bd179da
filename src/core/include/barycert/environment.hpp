/// The floating-point environment: what exact answers need of it, how the library sets it, and how it is measured.
///
/// Exact and correctly rounded answers need, in the calling thread: rounding to nearest, ties to even; subnormal
/// operands and results kept (no flush-to-zero, no denormals-are-zero); floating-point exceptions masked; where there
/// is x87 arithmetic, all 64 bits of its significands. A process starts in that environment. fesetround, a library
/// linked with -ffast-math, an audio or a simulation framework may have changed it.
///
/// The rule: every public function whose answer could depend on the environment begins with an ExactEnvironment. It
/// reads the control registers (less than a nanosecond); if they are not as above it sets them for the calling thread,
/// and restores the caller's when the function returns or throws. So answers, counts of tiers and the signs of zeros
/// are the same in every environment. Functions that answer by integers, or by a filter that holds in every
/// environment, set nothing: the predicates of single points (predicates.hpp) and weights.hpp.
///
/// Threads. A std::thread starts with the environment of the thread that starts it. Threads of oneTBB take over that in
/// which the arena was made, not that of the caller of an algorithm: within the scope of an ExactEnvironment, work must
/// go to an arena made there, or each task must have an ExactEnvironment of its own.
///
/// Foreign code that the library calls (progress, sinks of grids, kernels under audit, factories of VTK) runs in the
/// exact environment; renew() sets it again after that code.
///
/// Contraction and excess precision, which no call can set, are refused at compile time (strict_math.hpp) or reported
/// by check_environment.
///
/// Exception flags are not preserved.
///
/// Example:
///
///     #include <cfenv>
///     #include "barycert/predicates.hpp"
///     std::fesetround(FE_UPWARD);
///     const double a[] = {0, 0}, b[] = {1, 0}, c[] = {0, 1};
///     const Sign sign = orient2d(a, b, c);                     // as in any other environment
///     const Status exact = check_environment(measure_environment());  // an Error that names the rounding mode
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"

namespace barycert {

/// Returns whether the control registers of the calling thread are as above.
bool rounds_correctly();

/// Sets the environment above in the calling thread for as long as it lives; then restores the one before.
///
/// Compilers do not know that arithmetic depends on it. They keep loads and stores in place, as the functions that set
/// registers might read memory; but they may move arithmetic on arguments, and that of a result which is returned in a
/// register, across it, calls of functions without side effects included (GCC 12 does). The library passes such numbers
/// through a barrier (base::held, strict_math.hpp); a volatile variable is one as well.
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

    /// Sets the environment again, after foreign code. Requires an ExactEnvironment that lives in this thread, or a
    /// thread of a pool that works for one.
    static void renew() {
        if (!rounds_correctly()) [[unlikely]]
            set();
    }

private:
    // Out of line, so that compilers cannot see into them: see above.
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

/// The floating-point environment as it is measured at run time, in the code as it was compiled, for reports. Rounding
/// and gradual underflow every call sets for itself; contraction and excess precision are the compiler's, and nothing
/// repairs them at run time.
struct Environment {
    std::string rounding;           ///< "nearest", "upward", "downward", "toward-zero"
    bool flush_to_zero = false;     ///< subnormal results or operands are replaced by zero
    bool contraction = false;       ///< a * b + c was rounded once
    bool excess_precision = false;  ///< intermediate results carry more than 53 bits
    std::string simd;               ///< target that batches run on, see simd_targets()
    bool fma = false;               ///< the processor has fused multiply-add
    std::string compiler;
    std::string version;  ///< of barycert
    int hardware_threads = 1;
};

/// Returns the environment of the calling thread.
Environment measure_environment();

/// Returns an Error that names what breaks exactness, and the remedy, if anything does.
Status check_environment(const Environment& environment);

/// Returns the names of the SIMD targets that this build has and this processor can run, the widest first: on x86-64
/// "AVX-512", "AVX2" and what all can run, "scalar" (with Highway 1.2 "SSE2"); on 64-bit ARM "NEON". Answers never
/// depend on it; time does.
std::vector<std::string> simd_targets();

/// Returns the name of the target in use.
std::string simd_target();

/// Use this target from now on; an empty name restores the choice at start. Returns false, and changes nothing, if the
/// name is not one of simd_targets(). For tests and measurements: must not be called while a batch runs.
bool use_simd_target(std::string_view name);

}  // namespace barycert

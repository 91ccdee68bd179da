#include "barycert/environment.hpp"

#include <cfloat>
#include <thread>

#include "barycert/base/strict_math.hpp"
#include "barycert/core/lanes.hpp"

namespace barycert::core {
namespace {

// Volatile operands keep the compiler from folding what is to be measured.
double volatile_value(double x) {
    volatile double v = x;
    return v;
}

// 1 + 2^-54 lies below the middle of 1 and its upper neighbour, 1 + 3*2^-54 above it; with the first one mirrored they
// tell the four modes apart. The mode register is not asked, because it may lie about the unit that computes (x87
// against SSE).
std::string measured_rounding() {
    const double one = volatile_value(1);
    const double over = volatile_value(0x3p-54);
    const double under = volatile_value(0x1p-54);
    const double up = volatile_value(one + under);
    const double down = volatile_value(one + over);
    const double negative = volatile_value(-one - under);
    if (up > 1) return "upward";
    if (negative < -1) return "downward";
    return down > 1 ? "nearest" : "toward-zero";
}

bool measured_flush_to_zero() {
    const double smallest_normal = volatile_value(DBL_MIN);
    const double result = volatile_value(smallest_normal * 0.5);                  // flush-to-zero shows here
    const double operand = volatile_value(volatile_value(0x1p-1074) * 0x1p+200);  // denormals-are-zero here
    return result == 0 || operand == 0;
}

bool measured_contraction() {
    // (1 + 2^-30)^2 = 1 + 2^-29 + 2^-60: rounded on its own, in any mode, the product loses 2^-60; fused it does not.
    const double x = volatile_value(1 + 0x1p-30);
    const double minus = volatile_value(-(1 + 0x1p-29));
    return x * x + minus == 0x1p-60;
}

bool measured_excess_precision() {
    const double one = volatile_value(1);
    const double tiny = volatile_value(0x1p-60);
    return (one + tiny) - one == tiny;  // rounded upward the sum is 1 + 2^-52
}

bool measured_fma() {
#if defined(__x86_64__) || defined(__i386__)
    return __builtin_cpu_supports("fma");
#else
    return true;
#endif
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

Environment measure_environment() {
    Environment e;
    e.rounding = core::measured_rounding();
    e.flush_to_zero = core::measured_flush_to_zero();
    e.contraction = core::measured_contraction() || core::lanes_contract();
    e.excess_precision = core::measured_excess_precision();
    e.simd = simd_target();
    e.fma = core::measured_fma();
#ifdef __clang__
    e.compiler = std::string("clang ") + __clang_version__;
#else
    e.compiler = std::string("gcc ") + __VERSION__;
#endif
    e.version = BARYCERT_VERSION;
    e.hardware_threads = static_cast<int>(std::thread::hardware_concurrency());
    return e;
}

Status check_environment(const Environment& e) {
    Error error{.what = "results could not be exact in this floating-point environment"};
    if (e.rounding != "nearest") {
        error.expected = "rounding to nearest";
        error.found = "rounding " + e.rounding;
        error.remedy = "restore the mode with fesetround(FE_TONEAREST)";
    } else if (e.flush_to_zero) {
        error.expected = "gradual underflow";
        error.found = "subnormal numbers flushed to zero";
        error.remedy = "clear the FTZ and DAZ bits; a library linked with -ffast-math may have set them";
    } else if (e.contraction || e.excess_precision) {
        error.expected = "every operation rounded to double";
        error.found =
            e.excess_precision ? "excess precision" : "a * b + c contracted";  // the first shows as the second
        error.remedy = "compile barycert with -ffp-contract=off and SSE2 arithmetic";
    } else {
        return Done{};
    }
    return error;
}

}  // namespace barycert

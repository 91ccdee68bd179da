#include "barycert/environment.hpp"

#include <string>
#include <thread>

#include "barycert/result.hpp"
#include "core/base/measured_environment.hpp"
#include "core/lanes.hpp"

namespace barycert::core {
namespace {

using base::volatile_value;

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
    e.rounding = base::measured_rounding();
    e.flush_to_zero = base::measured_flush_to_zero();
    e.contraction = core::lanes_contract();
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
    Error error{.code = "environment.inexact", .what = "results could not be exact in this floating-point environment"};
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

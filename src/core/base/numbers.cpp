// Arithmetic on doubles in an environment of its own: ulps, and random numbers.
#include <cmath>

#include "barycert/environment.hpp"
#include "core/base/random.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/ulp.hpp"

namespace barycert::base {

double ulp_error(double computed, double reference) {
    const ExactEnvironment environment;
    return held(ulp_error_here(held(computed), held(reference)));
}

double next_up(double x) {
    const ExactEnvironment environment;
    return held(std::nextafter(held(x), HUGE_VAL));
}

double next_down(double x) {
    const ExactEnvironment environment;
    return held(std::nextafter(held(x), -HUGE_VAL));
}

double Random::uniform(double lo, double hi) {
    const ExactEnvironment environment;
    lo = held(lo);
    return held(lo + (held(hi) - lo) * unit());
}

double Random::scaled(double lo, double hi, int low, int high) {
    const ExactEnvironment environment;
    const double mantissa = uniform(lo, hi);
    return held(std::ldexp(mantissa, integer(low, high)));
}

}  // namespace barycert::base

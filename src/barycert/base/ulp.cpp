#include "barycert/base/ulp.hpp"

#include <algorithm>
#include <cmath>

#include "barycert/base/strict_math.hpp"
#include "barycert/environment.hpp"

namespace barycert::base {

double ulp_error(double computed, double reference) {
    const ExactEnvironment environment;
    computed = held(computed);
    reference = held(reference);
    double difference = std::fabs(computed - reference);
    int shift = -ulp_exponent(reference);
    if (std::isinf(difference)) {  // both are huge then, and halving them is exact
        difference = std::fabs(computed * 0.5 - reference * 0.5);
        ++shift;
    }
    return held(std::min(std::ldexp(difference, shift), 0x1.fffffffffffffp+1023));
}

double next_up(double x) {
    const ExactEnvironment environment;
    return held(std::nextafter(held(x), HUGE_VAL));
}

double next_down(double x) {
    const ExactEnvironment environment;
    return held(std::nextafter(held(x), -HUGE_VAL));
}

}  // namespace barycert::base

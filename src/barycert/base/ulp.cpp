#include "barycert/base/ulp.hpp"

#include <cmath>

#include "barycert/base/held.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/environment.hpp"

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

}  // namespace barycert::base

#include "barycert/base/random.hpp"

#include <cmath>

#include "barycert/base/held.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/environment.hpp"

namespace barycert::base {

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

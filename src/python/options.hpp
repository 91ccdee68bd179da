/// Options of sampling by the words of Python's arguments.
#pragma once

#include <string>

#include "barycert/sampler.hpp"

namespace barycert::python {

/// `outside`: nan, raise, fill, nearest or extrapolate. Throws an Error of another word.
OutsidePolicy outside_policy(const std::string& outside, double fill, double limit);

/// `nonfinite`: error or nan. Throws an Error of another word.
NonfinitePoints nonfinite_points(const std::string& nonfinite);

/// `rounding`: correct or plain.
SampleOptions sample_options(const std::string& outside, double fill, double limit, const std::string& rounding,
                             int threads, const std::string& nonfinite);

}  // namespace barycert::python

/// Internal: the refusal of functions that need rounding to nearest and gradual underflow.
#pragma once

#include "barycert/core/environment.hpp"
#include "barycert/core/result.hpp"

namespace barycert::detail {

/// What of the calling thread's environment forbids correct rounding. Precondition: rounds_correctly() is false.
inline Error environment_error() {
    const Status status = check_environment(measure_environment());
    return status ? Error{.what = "rounding is not to nearest, or subnormal numbers are flushed to zero"}
                  : status.error();
}

}  // namespace barycert::detail

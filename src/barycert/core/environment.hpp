/// The floating-point environment as it is measured, for reports.
///
/// Exactness needs rounding to nearest, gradual underflow, doubles evaluated as doubles, and no contraction of
/// a * b + c into one rounding. All four are measured at run time, in the code as it was compiled. The first two are
/// what every call sets for itself (exact_environment.hpp); the others are the compiler's, and nothing mends them at
/// run time.
#pragma once

#include <string>
#include <vector>

#include "barycert/core/result.hpp"

namespace barycert {

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

}  // namespace barycert

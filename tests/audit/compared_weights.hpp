/// Weights alone, compared with the oracle's.
#pragma once

#include "audit/asking.hpp"

namespace barycert::audit {

/// Region and value are those that the kernel's functions make of the weights.
inline Comparison compare(const Kernel& kernel, const Case& c, const OracleAnswer& answer, int status,
                          std::span<const double> weights) {
    const ExactEnvironment environment;
    Statement s;
    s.status = status;
    std::ranges::copy(weights, s.weights.begin());
    complete(s, kernel, c);
    return compare(kernel, c, answer, s);
}

}  // namespace barycert::audit

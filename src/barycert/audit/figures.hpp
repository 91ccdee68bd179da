/// The figures of a kernel.
#pragma once

#include "barycert/audit.hpp"

namespace barycert::audit {

struct Figure {
    std::string name;                                      ///< as in reports and rules
    std::function<double(const KernelStatistics&)> value;  ///< -1 where there is no error to measure
};

/// wrong_cases, not_run, each class of finding; errors in ulps, residuals. Less is better of each.
const std::vector<Figure>& figures();
inline constexpr std::size_t first_finding = 2, first_error = first_finding + finding_count,
                             first_residual = first_error + 4;

}  // namespace barycert::audit

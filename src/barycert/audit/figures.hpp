/// The figures of a kernel that measure errors.
#pragma once

#include <array>

#include "barycert/audit.hpp"

namespace barycert::audit {

struct ErrorFigure {
    const char* name;                       ///< as in reports and rules
    double (*of)(const KernelStatistics&);  ///< -1 where there is no error to measure
};

inline constexpr std::array<ErrorFigure, 6> error_figures{
    {{"worst_weight_ulp", [](const KernelStatistics& s) { return s.weight_ulp.value; }},
     {"p999_weight_ulp", [](const KernelStatistics& s) { return s.p999_weight_ulp(); }},
     {"worst_value_ulp", [](const KernelStatistics& s) { return s.value_ulp.value; }},
     {"p999_value_ulp", [](const KernelStatistics& s) { return s.p999_value_ulp(); }},
     {"worst_partition_residual", [](const KernelStatistics& s) { return s.partition_residual.value; }},
     {"worst_reproduction_residual", [](const KernelStatistics& s) { return s.reproduction_residual.value; }}}};
inline constexpr std::size_t ulp_figures = 4;  ///< the first: not the residuals

}  // namespace barycert::audit

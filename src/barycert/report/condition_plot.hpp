/// The errors of kernels against the condition numbers of cells, as a picture.
#pragma once

#include <string>

#include "barycert/audit/runner.hpp"

namespace barycert::report {

/// An SVG of its own. Across: log2 of the condition number; upwards: the error in units of 2^-53, worst and median of a
/// bin, as bits. The line drawn as prediction is error = 2^-53 * kappa.
///
/// Which kernels: those on tetrahedra if any has cases to show, else those on triangles; of these those with an error
/// beyond half of 2^-53; if more than six, without variants (names with a second dot); if still more than six, six of
/// them, evenly from the least to the largest worst factor.
std::string condition_plot(const audit::Report& report);

}  // namespace barycert::report

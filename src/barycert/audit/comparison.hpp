/// One kernel's answer compared with the oracle's, and the cases of which the condition number predicts the error.
#pragma once

#include <span>

#include "barycert/audit.hpp"
#include "barycert/audit/asking.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/simplex.hpp"

namespace barycert::audit {

/// There is no measure in ulps where the exact number is zero (a wrong weight is then a false_nonzero), where either
/// is not finite, or where the simplex is degenerate. An exact weight beyond the largest double is measured from there.
/// `claimed` is always what the kernel's weights say; but a kernel whose weights are all correctly rounded has no
/// finding, even where they under- or overflow and so no longer tell the region.
Comparison compare(const Kernel& kernel, const Case& c, const OracleAnswer& answer, const Statement& statement);

/// The same of weights alone: region and value are those that the kernel's functions make of them.
Comparison compare(const Kernel& kernel, const Case& c, const OracleAnswer& answer, int status,
                   std::span<const double> weights);

/// kappa of the case's cell where there is something to predict: a triangle or tetrahedron, not degenerate, without
/// perspective, with the point in it or on its boundary, and no product of differences far out in the range of double.
/// NaN elsewhere. `region` is the exact one.
double predicting_condition(const Case& c, Region region);

}  // namespace barycert::audit

// Peers of bench_exact: the same signs and values in plain double on SIMD lanes, without bounds and without fall-back,
// as lean as they come. Dispatched like the library, so that use_simd_target() chooses for both.
#pragma once

#include <cstddef>

#include "barycert/predicates.hpp"
#include "core/lanes.hpp"

namespace barycert::peers {

/// Sign bits of the four determinants and of their sum, in the code of WeightSigns; a determinant that is zero counts
/// as it comes. Requires: cases.count is a multiple of the lanes.
void plain_signs(const core::CaseBlock& cases, WeightSigns* out);

/// sum n_i f_i / sum n_i of the four determinants n_i; values[i][j] is that at vertex i of case j. Same precondition.
void plain_values(const core::CaseBlock& cases, const double* const* values, double* out);

}  // namespace barycert::peers

/// The steps of a walk, and where walks start.
#pragma once

#include <functional>

#include "barycert/audit/search/coordinates.hpp"
#include "barycert/audit/search/evaluation.hpp"
#include "barycert/base/random.hpp"

namespace barycert::audit {

/// A case with a pattern of exponents: one for all, one an axis, one a vertex or one a number, in a band of random
/// width; significands of full or of few bits; the point like the vertices, or between them. Admissible.
Case patterned_case(Simplex simplex, bool perspective, const ExponentRange& range, base::Random& random);

/// Changes a few numbers of the case: by ulps, or their significands, exponents, signs, or to those of others; the
/// point to one between vertices. `values`: nodal values, too. May leave a case that is not admissible.
void wander(Case& c, base::Random& random, bool values);

/// Asks for a case; nothing more may be asked once it returns null.
using Ask = std::function<const Evaluation*(const Case&)>;

/// Moves one coordinate to where a weight is zero, or, once in a while, where the determinant of the cell is, by
/// secants of exact weights; then by a few ulps. Without rounding one secant hits: determinants are linear in each
/// number. `at`: the evaluation of `c`. The cases on the way are asked; the last one is left in `c`, not asked.
void jump_to_zero(Case& c, const Evaluation& at, base::Random& random, const ExponentRange& range, const Ask& ask);

}  // namespace barycert::audit

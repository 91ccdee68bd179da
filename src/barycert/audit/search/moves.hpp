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

/// What is to become zero, and the number that is moved for it.
struct Zero {
    std::size_t weight = 0;  ///< this weight,
    bool of_cell = false;    ///< or the determinant of the cell over the numerator of this weight
    int coordinate = 0;
};

/// Moves the coordinate by secants of the exact weights. Without rounding one secant hits: determinants are linear in
/// each number. `at`: the evaluation of `c`; `first`: the step to begin with. Cases on the way are asked, and the last
/// one asked is left in `c`.
void to_zero(Case& c, const Evaluation& at, const Zero& zero, double first, const ExponentRange& range, const Ask& ask);

/// A step to begin with: small beside the number, or beside others of its axis if it is zero.
double first_step(const Case& c, int k);

/// to_zero() of a weight or, once in a while, of the cell, then some ulps further: the case left in `c` was not asked.
void jump_to_zero(Case& c, const Evaluation& at, base::Random& random, const ExponentRange& range, const Ask& ask);

}  // namespace barycert::audit

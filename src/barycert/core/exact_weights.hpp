/// Internal: the last tier. Weights as fractions of exact integers, without heap and without floating point.
///
/// Coordinates become integers by shifts alone: each axis by its own power of two for the simplices that fill their
/// space (a determinant is homogeneous in each axis, so the powers cancel in numerator / denominator), all axes by one
/// for those that are projected on (dot products add axes up). Trailing zero bits are left out, so that round numbers
/// and lattices stay one limb wide.
#pragma once

#include <span>

#include "barycert/core/integer.hpp"
#include "barycert/core/simplex.hpp"

namespace barycert {

class ExactWeights {
public:
    /// Layout of Case: vertex after vertex. Precondition: all coordinates finite.
    ExactWeights(Simplex simplex, const double* vertices, const double* point);

    bool degenerate() const { return denominator_.sign() == 0; }

    /// Sign of the signed volume or area, 0 if degenerate; +1 for a proper simplex that is projected on.
    int orientation() const { return denominator_.sign(); }

    /// Sign of weight i; 0 if degenerate.
    int sign(int i) const { return numerators_[i].sign() * denominator_.sign(); }

    /// Weight i correctly rounded. Precondition: not degenerate.
    double weight(int i) const;

    /// sum of weight i times value i, correctly rounded. Preconditions: one finite value a vertex, not degenerate.
    double interpolate(std::span<const double> values) const;

private:
    int count_;
    Integer numerators_[4];
    Integer denominator_;
};

/// Sign of det(b - a, c - a), positive if a, b, c turn counter-clockwise. Precondition: finite.
int exact_orient2d(const double* a, const double* b, const double* c);

/// Sign of det(b - a, c - a, d - a). Precondition: finite.
int exact_orient3d(const double* a, const double* b, const double* c, const double* d);

/// The dot product of `count` pairs (at most 5), correctly rounded. Precondition: finite.
double exact_dot(const double* x, const double* y, int count);

}  // namespace barycert

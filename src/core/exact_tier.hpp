/// The last tier, in exact integers: without heap and without floating point.
///
/// Coordinates become integers by shifts alone: each axis in its own unit for the simplices that fill their space (a
/// determinant is homogeneous in each axis, so the units cancel in numerator / denominator), all axes in one for those
/// that are projected on (dot products add axes up). Where coordinates need at most 61 bits in their unit, as those of
/// a mesh mostly do, one limb holds each, and numerators have two to four; then two limbs, for 125 bits; then as many
/// as it takes.
///
/// Every function requires finite numbers. Signs of polynomials in NaN or infinity are not specified, but these fit the
/// integers too (scaled_double.hpp).
#pragma once

#include <limits>
#include <span>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "core/integer.hpp"
#include "core/lanes.hpp"

namespace barycert::core {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Weights as fractions of integers.
class ExactWeights {
public:
    /// Layout of Case: vertex after vertex.
    ExactWeights(Simplex simplex, const double* vertices, const double* point);

    bool degenerate() const { return orientation() == 0; }

    /// Sign of the signed volume or area, 0 if degenerate; +1 for a proper simplex that is projected on.
    int orientation() const { return sign_of(denominator); }

    /// Sign of weight i; 0 if degenerate.
    int sign(int i) const { return sign_of(i) * orientation(); }

    /// Weight i correctly rounded. Requires: not degenerate.
    double weight(int i) const;

    /// sum of weight i times value i, correctly rounded. Requires: one value a vertex, not degenerate.
    double interpolate(std::span<const double> values) const;

    /// Sign of that sum, not rounded, less t. The same preconditions.
    int compare(std::span<const double> values, double t) const;

    /// Sets values that are not finite to zero: those at vertices and, behind them, if there are more values than
    /// vertices, at the middles of edges, of a quadratic. Returns whether none of them has a part in the sum: its
    /// weight, or shape function, is exactly zero. In a degenerate simplex each has one.
    bool leave_out_not_finite(std::span<double> values) const;

private:
    static constexpr int denominator = 4;  ///< its place behind the numerators
    template <Simplex s>
    void solve(const double* vertices, const double* point);
    int sign_of(int i) const { return numbers_[i].sign(); }
    bool has_part(int node, bool quadratic) const;

    int count_;
    Integer numbers_[5];
};

/// The predicates of predicates.hpp.
Sign exact_orient2d(const double* a, const double* b, const double* c);
Sign exact_orient3d(const double* a, const double* b, const double* c, const double* d);
Sign exact_det3d(const double* p, const double* q, const double* r, const double* s, const double* t, const double* u);
Sign exact_incircle(const double* a, const double* b, const double* c, const double* d);
Sign exact_insphere(const double* a, const double* b, const double* c, const double* d, const double* e);

/// The dot product of `count` pairs (at most 5), correctly rounded.
double exact_dot(const double* x, const double* y, int count);

/// The gradient of the field with `values` (one a vertex) in the cell at `vertices`, each component correctly rounded,
/// to out[0 ... d - 1]. Returns false, and sets NaN, if the cell is degenerate. Requires: triangle or tetrahedron.
bool exact_gradient(Simplex simplex, const double* vertices, const double* values, double* out);

/// Values of the fields whose component c at node i (mid-edge nodes behind corners) is values[nodes * c + i], correctly
/// rounded, to out[0 ... components - 1]. Returns false, and leaves `out` as it was, if the cell is degenerate.
/// Requires: triangle or tetrahedron.
bool exact_quadratic(Simplex simplex, const double* vertices, const double* point, const double* values, int components,
                     double* out);

/// Perspective-correct weights, depth, or `components` values, of what perspective.hpp requires of coordinates and
/// depths, in its layouts: each correctly rounded; a value NaN where one is not finite at a vertex whose weight is not
/// exactly zero. Returns false, and leaves `out` as it was, if there are no weights. `values`: of
/// PerspectiveAnswer::values alone.
bool exact_perspective(PerspectiveAnswer what, const double* vertices, const double* point, const double* values,
                       int components, double* out);

}  // namespace barycert::core

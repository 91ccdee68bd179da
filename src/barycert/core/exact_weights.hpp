/// Internal: the last tier. Weights as fractions of exact integers, without heap and without floating point.
///
/// Coordinates become integers by shifts alone: each axis in its own unit for the simplices that fill their space (a
/// determinant is homogeneous in each axis, so the units cancel in numerator / denominator), all axes in one for those
/// that are projected on (dot products add axes up). Where coordinates need at most 61 bits in their unit, as those of
/// a mesh mostly do, one limb holds each, and numerators have two to four; then two limbs, for 125 bits; then as many
/// as it takes.
#pragma once

#include <cstdint>
#include <span>

#include "barycert/core/integer.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

class ExactWeights {
public:
    /// Layout of Case: vertex after vertex. Precondition: all coordinates finite.
    ExactWeights(Simplex simplex, const double* vertices, const double* point);

    bool degenerate() const { return orientation() == 0; }

    /// Sign of the signed volume or area, 0 if degenerate; +1 for a proper simplex that is projected on.
    int orientation() const { return sign_of(denominator); }

    /// Sign of weight i; 0 if degenerate.
    int sign(int i) const { return sign_of(i) * orientation(); }

    /// Weight i correctly rounded. Precondition: not degenerate.
    double weight(int i) const;

    /// sum of weight i times value i, correctly rounded. Preconditions: one finite value a vertex, not degenerate.
    double interpolate(std::span<const double> values) const;

private:
    static constexpr int denominator = 4;   ///< its place behind the numerators
    static constexpr int narrow_limbs = 8;  ///< of the widest product of four numbers of two limbs

    template <Simplex s>
    void solve(const double* vertices, const double* point);
    template <class T>
    void store(int i, const T& number);
    int sign_of(int i) const;
    Magnitude magnitude(int i, std::uint64_t* buffer) const;

    int count_;
    int limbs_ = 0;  ///< of each number in narrow_, two's complement; 0 if wide_ is used
    std::uint64_t narrow_[5][narrow_limbs];
    Integer wide_[5];
};

/// Sign of det(b - a, c - a), positive if a, b, c turn counter-clockwise. Precondition: finite.
int exact_orient2d(const double* a, const double* b, const double* c);

/// Sign of det(b - a, c - a, d - a). Precondition: finite.
int exact_orient3d(const double* a, const double* b, const double* c, const double* d);

/// Sign of det(q - p, s - r, u - t). Precondition: finite.
int exact_det3d(const double* p, const double* q, const double* r, const double* s, const double* t, const double* u);

/// The signs of predicates.hpp. Precondition: finite.
int exact_incircle(const double* a, const double* b, const double* c, const double* d);
int exact_insphere(const double* a, const double* b, const double* c, const double* d, const double* e);

/// The dot product of `count` pairs (at most 5), correctly rounded. Precondition: finite.
double exact_dot(const double* x, const double* y, int count);

}  // namespace barycert

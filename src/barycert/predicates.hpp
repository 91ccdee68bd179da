/// Exact predicates: orientations, determinants of differences, and the signs of barycentric weights.
///
/// Enters: coordinates as doubles, in any unit. Leaves: signs of the exact polynomials in these very doubles.
///
/// What holds (each law is a test of that name in tests/core):
///   S1  A sign is exact for every finite input, subnormals and 1e308 included, in every rounding mode, with
///       flush-to-zero or without: floating point answers only what its error bound proves, integers answer the rest.
///   S2  An even permutation of the arguments keeps an orientation, an odd one flips it; the same permutation of the
///       vertices permutes the signs of the weights. Multiplying an axis by a power of two (without leaving the
///       doubles) changes no sign in a triangle or tetrahedron; multiplying all axes changes none in any simplex.
///   D1  Answers depend on the input bits alone, not on threads, SIMD target, compiler or optimisation. So do the
///       counts of Tiers, for which alone weight_signs sets the environment (environment.hpp).
///   E   NaN or infinity among the coordinates gives an Error, never a sign.
///
/// What does not hold: nothing is said about numbers that were rounded before they came here; a point computed to lie
/// on a face most likely does not. Signs at a shared face are those of the exact geometry, zero for both cells; whoever
/// wants one owner needs a rule for ties. Batches trust their indices.
///
/// Conventions, CGAL::orientation's:
///   orient2d(a, b, c) > 0 if a, b, c turn counter-clockwise;
///   orient3d(a, b, c, d) > 0 if a, b, c turn counter-clockwise seen from d (the opposite of Shewchuk's orient3d):
///
///         d               x to the right, y away from the reader, z up:
///        /|\ .            a = (0,0,0), b = (1,0,0), c = (0,1,0), d = (0,0,1)
///       / | c             is positive
///      / .|. \ .
///     a-------b
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "barycert/batch.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/tiers.hpp"

// The exact signs of the barycentric weights of one point, in two bytes.

namespace barycert {

enum class Sign : std::int8_t { negative = -1, zero = 0, positive = 1 };

class WeightSigns {
public:
    /// Bit i: weight i is negative. Bit 4+i: weight i is zero. Bit 8: the simplex is oriented negatively. Bit 9: it is
    /// degenerate, and all other bits are clear.
    using Bits = std::uint16_t;

    constexpr WeightSigns() = default;
    constexpr explicit WeightSigns(Bits bits) : bits_(bits) {}
    static constexpr WeightSigns degenerate_simplex() { return WeightSigns(Bits{1} << 9); }

    constexpr Bits bits() const { return bits_; }
    constexpr bool degenerate() const { return (bits_ >> 9) != 0; }

    /// Of the simplex: its signed area or volume. Segment and triangle3d have none: positive unless degenerate.
    constexpr Sign orientation() const {
        return degenerate() ? Sign::zero : (bits_ >> 8 & 1) != 0 ? Sign::negative : Sign::positive;
    }

    /// Of weight i, 0 <= i < vertex_count(simplex); zero if degenerate.
    constexpr Sign sign(int i) const {
        if (degenerate() || (bits_ >> (4 + i) & 1) != 0) return Sign::zero;
        return (bits_ >> i & 1) != 0 ? Sign::negative : Sign::positive;
    }

    constexpr Region region() const {
        if (degenerate()) return Region::degenerate;
        if ((bits_ & 0xf) != 0) return Region::outside;
        return (bits_ & 0xf0) != 0 ? Region::boundary : Region::interior;
    }

    /// The open face that holds the point (or, for simplices that are projected on, its projection).
    constexpr Feature feature(Simplex s) const {
        const Region r = region();
        if (r == Region::degenerate) return Feature::degenerate;
        if (r == Region::outside) return Feature::outside;
        if (r == Region::interior) return Feature::interior;
        const int support = vertex_count(s) - std::popcount(static_cast<unsigned>(bits_ & 0xf0));
        return support == 1 ? Feature::vertex : support == 2 ? Feature::edge : Feature::face;
    }

    /// The point lies in the closed simplex.
    constexpr bool contains() const { return (bits_ & 0x20f) == 0; }

    friend constexpr bool operator==(WeightSigns, WeightSigns) = default;

private:
    Bits bits_ = 0;
};

// Exact predicates: orientations, determinants of differences, and the signs of barycentric weights.
//
// Enters: coordinates as doubles, in any unit. Leaves: signs of the exact polynomials in these very doubles.
//
// What holds (each law is a test of that name in tests/core):
//   S1  A sign is exact for every finite input, subnormals and 1e308 included, in every rounding mode, with
//       flush-to-zero or without: floating point answers only what its error bound proves, integers answer the rest.
//   S2  An even permutation of the arguments keeps an orientation, an odd one flips it; the same permutation of the
//       vertices permutes the signs of the weights. Multiplying an axis by a power of two (without leaving the
//       doubles) changes no sign in a triangle or tetrahedron; multiplying all axes changes none in any simplex.
//   D1  Answers depend on the input bits alone, not on threads, SIMD target, compiler or optimisation. So do the
//       counts of Tiers, for which alone weight_signs sets the environment (environment.hpp).
//   E   NaN or infinity among the coordinates gives an Error, never a sign.
//
// What does not hold: nothing is said about numbers that were rounded before they came here; a point computed to lie
// on a face most likely does not. Signs at a shared face are those of the exact geometry, zero for both cells; whoever
// wants one owner needs a rule for ties. Batches trust their indices.
//
// Conventions, CGAL::orientation's:
//   orient2d(a, b, c) > 0 if a, b, c turn counter-clockwise;
//   orient3d(a, b, c, d) > 0 if a, b, c turn counter-clockwise seen from d (the opposite of Shewchuk's orient3d):
//
//         d               x to the right, y away from the reader, z up:
//        /|\ .            a = (0,0,0), b = (1,0,0), c = (0,1,0), d = (0,0,1)
//       / | c             is positive
//      / .|. \ .
//     a-------b

/// Sign of det(b - a, c - a) of points with 2 coordinates. Error: a coordinate is not finite.
Result<Sign> orient2d(const double* a, const double* b, const double* c);

/// Sign of det(b - a, c - a, d - a) of points with 3 coordinates. Error: a coordinate is not finite.
Result<Sign> orient3d(const double* a, const double* b, const double* c, const double* d);

/// Sign of det(q - p, s - r, u - t) of points with 3 coordinates: of three differences of any points, such as two edges
/// of two simplices and what joins them. orient3d(a, b, c, d) is det3d(a, b, a, c, a, d). Swapping the ends of a
/// difference, or two differences, flips it. Error: a coordinate is not finite.
Result<Sign> det3d(const double* p, const double* q, const double* r, const double* s, const double* t,
                   const double* u);

/// Signs of the weights of `point` in the simplex at `vertices` (vertex after vertex, see Case). A degenerate simplex
/// is told by WeightSigns::degenerate(). `tiers`, if given, counts this case. Error: a coordinate is not finite.
Result<WeightSigns> weight_signs(Simplex simplex, const double* vertices, const double* point, Tiers* tiers = nullptr);

/// The same for many cases, on SIMD lanes. Errors: a coordinate is not finite (it names the case); out.size() is not
/// the number of cases, or the sizes of the queries do not fit. `out` is then not to be used. Precondition: indices in
/// range.
Status weight_signs(const CaseArrays& cases, std::span<WeightSigns> out, Tiers* tiers = nullptr);
Status weight_signs(const MeshQueries& queries, std::span<WeightSigns> out, Tiers* tiers = nullptr);

// Exact predicates: a point against the circle through three others, or the sphere through four.
//
// Enters: coordinates as doubles, all axes in one unit. Leaves: signs of the exact polynomials in these very doubles.
//
// What holds, under the names of predicates.hpp (S1, S2 and E are tests of that name in tests/core/insphere_test.cpp):
//   S1  A sign is exact for every finite input, subnormals and 1e308 included, in every rounding mode, with
//       flush-to-zero or without: floating point answers only what its error bound proves, integers answer the rest.
//   S2  An even permutation of all arguments, the last one included, keeps a sign, an odd one flips it. Multiplying
//       all axes by one power of two (without leaving the doubles) changes none; one axis alone does.
//   D1  Answers depend on the input bits alone.
//   E   NaN or infinity among the coordinates gives an Error, never a sign.
//
// Conventions, those of CGAL's side_of_oriented_circle and side_of_oriented_sphere, with predicates.hpp's orient2d
// and orient3d:
//   simplex           last point inside    on the circle or sphere    outside
//   positive          positive             zero                       negative
//   negative          negative             zero                       positive
//
//          c           incircle(a, b, c, p) > 0, for a, b, c turn counter-clockwise and p is inside
//      .   |\  .
//     .    | \  .      The answer without orientation, as Delaunay tests want it, is a product of signs:
//     .  p |  \ .          incircle(a, b, c, p) * orient2d(a, b, c)            positive inside, negative outside
//      .   a---b           insphere(a, b, c, d, p) * orient3d(a, b, c, d)
//        . _ .
//
// What does not hold: a flat simplex has no circle or sphere. The product is zero for it, wherever the point; the sign
// alone is that of the determinant. Three distinct points on a line: incircle has one sign on one side of the line,
// the other sign on the other, zero on it. Likewise insphere and the plane of a, b, c, d; but it is zero everywhere if
// these lie on one circle or line. Both are zero everywhere if two vertices coincide.
// Integers as wide as 1e-300 beside 1e300 asks for take tens of microseconds, and a hundred KiB of stack (core.hpp).

/// Sign of det(q - d, |q - d|^2) over rows q = a, b, c of points with 2 coordinates: positive if d lies inside the
/// circle through a, b, c and these turn counter-clockwise. Error: a coordinate is not finite.
Result<Sign> incircle(const double* a, const double* b, const double* c, const double* d);

/// Sign of -det(q - e, |q - e|^2) over rows q = a, b, c, d of points with 3 coordinates: positive if e lies inside the
/// sphere through a, b, c, d and these are positive under orient3d. Error: a coordinate is not finite.
Result<Sign> insphere(const double* a, const double* b, const double* c, const double* d, const double* e);

}  // namespace barycert

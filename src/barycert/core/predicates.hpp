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
///       counts of Tiers, for which alone weight_signs sets the environment (exact_environment.hpp).
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

#include <span>

#include "barycert/core/batch.hpp"
#include "barycert/core/result.hpp"
#include "barycert/core/simplex.hpp"
#include "barycert/core/tiers.hpp"
#include "barycert/core/weight_signs.hpp"

namespace barycert {

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

}  // namespace barycert

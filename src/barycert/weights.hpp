/// Barycentric weights and interpolated values, correctly rounded.
///
/// Input: coordinates and nodal values as doubles (values also as floats). Output: doubles.
///
/// Laws (each is a test of that name in tests/core):
///   W1  A weight has the sign of the exact one. It is zero only if the exact one is zero, and then +0, or if that
///       rounds to zero (at most half of the min subnormal), and then a zero with its sign. weight_signs tells the two
///       apart.
///   W2  Each weight is the exact one rounded to nearest, ties to even, subnormal results and infinity included.
///   V1  Each value is the exact sum of weight times nodal value, rounded once in the same way, for every component. An
///       exact zero is +0, even if all nodal values are -0; what underflows to zero keeps its sign.
///   V2  At a point on a shared face, edge or vertex the value has the same bits from every cell that holds it, if the
///       cells are not degenerate, whatever values the nodes beside it have.
///   D1  Results depend on the input bits alone, not on threads, SIMD target, compiler or optimisation, nor (D2) on the
///       caller's floating-point environment.
///
/// A degenerate simplex has no weights: they and its values are NaN, and TierCounts::degenerate counts the case. A
/// nodal value that is NaN or infinite makes its component NaN, and TierCounts::not_finite counts the case, unless its
/// exact weight is zero: then it takes no part. NaN or infinity among the coordinates is an Error.
///
/// Not promised: rounded weights need not sum to 1, and the point they give back (point_from_weights) need not be the
/// one they came from; their rounded combination with nodal values is not the value. On simplices that are projected on
/// (segment, triangle3d) V2 holds for points on the shared edge or vertex itself, not for those projected to it.
///
/// How: double plus a correction with a proven bound, accepted where both ends of the bound round alike; integers
/// elsewhere. See refinement-inl.hpp and exact_tier.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "barycert/batch.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/tiers.hpp"

namespace barycert {

enum class Rounding : std::uint8_t {
    correct,  ///< as above
    plain,    ///< evaluated in double: only D2, the checks of sizes and what is said of NaN hold; no counts
};

struct Weights {
    std::array<double, 4> weights{};  ///< vertex_count(simplex) of them; NaN if degenerate
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// Returns the weights of `point` in the simplex at `vertices` (vertex after vertex, see Case), or an Error if a
/// coordinate is not finite.
Result<Weights> barycentric_weights(Simplex simplex, const double* vertices, const double* point);

struct Value {
    double value = 0;  ///< NaN if degenerate or a nodal value that takes part is not finite
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// Returns the value at `point` of the linear field with `values[i]` at vertex i, or an Error if a coordinate is not
/// finite.
Result<Value> interpolate(Simplex simplex, const double* vertices, const double* point, const double* values);

/// Returns the sign of the exact, not rounded, value less `threshold`: whether the field is above, at or below it. So a
/// value can be rounded once to any other type. Returns an Error if a number that takes part is not finite or the
/// simplex is degenerate.
Result<Sign> compare_value(Simplex simplex, const double* vertices, const double* point, const double* values,
                           double threshold);

/// Weights of many cases: out[n * j + i] is weight i of case j, n = vertex_count(simplex). Returns an Error if a
/// coordinate is not finite, if out.size() is not n times the number of cases, or if the sizes of the queries do not
/// fit each other; `out` is then not to be used. Requires indices in range, and `out` not to overlap any input.
Status barycentric_weights(const CaseArrays& cases, std::span<double> out, TierCounts* tiers = nullptr);
Status barycentric_weights(const MeshQueries& queries, std::span<double> out, TierCounts* tiers = nullptr);

/// Values of many cases: out[components * j + c] is component c of case j. `tiers` counts a case for the highest tier
/// that one of its components needed. Returns an Error if a coordinate is not finite (not with Rounding::plain), if
/// out.size() is not `components` times the number of cases, if the sizes of the queries do not fit each other, or if
/// components < 1; `out` is then not to be used. Requires indices in range, a value for each component of each node,
/// and `out` not to overlap any input.
Status interpolate(const CaseArrays& cases, const ValueArrays<double>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const CaseArrays& cases, const ValueArrays<float>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const MeshQueries& queries, const NodalValues<double>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const MeshQueries& queries, const NodalValues<float>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);

}  // namespace barycert

/// Barycentric weights and interpolated values, correctly rounded.
///
/// Enters: coordinates and nodal values as doubles (values also as floats). Leaves: doubles.
///
/// What holds (each law is a test of that name in tests/core):
///   W1  A weight has the sign of the exact one. It is zero only if that is zero, and then +0, or rounds to zero for
///       being at most half of the smallest subnormal, and then a zero with its sign. weight_signs tells the two apart.
///   W2  Each weight is the exact one rounded to nearest, ties to even, subnormal results and infinity included.
///   V1  Each value is the exact sum of weight times nodal value, rounded once in the same way, for every component. An
///       exact zero is +0, even of nodal values that are all -0; what underflows to zero keeps its sign.
///   V2  At a point on a shared face, edge or vertex the value has the same bits from every cell that holds it, if the
///       cells are proper and their nodal values finite.
///   D1  Results depend on the input bits alone, not on threads, SIMD target, compiler or optimisation, nor (D2) on the
///       caller's floating-point environment. An exact zero is +0.
///   A degenerate simplex is told, not weighed: its weights and values are NaN, and the case is counted.
///   A nodal value that is NaN or infinite makes its component NaN, and the case is counted.
///   NaN or infinity among the coordinates gives an Error.
///
/// What does not hold: rounded weights need not sum to 1, and the point they give back (point_from_weights) need not be
/// the one they came from; their rounded combination with nodal values is not the value. On simplices that are
/// projected on (segment, triangle3d) V2 speaks of points on the shared edge or vertex itself, not of those projected
/// to it. Output must not overlap any input.
///
/// How: double + correction with a proven bound, accepted where both ends of the bound round alike; integers elsewhere.
/// See refinement-inl.hpp and exact_weights.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "barycert/batch.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/tiers.hpp"

namespace barycert {

enum class Rounding : std::uint8_t {
    correct,  ///< as above
    plain,    ///< in double, with no promise but D2: nothing but sizes is checked, nothing is counted
};

struct Weights {
    std::array<double, 4> weights{};  ///< vertex_count(simplex) of them; NaN if degenerate
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// The weights of `point` in the simplex at `vertices` (vertex after vertex, see Case).
Result<Weights> barycentric_weights(Simplex simplex, const double* vertices, const double* point);

struct Value {
    double value = 0;  ///< NaN if degenerate
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// The value at `point` of the linear field with `values[i]` at vertex i.
Result<Value> interpolate(Simplex simplex, const double* vertices, const double* point, const double* values);

/// Weights of many cases: out[n * j + i] is weight i of case j, n = vertex_count. Error besides: out.size() is not n
/// times the number of cases. On error `out` is not to be used. Precondition: indices in range.
Status barycentric_weights(const CaseArrays& cases, std::span<double> out, TierCounts* tiers = nullptr);
Status barycentric_weights(const MeshQueries& queries, std::span<double> out, TierCounts* tiers = nullptr);

/// Values of many cases: out[components * j + c] is component c of case j. A case counts for the highest tier that one
/// of its components needed. Errors besides: out.size() is not `components` times the number of cases, components < 1.
/// On error `out` is not to be used. Preconditions: indices in range, a value for each component of each node.
Status interpolate(const CaseArrays& cases, const ValueArrays<double>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const CaseArrays& cases, const ValueArrays<float>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const MeshQueries& queries, const NodalValues<double>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const MeshQueries& queries, const NodalValues<float>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);

}  // namespace barycert

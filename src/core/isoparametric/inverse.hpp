/// Points of isoparametric cells: what x of the reference cell is taken there, enclosed, and values rounded once.
///
/// A cell takes x to X(x) = sum of N_i(x) p_i. Newton's method in double finds x about; then, with Y about the inverse
/// of X' there, Krawczyk's operator proves it: if all Jacobians over the box B of radius R around c satisfy
/// |1 - Y X'| <= m < 1/2 by the row sums, and |Y (X(c) - p)| <= R / 2, there is exactly one x in B with X(x) = p, and
/// it differs from c - Y (X(c) - p) by at most m R. Repeated in numbers of more and more bits until the value rounds to
/// one double. Where cells are affine, or x turns out to be a number of few bits or a
/// fraction of small numbers, all is rational and exact; so is the
/// value of an affine function of the places of the nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "barycert/simplex.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// Where nodes are, `dimension` coordinates each; one with another place is amid both, exactly.
struct Places {
    std::array<const double*, max_nodes> at{}, other{};
};

/// How a value was found; `undecided`: 1,200 bits did not tell how it rounds.
enum class Certainty : std::uint8_t { proved, undecided, not_found };

struct Evaluated {
    Certainty certainty = Certainty::not_found;
    Tier tier = Tier::double_double;
    double off = 0;  ///< undecided: the values are at most so far from those that are rounded correctly
};

/// sum of N_i(x) values[components * i + c] to out[c], rounded once, where x is taken to `point`. `active`: a bit for
/// each node whose function is not zero there; others are left out. A value that is not finite makes its component NaN.
/// Requires: the point is in the cell, on which the map is injective; coordinates are finite.
Evaluated evaluate(const Reference& reference, const Places& places, const double* point, std::uint64_t active,
                   const double* values, std::size_t components, double* out);

/// The same where the inverse of the map is continued beyond the cell: along the straight way to `point` from what
/// `from`, a place of the reference cell, is taken to, in up to some hundred steps. Nothing is found where it is not
/// proved that it can be, as where the Jacobian vanishes on the way.
Evaluated evaluate_beyond(const Reference& reference, const Places& places, const double* point,
                          const std::array<double, 3>& from, const double* values, std::size_t components, double* out);

/// The sign of the Jacobian all over the cell, exactly.
enum class JacobianSign : std::int8_t {
    negative = -1,
    unknown = 0,  ///< many bisections did not tell (bernstein.hpp): it touches zero, or nearly so
    positive = 1,
    changes = 2,  ///< it is zero, or has both signs, at corners of the cell or of a part that was bisected
};
/// A cell is bisected as often at most: three halvings of each edge of a tetrahedron.
inline constexpr int max_bisections = 18;
/// With no bisection, `positive` and `negative` are told where coefficients alone prove them.
JacobianSign jacobian_sign(const Reference& reference, const Places& places, int bisections = max_bisections);
/// The same, for simplices alone.
JacobianSign simplex_jacobian_sign(const Reference& reference, const Places& places, int bisections = max_bisections);

/// 1 or -1 where the Jacobian is proved to have that sign; else 0.
inline int proved_orientation(const Reference& reference, const Places& places) {
    const auto sign = static_cast<int>(jacobian_sign(reference, places));
    return sign == 2 ? 0 : sign;
}

/// Where a point is in a simplex of order 2 to 4.
struct InSimplex {
    bool inside = false;
    unsigned zeros = 0;   ///< a bit for each barycentric coordinate that is zero there
    bool proved = false;  ///< else it may be otherwise: a zero is a number below 2^-240, or nothing was found
};
/// `beyond`: the sign of each corner's weight in the straight simplex. `flat`: a bit for each facet, opposite to a
/// corner, that is straight: these signs decide where the coordinate is about zero. Requires: as of
/// evaluate(), but the point may be anywhere.
InSimplex locate_in_simplex(const Reference& reference, const Places& places, const double* point, unsigned flat,
                            const std::array<int, 4>& beyond);

/// A box of all points of the cell, a simplex of order 2 to 4: low, then high coordinates.
std::array<double, 6> hull_box(const Reference& reference, const Places& places);

}  // namespace barycert::core::isoparametric

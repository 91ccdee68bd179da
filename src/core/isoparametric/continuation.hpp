/// The inverse of a cell's map, continued beyond the cell along a straight way.
///
/// The rule. Let x0 be a place of the reference cell, q = X(x0) and p a point. The places x(s), 0 <= s <= 1, with
/// x(0) = x0 and X(x(s)) = q + s (p - q) are followed from s = 0 as long as the Jacobian does not vanish on them; as it
/// does not, they are the only ones that depend on s continuously. The continuation to p is x(1). If the Jacobian
/// vanishes before, there is none. That is the inverse along this way: other places may be taken to p too, but they are
/// not reached so.
///
/// The proof. Around a place c, with Y about the inverse of X' there, G(x) = Y (X(x) - q - s (p - q)) has derivatives
/// that differ from 1 by no more than m(R), by row sums, within R of c: m is a polynomial of the Taylor coefficients of
/// X at c. |x| is the largest coordinate, each of them in a unit of its own, so that what is within R is a box as long
/// as the way is in each. Let M(R) be the integral of m from 0 to R, and R such that m(R) < 1. Then
///   1. G is one to one within R, for |G(x) - G(y) - (x - y)| <= m(R) |x - y|;
///   2. on the border |G(x) - G(c)| >= R - M(R). So of a way of G along which |G - G(c)| stays below that, from what a
///      place within R is taken to, the places stay within R: they do not reach its border, and G' has an inverse;
///   3. in particular, if |G(c)| <= e, 2 e < R and M(2 e) < e, a place within 2 e of c is taken to 0.
/// A step starts where x(s) is within 2 e of c by 3. As s grows by t, 0 becomes t Y (p - q) in these terms: by 2 the
/// places are followed while e + t |Y (p - q)| < R - M(R). That is as far as Newton's method is known to find them
/// (Kantorovich); it finds c' for the next step, with its own e'. If all within 2 e' of c' is within R of c, the place
/// there that is taken to the same point is x(s + t), by 1. All is computed in balls (ball.hpp), on the way that is
/// straight in exact numbers.
#pragma once

#include <optional>

#include "core/isoparametric/newton.hpp"
#include "core/isoparametric/places.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// The continued place is within `radius` of `about`, by coordinates, and no other place there is taken to the point.
struct ContinuedPlace {
    Vector<double> about{}, radius{};
};

/// From `from` to the point that `beside` is beside. Nothing where the way is not proved to its end: the Jacobian
/// vanishes on it, or so nearly that steps get too small; or it takes too many of them.
std::optional<ContinuedPlace> continue_inverse(const Reference& of, const Inverse& beside, const Vector<double>& from);

}  // namespace barycert::core::isoparametric

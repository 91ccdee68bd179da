/// Gradients of the functions that isoparametric cells interpolate, rounded once.
///
/// The cell takes x of the reference cell to X(x), and there the function is u(x). With J = X' and f = u', both by the
/// coordinates of the reference cell, the gradient g solves J^T g = f, by Cramer's rule: g_k det J is the sum over j of
/// f_j times the cofactor of J_kj. x is enclosed as for values (inverse.hpp), so that all of this is done with balls,
/// in more and more bits until g rounds to one double. All is rational where x is; and where the values at nodes are
/// those of an affine function, whose gradient is then that of the cell: it may be 0, which no ball rounds to.
#pragma once

#include <array>
#include <cstddef>

#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// The derivative by coordinate k of the function with the values[components * i + c] at nodes i, where x is taken to
/// `point`, to out[dimension * c + k]. A value that is not finite makes those of its component NaN. Nothing is found
/// where the Jacobian vanishes, as at the apex of a pyramid. Requires: as of evaluate().
Evaluated evaluate_gradients(const Reference& reference, const Places& places, const double* point,
                             const double* values, std::size_t components, double* out);

/// The same as evaluate_beyond() finds x.
Evaluated evaluate_gradients_beyond(const Reference& reference, const Places& places, const double* point,
                                    const std::array<double, 3>& from, const double* values, std::size_t components,
                                    double* out);

/// The same at x, a place of the reference cell.
Evaluated gradients_at_place(const Reference& reference, const Places& places, const std::array<double, 3>& x,
                             const double* values, std::size_t components, double* out);

}  // namespace barycert::core::isoparametric

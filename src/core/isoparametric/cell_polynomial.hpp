/// Maps of cells as polynomials, and their Taylor coefficients at any place, in the cell or beyond it.
///
/// Sums of shape functions over a box say little of how the Jacobian changes there: each node's share is bounded on its
/// own, though all of a cell that is nearly affine cancel. Here they cancel first: X(c + h) is a sum of h^b times
/// vectors that are sums over all nodes, in balls, and those of degree 2 and more are all that changes the Jacobian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/newton.hpp"
#include "core/isoparametric/places.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// Shape functions of a reference cell in monomials r^a s^b t^c.
struct CellBasis {
    using Exponents = std::array<std::uint8_t, 3>;
    std::vector<Exponents> terms;              ///< with each one all that divide it; the first is 1
    std::vector<std::vector<double>> factors;  ///< [term][node], whole numbers: of functions times Reference::scale
    /// The coefficient of term `to` at a place x is the sum of its parts: factor x^powers times that of term `of` at 0.
    struct TermShift {
        std::size_t of = 0, to = 0;
        Exponents powers{};
        int factor = 1;
    };
    std::vector<TermShift> parts;

    std::size_t degree(std::size_t term) const {
        return std::size_t{0} + terms[term][0] + terms[term][1] + terms[term][2];
    }
};
const CellBasis& cell_basis(const Reference& of);

/// [term][axis]
template <class N>
using CellCoefficients = std::array<Vector<N>, max_nodes>;

/// X(x) less a point, times Reference::scale, in the units of an Inverse beside that point.
class CellPolynomial {
public:
    CellPolynomial(const Reference& of, const Inverse& beside);

    const CellBasis& basis() const { return *basis_; }
    /// Taylor coefficients at x; about, or enclosed.
    CellCoefficients<double> about(const Vector<double>& x) const { return taylor(plain_, x); }
    CellCoefficients<Ball<double>> enclosed(const Vector<double>& x) const { return taylor(balls_, x); }

private:
    template <class N>
    CellCoefficients<N> taylor(const CellCoefficients<N>& at_zero, const Vector<double>& x) const;

    const CellBasis* basis_;
    CellCoefficients<Ball<double>> balls_;  ///< at 0
    CellCoefficients<double> plain_{};
};

}  // namespace barycert::core::isoparametric

#include "core/isoparametric/cell_polynomial.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/newton.hpp"
#include "core/isoparametric/places.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"

namespace barycert::core::isoparametric {
namespace {

constexpr std::size_t powers_each = 5;  ///< 0 to 4

/// A polynomial in r, s, t of whole numbers, as shape_functions() asks for a number.
struct WholePolynomial {
    std::array<double, powers_each * powers_each * powers_each> of{};

    WholePolynomial() = default;
    explicit WholePolynomial(int x) { of[0] = x; }
    static WholePolynomial variable(std::size_t k) {
        WholePolynomial p;
        p.of[k == 0 ? powers_each * powers_each : k == 1 ? powers_each : 1] = 1;
        return p;
    }
    friend WholePolynomial operator-(const WholePolynomial& x) { return WholePolynomial() - x; }
    friend WholePolynomial operator-(const WholePolynomial& x, const WholePolynomial& y) {
        WholePolynomial out = x;
        for (std::size_t i = 0; i < out.of.size(); ++i) out.of[i] -= y.of[i];
        return out;
    }
    friend WholePolynomial operator+(const WholePolynomial& x, const WholePolynomial& y) {
        WholePolynomial out = x;
        for (std::size_t i = 0; i < out.of.size(); ++i) out.of[i] += y.of[i];
        return out;
    }
    /// No exponent of the product exceeds 4.
    friend WholePolynomial operator*(const WholePolynomial& x, const WholePolynomial& y) {
        WholePolynomial out;
        for (std::size_t i = 0; i < out.of.size(); ++i) {
            for (std::size_t j = 0; x.of[i] != 0 && i + j < out.of.size(); ++j) out.of[i + j] += x.of[i] * y.of[j];
        }
        return out;
    }
};

int binomial(int n, int k) {
    int c = 1;
    for (int i = 0; i < k; ++i) c = c * (n - i) / (i + 1);
    return c;
}

/// All ways to take some of each variable from a term.
void add_parts(CellBasis& basis, std::size_t of) {
    const CellBasis::Exponents& whole = basis.terms[of];
    for (std::size_t to = 0; to < basis.terms.size(); ++to) {
        CellBasis::TermShift part{of, to, {}, 1};
        bool divides = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const int all = whole[k], own = basis.terms[to][k];
            divides = divides && own <= all;
            if (!divides) break;
            part.powers[k] = static_cast<std::uint8_t>(all - own);
            part.factor *= binomial(all, own);
        }
        if (divides) basis.parts.push_back(part);
    }
}

CellBasis make_cell_basis(const Reference& of) {
    std::array<WholePolynomial, max_nodes> n;
    shape_functions(of,
                    std::array{WholePolynomial::variable(0), WholePolynomial::variable(1),
                               of.dimension() == 3 ? WholePolynomial::variable(2) : WholePolynomial()},
                    n, nullptr);
    CellBasis basis;
    for (std::size_t place = 0; place < n[0].of.size(); ++place) {
        std::vector<double> factors(of.nodes);
        for (std::size_t i = 0; i < of.nodes; ++i) factors[i] = n[i].of[place];
        if (std::ranges::all_of(factors, [](double x) { return x == 0; })) continue;
        basis.terms.push_back({static_cast<std::uint8_t>(place / (powers_each * powers_each)),
                               static_cast<std::uint8_t>(place / powers_each % powers_each),
                               static_cast<std::uint8_t>(place % powers_each)});
        basis.factors.push_back(std::move(factors));
    }
    for (std::size_t t = 0; t < basis.terms.size(); ++t) add_parts(basis, t);
    return basis;
}

}  // namespace

const CellBasis& cell_basis(const Reference& of) {
    // By element and order.
    static const std::array<std::array<CellBasis, 4>, 6> all = [] {
        std::array<std::array<CellBasis, 4>, 6> made;
        const auto add = [&](const Reference& one) {
            made[static_cast<std::size_t>(one.element)][static_cast<std::size_t>(one.order) - 1] = make_cell_basis(one);
        };
        for (const VtkCell type : {vtk_quad, vtk_hexahedron, vtk_wedge, vtk_pyramid}) add(*linear_reference(type));
        for (const std::size_t nodes : {6, 10, 15}) add(*simplex_reference(2, nodes));
        for (const std::size_t nodes : {10, 20, 35}) add(*simplex_reference(3, nodes));
        return made;
    }();
    return all[static_cast<std::size_t>(of.element)][static_cast<std::size_t>(of.order) - 1];
}

CellPolynomial::CellPolynomial(const Reference& of, const Inverse& beside) : basis_(&cell_basis(of)) {
    for (std::size_t k = 0; k < of.dimension(); ++k) {
        // In two doubles each: what all nodes have in common may be far larger than the cell.
        std::array<Ball<TwoDoubles>, max_nodes> nodes;
        for (std::size_t i = 0; i < of.nodes; ++i) nodes[i] = beside.offset<TwoDoubles>(i, k);
        for (std::size_t t = 0; t < basis_->terms.size(); ++t) {
            Ball<TwoDoubles> sum(0);
            for (std::size_t i = 0; i < of.nodes; ++i) {
                const double factor = basis_->factors[t][i];
                if (factor != 0) sum = sum + nodes[i] * Ball<TwoDoubles>(TwoDoubles(factor));
            }
            const double high = sum.mid.high;
            balls_[t][k] = {high, (sum.radius + std::abs(sum.mid.low)) * (1 + 0x1p-48)};
            plain_[t][k] = high;
        }
    }
}

template <class N>
CellCoefficients<N> CellPolynomial::taylor(const CellCoefficients<N>& at_zero, const Vector<double>& x) const {
    std::array<std::array<N, powers_each>, 3> powers;
    for (std::size_t k = 0; k < 3; ++k) {
        powers[k][0] = N(1);
        for (std::size_t e = 1; e < powers_each; ++e) powers[k][e] = powers[k][e - 1] * N(x[k]);
    }
    CellCoefficients<N> out{};
    for (const CellBasis::TermShift& part : basis_->parts) {
        N by(part.factor);
        for (std::size_t k = 0; k < 3; ++k) {
            if (part.powers[k] != 0) by = by * powers[k][part.powers[k]];
        }
        for (std::size_t k = 0; k < 3; ++k) out[part.to][k] = out[part.to][k] + by * at_zero[part.of][k];
    }
    return out;
}

template CellCoefficients<double> CellPolynomial::taylor(const CellCoefficients<double>&, const Vector<double>&) const;
template CellCoefficients<Ball<double>> CellPolynomial::taylor(const CellCoefficients<Ball<double>>&,
                                                               const Vector<double>&) const;

}  // namespace barycert::core::isoparametric

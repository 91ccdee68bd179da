/// The sign of a polynomial all over a reference cell, by its Bernstein coefficients.
///
/// The cell is a product of simplices: of edges for a hexahedron, of a triangle and an edge for a wedge; of one for a
/// simplex. Values lie between the least and the largest coefficient; those at the cell's corners are values there. If
/// no coefficient has the other sign, and none of the corners' is zero, the polynomial has that sign everywhere: each
/// point is near a corner, whose basis function is positive there. Where this tells nothing, the cell is bisected at
/// its longest edge, as the coefficients of both halves are means of those of the whole (de Casteljau).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// Multi-indices of coefficients over a product of simplices, and how an edge is bisected.
class BernsteinBasis {
public:
    static constexpr std::size_t max_letters = 6;
    using Index = std::array<std::uint8_t, max_letters>;  ///< of each corner of each factor in turn

    struct Factor {
        std::size_t corners, degree;
    };
    explicit BernsteinBasis(const std::vector<Factor>& factors);

    std::size_t size() const { return indices_.size(); }
    const Index& index(std::size_t place) const { return indices_[place]; }
    std::size_t place(const Index& index) const;
    const std::vector<std::size_t>& corners() const { return corners_; }
    /// The product of the factorials of the index: the coefficients of a product of polynomials are sums over products
    /// of theirs, times that, over the factorials of the degrees.
    int factorials(std::size_t place) const;

    /// Two corners of one factor, as letters of an index.
    struct Edge {
        std::size_t from = 0, to = 0;
        std::vector<std::vector<std::uint16_t>> lines;  ///< places whose indices differ along the edge alone
        int degree = 0;
    };
    const std::vector<Edge>& edges() const { return edges_; }

private:
    std::vector<Index> indices_;
    std::vector<std::size_t> corners_;
    std::vector<Edge> edges_;
};

/// The basis of the Jacobian of a cell.
const BernsteinBasis& jacobian_basis(const Reference& of);

/// Finds the sign of a polynomial from its coefficients, each times a positive number that is the same for all.
/// sign_of(N) is the sign of a coefficient: -1, 0, 1, or nothing where rounding hides it. The answer is nothing where
/// it needs such a sign.
template <class N, class SignOf>
class SignSearch {
public:
    SignSearch(const BernsteinBasis& basis, const SignOf& sign_of) : basis_(basis), sign_of_(sign_of) {}

    std::optional<JacobianSign> sign(const std::vector<N>& coefficients, int bisections) {
        Corners corners{};
        for (std::size_t letter = 0; letter < corners.size(); ++letter) corners[letter][letter] = 1;
        const bool proved = search(coefficients, corners, bisections);
        if (hidden_ && !(proved || changes_)) return std::nullopt;
        if (changes_) return JacobianSign::changes;
        return proved ? static_cast<JacobianSign>(sign_) : JacobianSign::unknown;
    }

private:
    using Corners = std::array<std::array<double, BernsteinBasis::max_letters>, BernsteinBasis::max_letters>;
    /// Bounds the work on a polynomial that touches zero, where bisections never end.
    static constexpr int max_pieces = 4096;

    /// Whether the sign is proved to be that of the first corner in all of that part; else sets changes_ or hidden_, or
    /// gives up.
    bool search(const std::vector<N>& own, const Corners& corners, int left) {
        for (const std::size_t corner : basis_.corners()) {
            const std::optional<int> sign = sign_of_(own[corner]);
            if (!sign) return hide();
            if (sign_ == 0) sign_ = *sign;
            if (*sign != 0 && *sign == sign_) continue;
            changes_ = true;
            return false;
        }
        bool all = true;
        for (std::size_t i = 0; i < own.size() && all; ++i) {
            const std::optional<int> sign = sign_of_(own[i]);
            uncertain_ = uncertain_ || !sign;
            all = sign && *sign != -sign_;
        }
        if (all) return true;
        if (left == 0 || ++pieces_ > max_pieces) return uncertain_ ? hide() : false;
        const BernsteinBasis::Edge& edge = longest(corners);
        std::vector<N> low(own.size()), high(own.size());
        bisect(edge, own, low, high);
        for (const bool upper : {false, true}) {
            Corners half = corners;
            const std::size_t gone = upper ? edge.from : edge.to;
            for (std::size_t k = 0; k < half.size(); ++k)
                half[gone][k] = (corners[edge.from][k] + corners[edge.to][k]) / 2;
            if (!search(upper ? high : low, half, left - 1)) return false;
        }
        return true;
    }

    bool hide() {
        hidden_ = true;
        return false;
    }

    const BernsteinBasis::Edge& longest(const Corners& corners) const {
        const BernsteinBasis::Edge* found = nullptr;
        double most = 0;
        for (const BernsteinBasis::Edge& edge : basis_.edges()) {
            double square = 0;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const double by = corners[edge.from][k] - corners[edge.to][k];
                square += by * by;
            }
            if (square <= most) continue;
            most = square;
            found = &edge;
        }
        return *found;
    }

    /// Both halves times 2^degree, in sums alone.
    static void bisect(const BernsteinBasis::Edge& edge, const std::vector<N>& own, std::vector<N>& low,
                       std::vector<N>& high) {
        std::vector<N> sums;
        for (const auto& line : edge.lines) {
            const std::size_t last = line.size() - 1;
            sums.clear();
            for (const std::uint16_t at : line) sums.push_back(own[at]);
            for (std::size_t step = 0; step <= last; ++step) {
                const N by(1 << (static_cast<std::size_t>(edge.degree) - step));
                low[line[step]] = sums[0] * by;
                high[line[last - step]] = sums[last - step] * by;
                for (std::size_t i = 0; i + step < last; ++i) sums[i] = sums[i] + sums[i + 1];
            }
        }
    }

    const BernsteinBasis& basis_;
    const SignOf& sign_of_;
    int sign_ = 0, pieces_ = 0;
    bool changes_ = false, hidden_ = false, uncertain_ = false;
};

/// By the coefficients of the Jacobian in the order of its basis.
template <class N, class SignOf>
std::optional<JacobianSign> sign_by_bisection(const Reference& of, const std::vector<N>& coefficients,
                                              const SignOf& sign_of, int bisections = max_bisections) {
    const auto invoked = [&](const N& x) -> std::optional<int> { return std::invoke(sign_of, x); };
    return SignSearch<N, decltype(invoked)>(jacobian_basis(of), invoked).sign(coefficients, bisections);
}

}  // namespace barycert::core::isoparametric

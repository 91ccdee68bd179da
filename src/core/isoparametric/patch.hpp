/// Patches: vertices, edges and faces of cells with maps. Each is the image of a point, a segment, a triangle or a
/// square under a polynomial, sum of N_i(x) p_i over its own nodes.
///
/// Node (i, j) of a patch of order n stands at x = (i/n, j/n). All polynomials are those of monomials u^a v^b, times
/// `patch_scale`: then their coefficients are whole numbers of the nodes' places.
///
/// Places are held as X_0 + d(x), where X_0 is the node at x = 0: what a point far away is beside a patch is told by
/// X_0 - p, and the patch's own extent by d, each of them in a unit of its own, so that none is lost beside the other.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/isoparametric/ball.hpp"

namespace barycert::core::isoparametric {

inline constexpr int patch_scale = 24;           ///< 4!
inline constexpr std::size_t patch_nodes = 15;   ///< of order 4
inline constexpr std::size_t patch_degrees = 5;  ///< exponents 0 to 4

enum class PatchKind : std::uint8_t { point, curve, triangle, square };

struct PatchNode {
    const double* at = nullptr;
    const double* other = nullptr;        ///< the node is amid both
    std::array<std::uint8_t, 3> index{};  ///< barycentric, times the order, of corners 0, 1, 2; of a square 0, i, j
};

struct Patch {
    PatchKind kind = PatchKind::point;
    int order = 1;
    std::size_t dimension = 3;  ///< coordinates
    std::size_t count = 0;
    std::array<PatchNode, patch_nodes> nodes{};

    std::size_t variables() const { return kind == PatchKind::point ? 0 : kind == PatchKind::curve ? 1 : 2; }
    void add(const PatchNode& node) { nodes[count++] = node; }
    /// The node at x = 0.
    const double* origin() const;
};

/// Shape functions of a kind and order in monomials.
struct PatchBasis {
    struct Term {
        std::uint8_t a = 0, b = 0;  ///< u^a v^b; the first term is 1
    };
    std::vector<Term> terms;
    std::size_t degree = 1;  ///< the largest exponent of one variable
    /// [i][j][term]: of node (i, j), times patch_scale.
    std::array<std::array<std::vector<double>, patch_degrees>, patch_degrees> rows;

    const std::vector<double>& row(const PatchNode& node) const { return rows[node.index[1]][node.index[2]]; }
};
const PatchBasis& patch_basis(const Patch& patch);

/// x and y, or one of them.
template <class N>
using Params = std::array<N, 2>;

// Numbers of a type from doubles. Balls say what was rounded.

template <class N>
struct Made;
template <>
struct Made<double> {
    static double times(double x, double by) { return x * by; }
    /// (x - y) 2^shift
    static double difference(double x, double y, int shift) {
        const int down = std::max(std::abs(x), std::abs(y)) > 0x1p1000 ? 2 : 0;
        return std::ldexp(std::ldexp(x, -down) - std::ldexp(y, -down), shift + down);
    }
    static double power(int e) { return std::ldexp(1.0, e); }
};
template <>
struct Made<Rational> {
    static Rational times(const Rational& x, double by) { return x * Rational(by); }
    static Rational difference(double x, double y, int) { return Rational(x) - Rational(y); }
    static Rational power(int) { return 1; }
};
template <class T>
struct Made<Ball<T>> {
    static Ball<T> times(const Ball<T>& x, double by) { return x * Ball<T>(T(by)); }
    static Ball<T> difference(double x, double y, int shift) {
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, TwoDoubles>) {
            const int down = std::max(std::abs(x), std::abs(y)) > 0x1p1000 ? 2 : 0;
            const TwoDoubles d = TwoDoubles::sum(std::ldexp(x, -down), -std::ldexp(y, -down));
            const double high = std::ldexp(d.high, shift + down), low = std::ldexp(d.low, shift + down);
            if constexpr (std::is_same_v<T, double>)
                return {high, std::abs(low) + 0x1p-1060};
            else
                return {TwoDoubles(high, low), 0x1p-1060};
        } else {
            const Ball<T> d = Ball<T>(T(x)) - Ball<T>(T(y));
            return {T(ldexp(d.mid, shift)), std::ldexp(d.radius, shift)};
        }
    }
    static Ball<T> power(int e) {
        if (e < -1000) return {T(0), 0x1p-999};
        return Ball<T>(T(std::ldexp(1.0, e)));
    }
};

/// Units of a patch and a point: lengths are multiplied by 2^extent, those from the point by 2^away.
struct PatchUnits {
    int extent = 0, away = 0;
};
PatchUnits patch_units(const Patch& patch, const double* point);

/// A patch beside a point p: its place less p is `away` + ratio * d(x), in the unit of `away`.
template <class N>
struct PatchMap {
    const PatchBasis* basis = nullptr;
    std::size_t dimension = 3;
    std::array<N, 3> away{N(0), N(0), N(0)};
    std::array<std::vector<N>, 3> d;  ///< coefficients; the first, of 1, is 0
    N ratio{1};

    PatchMap(const Patch& patch, const double* point, const PatchUnits& units)
        : basis(&patch_basis(patch)), dimension(patch.dimension), ratio(Made<N>::power(units.away - units.extent)) {
        const double* const origin = patch.origin();
        for (std::size_t k = 0; k < dimension; ++k) {
            away[k] = Made<N>::times(Made<N>::difference(origin[k], point[k], units.away), patch_scale);
            d[k].assign(basis->terms.size(), N(0));
            for (std::size_t node = 0; node < patch.count; ++node) {
                const PatchNode& of = patch.nodes[node];
                if (of.at == origin && of.other == nullptr) continue;
                N from = Made<N>::difference(of.at[k], origin[k], units.extent);
                if (of.other != nullptr)
                    from = Made<N>::times(N(from + Made<N>::difference(of.other[k], origin[k], units.extent)), 0.5);
                const std::vector<double>& row = basis->row(of);
                for (std::size_t t = 1; t < row.size(); ++t) {
                    if (row[t] != 0) d[k][t] = d[k][t] + Made<N>::times(from, row[t]);
                }
            }
        }
    }
};

/// Powers of the parameters.
template <class N>
struct PatchPowers {
    std::array<std::array<N, patch_degrees>, 2> of;

    PatchPowers(const Params<N>& x, std::size_t degree) {
        for (std::size_t i = 0; i < 2; ++i) {
            of[i].fill(N(0));
            of[i][0] = N(1);
            for (std::size_t e = 1; e <= degree; ++e) of[i][e] = of[i][e - 1] * x[i];
        }
    }
    N at(const PatchBasis::Term& t) const {
        return t.b == 0 ? of[0][t.a] : t.a == 0 ? of[1][t.b] : of[0][t.a] * of[1][t.b];
    }
    /// A term's derivative by a variable.
    N by(const PatchBasis::Term& t, std::size_t variable) const {
        const std::uint8_t own = variable == 0 ? t.a : t.b, rest = variable == 0 ? t.b : t.a;
        if (own == 0) return N(0);
        const N power = own == 1 ? of[1 - variable][rest] : of[variable][own - 1U] * of[1 - variable][rest];
        return own == 1 ? power : power * N(own);
    }
};

/// d(x) and where a patch is there, less the point; and its derivatives, in the unit of the extent.
template <class N>
struct PatchJet {
    std::array<N, 3> d{N(0), N(0), N(0)}, at;
    std::array<std::array<N, 3>, 2> by;

    PatchJet(const PatchMap<N>& map, const Params<N>& x, std::size_t variables) {
        const PatchPowers<N> powers(x, map.basis->degree);
        const std::vector<PatchBasis::Term>& terms = map.basis->terms;
        by.fill({N(0), N(0), N(0)});
        for (std::size_t t = 1; t < terms.size(); ++t) {
            const N one = powers.at(terms[t]);
            for (std::size_t k = 0; k < map.dimension; ++k) d[k] = d[k] + map.d[k][t] * one;
            for (std::size_t v = 0; v < variables; ++v) {
                if ((v == 0 ? terms[t].a : terms[t].b) == 0) continue;
                const N slope = powers.by(terms[t], v);
                for (std::size_t k = 0; k < map.dimension; ++k) by[v][k] = by[v][k] + map.d[k][t] * slope;
            }
        }
        for (std::size_t k = 0; k < 3; ++k) at[k] = map.away[k] + map.ratio * d[k];
    }
    /// Half the derivative of the square of the distance.
    N slope(std::size_t variable) const {
        N sum(0);
        for (std::size_t k = 0; k < 3; ++k) sum = sum + at[k] * by[variable][k];
        return sum;
    }
};

}  // namespace barycert::core::isoparametric

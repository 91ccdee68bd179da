#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/bernstein.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/places.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"

namespace barycert::core::isoparametric {
namespace {

/// The Jacobian of a linear cell is a determinant of three (two) vectors, each a mean of edges of the cell whose
/// weights are products of the other coordinates. So it is a sum over such edges, one for each column, of their
/// determinants, and its Bernstein coefficients are means of these: coefficient (a, b, c) of those whose edges lie at
/// r, s, t that add up to a, b, c. Edges are pairs of nodes, with the coordinates at which they lie.
struct Edge {
    std::uint8_t from, to;
    std::uint8_t r = 0, s = 0, t = 0;
};
struct Columns {
    std::array<std::vector<Edge>, 3> edges;
};

/// Columns by element. The Jacobian of a pyramid is divided by (1-t)^2: its columns are edges of the base, and those to
/// the apex. r of a wedge's edges tells which of the three.
const Columns& columns_of(Element element) {
    using Edges = std::vector<Edge>;
    static const std::array<Columns, 4> all{{
        {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}}, Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}}, Edges{{0, 0, 0, 0, 0}}}},
        {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}, {4, 5, 0, 0, 1}, {7, 6, 0, 1, 1}},
          Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}, {4, 7, 0, 0, 1}, {5, 6, 1, 0, 1}},
          Edges{{0, 4, 0, 0, 0}, {1, 5, 1, 0, 0}, {2, 6, 1, 1, 0}, {3, 7, 0, 1, 0}}}},
        {{Edges{{0, 1, 0, 0, 0}, {3, 4, 0, 0, 1}}, Edges{{0, 2, 0, 0, 0}, {3, 5, 0, 0, 1}},
          Edges{{0, 3, 0, 0, 0}, {1, 4, 1, 0, 0}, {2, 5, 2, 0, 0}}}},
        {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}}, Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}},
          Edges{{0, 4, 0, 0, 0}, {1, 4, 1, 0, 0}, {2, 4, 1, 1, 0}, {3, 4, 0, 1, 0}}}},
    }};
    return all[static_cast<std::size_t>(element)];
}

/// The index of the coefficient to which edges at r, s, t (added up over the columns) belong.
BernsteinBasis::Index index_of(Element element, int r, int s, int t) {
    const auto number = [](int k) { return static_cast<std::uint8_t>(k); };
    switch (element) {
        case Element::quadrilateral:
            return {number(1 - r), number(r), number(1 - s), number(s)};
        case Element::wedge:
            return {number(r == 0), number(r == 1), number(r == 2), number(2 - t), number(t)};
        case Element::pyramid:
            return {number(2 - r), number(r), number(2 - s), number(s)};
        default:
            return {number(2 - r), number(r), number(2 - s), number(s), number(2 - t), number(t)};
    }
}

/// Its place, by r + 3 s + 9 t.
const std::array<std::size_t, 27>& places_in_basis(const Reference& of) {
    static const auto all = [] {
        std::array<std::array<std::size_t, 27>, 4> made{};
        for (const std::uint8_t type : {vtk_quad, vtk_hexahedron, vtk_wedge, vtk_pyramid}) {
            const Reference& own = *linear_reference(type);
            for (int i = 0; i < 27; ++i)
                made[static_cast<std::size_t>(own.element)][static_cast<std::size_t>(i)] =
                    jacobian_basis(own).place(index_of(own.element, i % 3, i / 3 % 3, i / 9));
        }
        return made;
    }();
    return all[static_cast<std::size_t>(of.element)];
}

/// Bernstein coefficients of the Jacobian, times one positive number, of q(node, axis) - q(other, axis) as N.
template <class N, class Difference>
std::vector<N> coefficients(const Reference& of, Difference difference) {
    const Columns& columns = columns_of(of.element);
    const bool flat = of.dimension() == 2;
    std::array<std::array<Vector<N>, 4>, 3> vectors;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < columns.edges[c].size(); ++i) {
            const Edge& e = columns.edges[c][i];
            for (std::size_t k = 0; k < 3; ++k)
                vectors[c][i][k] = flat && (k == 2 || c == 2) ? N(k == c ? 1 : 0) : difference(e.to, e.from, k);
        }
    }
    const BernsteinBasis& basis = jacobian_basis(of);
    const std::array<std::size_t, 27>& places = places_in_basis(of);
    std::vector<N> sums(basis.size(), N(0));
    for (std::size_t i = 0; i < columns.edges[0].size(); ++i) {
        for (std::size_t j = 0; j < columns.edges[1].size(); ++j) {
            const Vector<N> cross = base::cross(vectors[0][i], vectors[1][j]);
            for (std::size_t k = 0; k < columns.edges[2].size(); ++k) {
                const Edge &e = columns.edges[0][i], &f = columns.edges[1][j], &g = columns.edges[2][k];
                const int at = (e.r + f.r + g.r) + 3 * (e.s + f.s + g.s) + 9 * (e.t + f.t + g.t);
                N& own = sums[places[static_cast<std::size_t>(at)]];
                own = own + base::dot(cross, vectors[2][k]);
            }
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sums[i] * N(basis.factorials(i));
    return sums;
}

/// The sign that all coefficients have, if it is certain.
std::optional<JacobianSign> common_sign(const Reference& of, const Places& places) {
    // In double, u = 2^-53: edges up to m are off by u m, a determinant by (6 * 8 + 2) u m^3, a sum of eight of them by
    // 8 (50 + 7 * 6) u m^3 < 2^-43 m^3; times at most 8, likewise. Coordinates are divided so that nothing overflows.
    const double scale = scale_of(of, places);
    double most = 0;
    const std::vector<double> all = coefficients<double>(of, [&](std::size_t to, std::size_t from, std::size_t k) {
        const double x = places.at[to][k] * scale - places.at[from][k] * scale;
        most = std::max(most, std::abs(x));
        return x;
    });
    const double off = 8 * 0x1p-43 * most * most * (of.dimension() == 2 ? 1 : most);
    if (!(most > 0x1p-200)) return std::nullopt;
    const auto [low, high] = std::ranges::minmax(all);
    if (low > off) return JacobianSign::positive;
    return high < -off ? std::optional(JacobianSign::negative) : std::nullopt;
}

}  // namespace

JacobianSign jacobian_sign(const Reference& of, const Places& places, int bisections) {
    if (of.is_simplex()) return simplex_jacobian_sign(of, places, bisections);
    if (const auto sign = common_sign(of, places)) return *sign;
    const double scale = scale_of(of, places);
    const auto near = coefficients<Ball<double>>(of, [&](std::size_t to, std::size_t from, std::size_t k) {
        return Ball<double>(places.at[to][k] * scale) - Ball<double>(places.at[from][k] * scale);
    });
    if (const auto sign = sign_by_bisection(of, near, &Ball<double>::sign, bisections)) return *sign;
    const WholePlaces place(of, places);
    const auto exact = coefficients<Whole>(
        of, [&](std::size_t to, std::size_t from, std::size_t k) { return place(to, k) - place(from, k); });
    return *sign_by_bisection(
        of, exact, [](const Whole& x) { return std::optional(x.sign()); }, bisections);
}

}  // namespace barycert::core::isoparametric

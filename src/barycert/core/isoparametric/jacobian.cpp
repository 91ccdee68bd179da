#include "barycert/core/isoparametric/newton.hpp"

namespace barycert::core::isoparametric {
namespace {

/// The Jacobian of a linear cell is a determinant of three (two) vectors, each a mean of edges of the cell whose
/// weights are products of the other coordinates. So it is a sum over such edges, one for each column, of their
/// determinants, and its Bernstein coefficients are means of these: coefficient (a, b, c) of those whose edges lie at
/// r, s, t that add up to a, b, c. Each letter is a node; edges are pairs, with the coordinates at which they lie.
struct Edge {
    std::uint8_t from, to;
    std::uint8_t r = 0, s = 0, t = 0;
};
struct Columns {
    std::array<std::vector<Edge>, 3> edges;
    std::array<bool, 3> quadratic{};  ///< the Jacobian along r, s, t: coefficients 0 and 2 are at corners, 1 is amid
};

/// By element. Of a pyramid the Jacobian is divided by (1-t)^2: its columns are edges of the base, and those to the
/// apex. r of a wedge's edges tells which of the three.
const Columns& columns_of(Element element) {
    using Edges = std::vector<Edge>;
    static const std::array<Columns, 4> all{{
        {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}}, Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}}, Edges{{0, 0, 0, 0, 0}}},
         {}},
        {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}, {4, 5, 0, 0, 1}, {7, 6, 0, 1, 1}},
          Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}, {4, 7, 0, 0, 1}, {5, 6, 1, 0, 1}},
          Edges{{0, 4, 0, 0, 0}, {1, 5, 1, 0, 0}, {2, 6, 1, 1, 0}, {3, 7, 0, 1, 0}}},
         {true, true, true}},
        {{Edges{{0, 1, 0, 0, 0}, {3, 4, 0, 0, 1}}, Edges{{0, 2, 0, 0, 0}, {3, 5, 0, 0, 1}},
          Edges{{0, 3, 0, 0, 0}, {1, 4, 1, 0, 0}, {2, 5, 2, 0, 0}}},
         {false, false, true}},
        {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}}, Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}},
          Edges{{0, 4, 0, 0, 0}, {1, 4, 1, 0, 0}, {2, 4, 1, 1, 0}, {3, 4, 0, 1, 0}}},
         {true, true, false}},
    }};
    return all[static_cast<std::size_t>(element)];
}

/// q(node, axis) - q(other, axis) as N; nothing if a coefficient's sign is not known.
template <class N, class Difference, class Sign>
std::optional<JacobianSign> common_sign(const Columns& columns, bool flat, Difference difference, Sign sign_of) {
    std::array<std::array<Vector<N>, 4>, 3> vectors;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < columns.edges[c].size(); ++i) {
            const Edge& e = columns.edges[c][i];
            for (std::size_t k = 0; k < 3; ++k)
                vectors[c][i][k] = flat && (k == 2 || c == 2) ? N(k == c ? 1 : 0) : difference(e.to, e.from, k);
        }
    }
    std::array<N, 27> sums;
    unsigned used = 0;
    for (std::size_t i = 0; i < columns.edges[0].size(); ++i) {
        for (std::size_t j = 0; j < columns.edges[1].size(); ++j) {
            const Vector<N> cross = base::cross(vectors[0][i], vectors[1][j]);
            for (std::size_t k = 0; k < columns.edges[2].size(); ++k) {
                const Edge &e = columns.edges[0][i], &f = columns.edges[1][j], &g = columns.edges[2][k];
                const auto at =
                    static_cast<std::size_t>((e.r + f.r + g.r) + 3 * (e.s + f.s + g.s) + 9 * (e.t + f.t + g.t));
                const N own = base::dot(cross, vectors[2][k]);
                sums[at] = (used >> at & 1U) != 0 ? N(sums[at] + own) : own;
                used |= 1U << at;
            }
        }
    }
    CoefficientSigns signs;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if ((used >> i & 1U) == 0) continue;
        const std::optional<int> own = sign_of(sums[i]);
        if (!own) return std::nullopt;
        bool middle = false;
        for (std::size_t axis = 0, rest = i; axis < 3; ++axis, rest /= 3)
            middle = middle || (columns.quadratic[axis] && rest % 3 == 1);
        signs.add(*own, !middle);
    }
    return signs.sign();
}

}  // namespace

const Reference* linear_reference(std::uint8_t type) {
    static const Reference quadrilateral{Element::quadrilateral, 1, 4}, hexahedron{Element::hexahedron, 1, 8},
        wedge{Element::wedge, 1, 6}, pyramid{Element::pyramid, 1, 5};
    if (type == 8 || type == 9) return &quadrilateral;
    if (type == 11 || type == 12) return &hexahedron;
    return type == 13 ? &wedge : type == 14 ? &pyramid : nullptr;
}

JacobianSign jacobian_sign(const Reference& of, const Places& places) {
    if (of.is_simplex()) return simplex_jacobian_sign(of, places);
    const Columns& columns = columns_of(of.element);
    const bool flat = of.dimension() == 2;
    // In double, u = 2^-53: edges up to m are off by u m, a determinant by (6 * 8 + 2) u m^3, a sum of eight of them by
    // 8 (50 + 7 * 6) u m^3 < 2^-43 m^3. Coordinates are divided so that nothing overflows.
    const double scale = scale_of(of, places);
    double most = 0;
    const auto near = [&](std::size_t to, std::size_t from, std::size_t k) {
        const double x = places.at[to][k] * scale - places.at[from][k] * scale;
        most = std::max(most, std::abs(x));
        return x;
    };
    const auto certain = [&](double sum) -> std::optional<int> {
        if (!(most > 0x1p-200 && std::abs(sum) > 0x1p-43 * most * most * (flat ? 1 : most))) return std::nullopt;
        return sum < 0 ? -1 : 1;
    };
    if (const auto sign = common_sign<double>(columns, flat, near, certain)) return *sign;
    const auto exact = [&](std::size_t to, std::size_t from, std::size_t k) {
        return Rational(places.at[to][k]) - Rational(places.at[from][k]);
    };
    return *common_sign<Rational>(columns, flat, exact, [](const Rational& x) { return std::optional(x.sign()); });
}

}  // namespace barycert::core::isoparametric

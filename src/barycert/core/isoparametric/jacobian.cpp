#include <functional>
#include <optional>

#include "barycert/core/isoparametric/ball.hpp"
#include "barycert/core/isoparametric/inverse.hpp"

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

/// Of a pyramid the Jacobian is divided by (1-t)^2: its columns are edges of the base, and those to the apex.
Columns columns_of(Element element) {
    using Edges = std::vector<Edge>;
    switch (element) {
        case Element::hexahedron:
            return {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}, {4, 5, 0, 0, 1}, {7, 6, 0, 1, 1}},
                     Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}, {4, 7, 0, 0, 1}, {5, 6, 1, 0, 1}},
                     Edges{{0, 4, 0, 0, 0}, {1, 5, 1, 0, 0}, {2, 6, 1, 1, 0}, {3, 7, 0, 1, 0}}},
                    {true, true, true}};
        case Element::wedge:  // r tells which of the three
            return {{Edges{{0, 1, 0, 0, 0}, {3, 4, 0, 0, 1}}, Edges{{0, 2, 0, 0, 0}, {3, 5, 0, 0, 1}},
                     Edges{{0, 3, 0, 0, 0}, {1, 4, 1, 0, 0}, {2, 5, 2, 0, 0}}},
                    {false, false, true}};
        case Element::pyramid:
            return {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}}, Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}},
                     Edges{{0, 4, 0, 0, 0}, {1, 4, 1, 0, 0}, {2, 4, 1, 1, 0}, {3, 4, 0, 1, 0}}},
                    {true, true, false}};
        default:
            return {{Edges{{0, 1, 0, 0, 0}, {3, 2, 0, 1, 0}}, Edges{{0, 3, 0, 0, 0}, {1, 2, 1, 0, 0}},
                     Edges{{0, 0, 0, 0, 0}}},
                    {}};
    }
}

template <class N>
N determinant(const std::array<N, 3>& a, const std::array<N, 3>& b, const std::array<N, 3>& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// q(node, axis) - q(other, axis) as N; nothing if a coefficient's sign is not known.
template <class N, class Difference, class Sign>
std::optional<JacobianSign> common_sign(const Columns& columns, bool flat, Difference difference, Sign sign_of) {
    std::array<std::vector<std::array<N, 3>>, 3> vectors;
    for (std::size_t c = 0; c < 3; ++c) {
        for (const Edge& e : columns.edges[c]) {
            auto& v = vectors[c].emplace_back();
            for (std::size_t k = 0; k < 3; ++k) v[k] = flat && k == 2 ? N(c == 2 ? 1 : 0) : difference(e.to, e.from, k);
            if (flat && c == 2) v = {N(0), N(0), N(1)};
        }
    }
    std::array<std::optional<N>, 27> sums;
    for (std::size_t i = 0; i < vectors[0].size(); ++i) {
        for (std::size_t j = 0; j < vectors[1].size(); ++j) {
            for (std::size_t k = 0; k < vectors[2].size(); ++k) {
                const Edge &e = columns.edges[0][i], &f = columns.edges[1][j], &g = columns.edges[2][k];
                auto& sum =
                    sums[static_cast<std::size_t>((e.r + f.r + g.r) + 3 * (e.s + f.s + g.s) + 9 * (e.t + f.t + g.t))];
                const N own = determinant(vectors[0][i], vectors[1][j], vectors[2][k]);
                sum = sum ? *sum + own : own;
            }
        }
    }
    CoefficientSigns signs;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (!sums[i]) continue;
        const std::optional<int> own = std::invoke(sign_of, *sums[i]);
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
    switch (type) {
        case 8:
        case 9:
            return &quadrilateral;
        case 11:
        case 12:
            return &hexahedron;
        case 13:
            return &wedge;
        case 14:
            return &pyramid;
        default:
            return nullptr;
    }
}

JacobianSign jacobian_sign(const Reference& of, const Places& places) {
    if (of.is_simplex()) return simplex_jacobian_sign(of, places);
    const Columns columns = columns_of(of.element);
    const bool flat = of.dimension() == 2;
    // Divided so that nothing overflows; what underflows has a radius.
    int exponent = -1100;
    for (std::size_t i = 0; i < of.nodes; ++i) {
        for (std::size_t k = 0; k < of.dimension(); ++k) {
            int own = 0;
            std::frexp(places.at[i][k], &own);
            if (places.at[i][k] != 0) exponent = std::max(exponent, own);
        }
    }
    const auto scaled = [&](std::size_t node, std::size_t k) { return std::ldexp(places.at[node][k], -exponent - 1); };
    const auto doubles = [&](std::size_t to, std::size_t from, std::size_t k) {
        return Ball<double>(scaled(to, k)) - Ball<double>(scaled(from, k));
    };
    const auto sign = common_sign<Ball<double>>(columns, flat, doubles, &Ball<double>::sign);
    if (sign) return *sign;
    const auto exact = [&](std::size_t to, std::size_t from, std::size_t k) {
        return Rational(places.at[to][k]) - Rational(places.at[from][k]);
    };
    return *common_sign<Rational>(columns, flat, exact, [](const Rational& x) { return std::optional(x.sign()); });
}

}  // namespace barycert::core::isoparametric

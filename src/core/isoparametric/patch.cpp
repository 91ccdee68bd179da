#include "core/isoparametric/patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/isoparametric/places.hpp"

namespace barycert::core::isoparametric {
namespace {

/// Coefficients of u^a v^b.
using Polynomial = std::array<std::array<double, patch_degrees>, patch_degrees>;

/// p (n l - k), where l = c + u x + v y.
Polynomial times_factor(const Polynomial& p, double c, double x, double y) {
    Polynomial out{};
    for (std::size_t a = 0; a < patch_degrees; ++a) {
        for (std::size_t b = 0; b < patch_degrees; ++b) {
            out[a][b] += c * p[a][b];
            if (a + 1 < patch_degrees) out[a + 1][b] += x * p[a][b];
            if (b + 1 < patch_degrees) out[a][b + 1] += y * p[a][b];
        }
    }
    return out;
}

/// The shape function of a node of a curve or triangle: 24/(i! j! k!) times falling products of n times each
/// barycentric coordinate.
Polynomial shape_of_node(bool curve, int order, const std::array<int, 3>& index) {
    constexpr std::array<int, 5> factorial{1, 1, 2, 6, 24};
    Polynomial p{};
    p[0][0] = patch_scale;
    for (const int i : index) p[0][0] /= factorial[static_cast<std::size_t>(i)];
    const double n = order;
    for (std::size_t c = 0; c < 3; ++c) {
        for (int k = 0; k < index[c]; ++k) {
            const double one = c == 0 ? n : 0, u = c == 0 ? -n : c == 1 ? n : 0;
            const double v = curve || c == 1 ? 0 : c == 0 ? -n : n;
            p = times_factor(p, one - k, u, v);
        }
    }
    return p;
}

/// Monomials up to that degree: in all, or of a square in each variable.
std::vector<PatchBasis::Term> terms_of(PatchKind kind, std::size_t degree) {
    std::vector<PatchBasis::Term> terms;
    for (std::size_t a = 0; a <= degree; ++a) {
        for (std::size_t b = 0; b <= degree; ++b) {
            if (kind == PatchKind::triangle ? a + b <= degree : kind == PatchKind::square || b == 0)
                terms.push_back({static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)});
        }
    }
    return terms;
}

PatchBasis make_basis(PatchKind kind, int order) {
    PatchBasis basis;
    basis.degree = kind == PatchKind::point ? 0 : static_cast<std::size_t>(order);
    basis.terms = terms_of(kind, basis.degree);
    const auto set = [&](std::size_t i, std::size_t j, const Polynomial& p) {
        for (const PatchBasis::Term& t : basis.terms) basis.rows[i][j].push_back(p[t.a][t.b]);
    };
    if (kind == PatchKind::point) {
        basis.rows[0][0] = {patch_scale};
    } else if (kind == PatchKind::square) {
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t j = 0; j < 2; ++j) {
                Polynomial p{};
                p[0][0] = patch_scale;
                p = times_factor(p, i == 0 ? 1 : 0, i == 0 ? -1 : 1, 0);
                set(i, j, times_factor(p, j == 0 ? 1 : 0, 0, j == 0 ? -1 : 1));
            }
        }
    } else {
        for (int i = 0; i <= order; ++i) {
            for (int j = 0; i + j <= order && (j == 0 || kind == PatchKind::triangle); ++j)
                set(static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                    shape_of_node(kind == PatchKind::curve, order, {order - i - j, i, j}));
        }
    }
    return basis;
}

}  // namespace

const double* Patch::origin() const {
    for (std::size_t i = 0; i < count; ++i) {
        if (nodes[i].index[1] == 0 && nodes[i].index[2] == 0) return nodes[i].at;
    }
    return nullptr;  // not reached: every patch has the node at x = 0
}

const PatchBasis& patch_basis(const Patch& patch) {
    static const std::array<std::array<PatchBasis, 4>, 4> all = [] {
        std::array<std::array<PatchBasis, 4>, 4> made;
        for (std::size_t kind = 0; kind < 4; ++kind) {
            const bool many = kind == 1 || kind == 2;
            for (std::size_t order = 1; order <= (many ? 4U : 1U); ++order)
                made[kind][order - 1] = make_basis(static_cast<PatchKind>(kind), static_cast<int>(order));
        }
        return made;
    }();
    return all[static_cast<std::size_t>(patch.kind)][static_cast<std::size_t>(patch.order) - 1];
}

PatchUnits patch_units(const Patch& patch, const double* point) {
    const double* const origin = patch.origin();
    double extent = 0, away = 0;
    int down = 0;  // no difference overflows
    for (std::size_t k = 0; k < patch.dimension; ++k) {
        if (std::abs(point[k]) > 0x1p1000 || std::abs(origin[k]) > 0x1p1000) down = 2;
        for (std::size_t i = 0; i < patch.count; ++i) {
            const double* const other = patch.nodes[i].other;
            if (std::abs(patch.nodes[i].at[k]) > 0x1p1000 || (other != nullptr && std::abs(other[k]) > 0x1p1000))
                down = 2;
        }
    }
    const auto difference = [&](double x, double y) { return std::abs(std::ldexp(x, -down) - std::ldexp(y, -down)); };
    for (std::size_t k = 0; k < patch.dimension; ++k) {
        away = std::max(away, difference(origin[k], point[k]));
        for (std::size_t i = 0; i < patch.count; ++i) {
            extent = std::max(extent, difference(patch.nodes[i].at[k], origin[k]));
            if (patch.nodes[i].other != nullptr)
                extent = std::max(extent, difference(patch.nodes[i].other[k], origin[k]));
        }
    }
    PatchUnits units;
    units.extent = extent > 0 ? -exponent_above(extent) - down : 0;
    units.away = away > 0 ? -exponent_above(away) - down : units.extent;
    if (patch.kind != PatchKind::point) units.away = std::min(units.away, units.extent);
    return units;
}

}  // namespace barycert::core::isoparametric

#include "mesh/locate/mapped/square_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "core/isoparametric/patch.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/locate/near_bounds.hpp"
#include "mesh/locate/near_feature.hpp"

namespace barycert::locate {

namespace iso = core::isoparametric;
using iso::Params, iso::PatchKind;

namespace {

constexpr std::array<std::array<Real, 9>, 9> choose{{{1},
                                                     {1, 1},
                                                     {1, 2, 1},
                                                     {1, 3, 3, 1},
                                                     {1, 4, 6, 4, 1},
                                                     {1, 5, 10, 10, 5, 1},
                                                     {1, 6, 15, 20, 15, 6, 1},
                                                     {1, 7, 21, 35, 35, 21, 7, 1},
                                                     {1, 8, 28, 56, 70, 56, 28, 8, 1}}};

/// Bernstein coefficients from those of monomials: the coefficient of u^i v^j in degree n counts for (k choose i) (l
/// choose j) over what u^i v^j has.
SquareOfDistance::Coefficients to_bernstein(const SquareOfDistance::Coefficients& a, PatchKind kind, std::size_t n) {
    SquareOfDistance::Coefficients b{};
    const std::size_t most_l = kind == PatchKind::curve ? 0 : n;
    for (std::size_t k = 0; k <= n; ++k) {
        for (std::size_t l = 0; l <= (kind == PatchKind::triangle ? n - k : most_l); ++l) {
            for (std::size_t i = 0; i <= k; ++i) {
                for (std::size_t j = 0; j <= l; ++j) {
                    const Real all = choose[n][i] * choose[kind == PatchKind::triangle ? n - i : n][j];
                    b[k][l] += choose[k][i] * choose[l][j] / all * a[i][j];
                }
            }
        }
    }
    return b;
}

/// Where a node is less o; of two, amid them.
Real offset(const iso::PatchNode& node, std::size_t k, Real o) {
    const Real own = node.at[k] - o;
    return node.other == nullptr ? own : own / 2 + (node.other[k] - o) / 2;
}

/// Coefficients of X - o in monomials. Coefficients that are not constant do not depend on o, and are taken from the
/// origin.
std::vector<Real> coefficients_along(const iso::Patch& patch, std::size_t k, double o) {
    const iso::PatchBasis& basis = iso::patch_basis(patch);
    const double origin = patch.origin()[k];
    std::vector<Real> y(basis.terms.size(), 0);
    for (std::size_t n = 0; n < patch.count; ++n) {
        const std::vector<double>& row = basis.row(patch.nodes[n]);
        const Real from = offset(patch.nodes[n], k, origin);
        for (std::size_t t = 1; t < row.size(); ++t) y[t] += from * row[t] / iso::patch_scale;
    }
    y[0] = static_cast<Real>(origin) - o;
    return y;
}

/// De Casteljau at the middle of a row: to its first half, and to the other one.
void halve_row(std::array<Real, 9> row, std::size_t degree, std::array<Real, 9>& first, std::array<Real, 9>& second) {
    for (std::size_t step = 0; step <= degree; ++step) {
        first[step] = row[0];
        second[degree - step] = row[degree - step];
        for (std::size_t i = 0; i + step < degree; ++i) row[i] = (row[i] + row[i + 1]) / 2;
    }
}

}  // namespace

SquareOfDistance::SquareOfDistance(const iso::Patch& patch, const Point3& p, const Point3& o)
    : basis_(iso::patch_basis(patch)), kind_(patch.kind), degree_(2 * basis_.degree) {
    Real sum = 0, far = 0;
    for (std::size_t k = 0; k < patch.dimension; ++k) {
        y_[k] = coefficients_along(patch, k, o[k]);
        from_[k] = static_cast<Real>(o[k]) - p[k];
        for (const Real x : y_[k]) sum += std::abs(x);
        far = std::max(far, std::abs(from_[k]));
    }
    error_ = 0x1p-40L * sum * (sum + 2 * far) + min;
}

Real SquareOfDistance::at(const Params<double>& x) const {
    const iso::PatchPowers<Real> powers({x[0], x[1]}, basis_.degree);
    Real3 y{};
    for (std::size_t t = 0; t < basis_.terms.size(); ++t) {
        const Real power = powers.at(basis_.terms[t]);
        for (std::size_t k = 0; k < 3; ++k) y[k] += y_[k].empty() ? 0 : y_[k][t] * power;
    }
    return dot(y, y) + 2 * dot(y, from_);
}

SquareOfDistance::Coefficients SquareOfDistance::bernstein() const {
    Coefficients a{};
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t s = 0; s < y_[k].size(); ++s) {
            const auto [i, j] = basis_.terms[s];
            a[i][j] += 2 * y_[k][s] * from_[k];
            for (std::size_t t = 0; t < y_[k].size(); ++t)
                a[i + std::size_t{basis_.terms[t].a}][j + std::size_t{basis_.terms[t].b}] += y_[k][s] * y_[k][t];
        }
    }
    return to_bernstein(a, kind_, degree_);
}

SquarePart::SquarePart(const SquareOfDistance& of, PatchKind patch_kind)
    : kind(patch_kind), degree(of.degree()), b(of.bernstein()) {
    corner = {{{0, 0}, {1, 0}, {0, 1}}};
    if (kind == PatchKind::square) corner[1] = {1, 1};
}

template <class Use>
void SquarePart::for_each(Use use) const {
    for (std::size_t i = 0; i <= degree; ++i) {
        const std::size_t most = kind == PatchKind::curve ? 0 : kind == PatchKind::square ? degree : degree - i;
        for (std::size_t j = 0; j <= most; ++j) use(b[i][j]);
    }
}

Real SquarePart::least() const {
    Real low = b[0][0];
    for_each([&](Real x) { low = x < low ? x : low; });
    return low;
}

Real SquarePart::most() const {
    Real high = b[0][0];
    for_each([&](Real x) { high = x > high ? x : high; });
    return high;
}

Params<double> SquarePart::lowest_corner(Real& value) const {
    value = b[0][0];
    Params<double> at = corner[0];
    const auto take = [&](Real own, const Params<double>& x) {
        if (!(own < value)) return;
        value = own;
        at = x;
    };
    const std::size_t n = degree;
    take(b[n][0], kind == PatchKind::square ? Params<double>{corner[1][0], corner[0][1]} : corner[1]);
    if (kind == PatchKind::triangle) take(b[0][n], corner[2]);
    if (kind == PatchKind::square) {
        take(b[0][n], {corner[0][0], corner[1][1]});
        take(b[n][n], corner[1]);
    }
    return at;
}

Params<double> SquarePart::middle() const {
    const auto mean = [&](std::size_t k) {
        return kind == PatchKind::triangle ? (corner[0][k] + corner[1][k] + corner[2][k]) / 3
                                           : (corner[0][k] + corner[1][k]) / 2;
    };
    return {mean(0), mean(1)};
}

double SquarePart::width() const {
    double most = 0;
    for (std::size_t c = 1; c < (kind == PatchKind::triangle ? 3 : 2); ++c) {
        for (std::size_t k = 0; k < 2; ++k) most = std::max(most, std::abs(corner[c][k] - corner[0][k]));
    }
    return most;
}

bool SquarePart::within(const Params<double>& x, double radius) const {
    for (std::size_t c = 0; c < (kind == PatchKind::triangle ? 3 : 2); ++c) {
        for (std::size_t k = 0; k < 2; ++k) {
            if (!(std::abs(corner[c][k] - x[k]) <= radius * (1 - 0x1p-40))) return false;
        }
    }
    return true;
}

bool SquarePart::slopes(Real error) const {
    if (kind == PatchKind::triangle) return slopes_in_triangle(error);
    return slopes_in_rectangle(error);
}

bool SquarePart::slopes_in_triangle(Real error) const {
    // Along edges 01 and 02, and all mixtures of both: one that the part as a whole slopes along.
    const auto along = [&](std::size_t i, std::size_t j, std::size_t corner_of) {
        return (corner_of == 1 ? b[i + 1][j] : b[i][j + 1]) - b[i][j];
    };
    Real x = 0, y = 0;
    for (std::size_t i = 0; i < degree; ++i) {
        for (std::size_t j = 0; i + j < degree; ++j) {
            x += along(i, j, 1);
            y += along(i, j, 2);
        }
    }
    const auto all = [&](Real by_x, Real by_y) {
        const Real room = 4 * error * (std::abs(by_x) + std::abs(by_y));
        for (std::size_t i = 0; i < degree; ++i) {
            for (std::size_t j = 0; i + j < degree; ++j) {
                if (!(by_x * along(i, j, 1) + by_y * along(i, j, 2) > room)) return false;
            }
        }
        return true;
    };
    return all(x, y) || all(x < 0 ? -1 : 1, 0) || all(0, y < 0 ? -1 : 1) || all(x < y ? -1 : 1, x < y ? 1 : -1);
}

bool SquarePart::slopes_in_rectangle(Real error) const {
    const std::size_t across = kind == PatchKind::curve ? 0 : degree;
    const auto all = [&](bool first, Real sign) {
        for (std::size_t i = 0; i < degree; ++i) {
            for (std::size_t j = 0; j <= across; ++j) {
                const Real slope = first ? b[i + 1][j] - b[i][j] : b[j][i + 1] - b[j][i];
                if (!(sign * slope > 4 * error)) return false;
            }
        }
        return true;
    };
    if (all(true, 1) || all(true, -1)) return true;
    return kind == PatchKind::square && (all(false, 1) || all(false, -1));
}

std::array<SquarePart, 2> SquarePart::halves() const {
    std::array<SquarePart, 2> out{*this, *this};
    const std::size_t n = degree;
    std::array<Real, 9> row{}, first{}, second{};
    if (kind != PatchKind::triangle) {
        const bool by_u = kind == PatchKind::curve || corner[1][0] - corner[0][0] >= corner[1][1] - corner[0][1];
        const std::size_t axis = by_u ? 0 : 1, across = kind == PatchKind::curve ? 0 : n;
        for (std::size_t j = 0; j <= across; ++j) {
            for (std::size_t i = 0; i <= n; ++i) row[i] = by_u ? b[i][j] : b[j][i];
            halve_row(row, n, first, second);
            for (std::size_t i = 0; i <= n; ++i) {
                (by_u ? out[0].b[i][j] : out[0].b[j][i]) = first[i];
                (by_u ? out[1].b[i][j] : out[1].b[j][i]) = second[i];
            }
        }
        out[0].corner[1][axis] = out[1].corner[0][axis] = (corner[0][axis] + corner[1][axis]) / 2;
        return out;
    }
    // The edge a b, c beyond: rows of one exponent of c.
    std::size_t a = 0, e = 1;
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = i + 1; j < 3; ++j) {
            const double length = std::hypot(corner[i][0] - corner[j][0], corner[i][1] - corner[j][1]);
            if (length > longest) longest = length, a = i, e = j;
        }
    }
    const std::size_t c = 3 - a - e;
    const auto place = [&](SquarePart& part, std::size_t of_a, std::size_t of_e, std::size_t of_c) -> Real& {
        std::array<std::size_t, 3> exponent{};
        exponent[a] = of_a;
        exponent[e] = of_e;
        exponent[c] = of_c;
        return part.b[exponent[1]][exponent[2]];
    };
    SquarePart own = *this;
    for (std::size_t k = 0; k <= n; ++k) {
        const std::size_t m = n - k;
        for (std::size_t s = 0; s <= m; ++s) row[s] = place(own, m - s, s, k);
        halve_row(row, m, first, second);
        for (std::size_t s = 0; s <= m; ++s) {
            place(out[0], m - s, s, k) = first[s];
            place(out[1], m - s, s, k) = second[s];
        }
    }
    const Params<double> middle{(corner[a][0] + corner[e][0]) / 2, (corner[a][1] + corner[e][1]) / 2};
    out[0].corner[e] = middle;
    out[1].corner[a] = middle;
    return out;
}

index::Box box_of_patch(const iso::Patch& patch) {
    index::Box box{};
    for (std::size_t k = 0; k < patch.dimension; ++k) {
        if (patch.kind == PatchKind::square || patch.order == 1) {
            box.low[k] = box.high[k] = patch.nodes[0].at[k];
            for (std::size_t n = 1; n < patch.count; ++n) {
                box.low[k] = std::min(box.low[k], patch.nodes[n].at[k]);
                box.high[k] = std::max(box.high[k], patch.nodes[n].at[k]);
            }
            continue;
        }
        const double origin = patch.origin()[k];
        const std::vector<Real> y = coefficients_along(patch, k, origin);
        const std::vector<iso::PatchBasis::Term>& terms = iso::patch_basis(patch).terms;
        SquareOfDistance::Coefficients a{};
        Real size = 0, low = 0, high = 0;
        for (std::size_t t = 0; t < terms.size(); ++t) {
            a[terms[t].a][terms[t].b] = y[t];
            size += std::abs(y[t]);
        }
        const auto b = to_bernstein(a, patch.kind, static_cast<std::size_t>(patch.order));
        for (std::size_t i = 0; i <= static_cast<std::size_t>(patch.order); ++i) {
            for (std::size_t j = 0; i + j <= static_cast<std::size_t>(patch.order); ++j) {
                low = std::min(low, b[i][j]);
                high = std::max(high, b[i][j]);
            }
        }
        const Real room = 0x1p-40L * size;  // as of squares
        box.low[k] = std::nextafter(static_cast<double>(origin + (low - room)), -HUGE_VAL);
        box.high[k] = std::nextafter(static_cast<double>(origin + (high + room)), HUGE_VAL);
    }
    return box;
}

}  // namespace barycert::locate

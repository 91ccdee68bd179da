// How a critical point is found, proved, and enclosed; and told in rational numbers.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <optional>
#include <type_traits>

#include "core/base/vectors.hpp"
#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/near_patch.hpp"
#include "core/isoparametric/patch.hpp"
#include "core/isoparametric/small_matrix.hpp"

namespace barycert::core::isoparametric {
namespace {

using Square = std::array<std::array<double, 2>, 2>;

/// H in double.
Square second_derivatives(const PatchMap<double>& map, const PatchJet<double>& jet, const Params<double>& x) {
    const PatchPowers<double> powers(x, map.basis->degree);
    Square h{};
    for (std::size_t t = 1; t < map.basis->terms.size(); ++t) {
        const auto [a, b] = map.basis->terms[t];
        double along = 0;
        for (std::size_t k = 0; k < map.dimension; ++k) along += jet.at[k] * map.d[k][t];
        const auto power = [&](std::size_t v, int e) { return e < 0 ? 0 : powers.of[v][static_cast<std::size_t>(e)]; };
        h[0][0] += along * a * (a - 1) * power(0, a - 2) * power(1, b);
        h[0][1] += along * a * b * power(0, a - 1) * power(1, b - 1);
        h[1][1] += along * b * (b - 1) * power(0, a) * power(1, b - 2);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = i; j < 2; ++j) {
            for (std::size_t k = 0; k < map.dimension; ++k) h[i][j] += map.ratio * jet.by[i][k] * jet.by[j][k];
        }
    }
    h[1][0] = h[0][1];
    return h;
}

/// The inverse of as many rows and columns.
bool invert(const Square& h, std::size_t variables, Square& y) {
    y = {};
    if (variables == 1) {
        y[0][0] = 1 / h[0][0];
        return std::isfinite(y[0][0]) && y[0][0] != 0;
    }
    std::array<std::array<double, 4>, 2> rows{{{h[0][0], h[0][1], 1, 0}, {h[1][0], h[1][1], 0, 1}}};
    if (!eliminate(rows, 2)) return false;
    for (std::size_t i = 0; i < 2; ++i) y[i] = {rows[i][2], rows[i][3]};
    return true;
}

/// Taylor coefficients at a place, of u^a v^b.
constexpr std::size_t degrees = 2 * patch_degrees - 1;
using Series = std::array<std::array<Ball<double>, degrees>, degrees>;

/// x (of exponents below patch_degrees) times y, added.
void add_product(const Series& x, const Series& y, Series& to) {
    for (std::size_t a = 0; a < patch_degrees; ++a) {
        for (std::size_t b = 0; b < patch_degrees; ++b) {
            if (x[a][b].mid == 0 && x[a][b].radius == 0) continue;
            for (std::size_t c = 0; c < patch_degrees; ++c) {
                for (std::size_t d = 0; d < patch_degrees; ++d) {
                    if (y[c][d].mid != 0 || y[c][d].radius != 0)
                        to[a + c][b + d] = to[a + c][b + d] + x[a][b] * y[c][d];
                }
            }
        }
    }
}

Series derivative(const Series& x, std::size_t variable) {
    Series out{};
    for (std::size_t a = 0; a < degrees; ++a) {
        for (std::size_t b = 0; b < degrees; ++b) {
            const std::size_t e = variable == 0 ? a : b;
            if (e != 0 && (x[a][b].mid != 0 || x[a][b].radius != 0))
                (variable == 0 ? out[a - 1][b] : out[a][b - 1]) = x[a][b] * Ball<double>(static_cast<int>(e));
        }
    }
    return out;
}

/// The coefficients of d along an axis, moved from 0 to `to`.
Series shifted(const PatchMap<Ball<double>>& map, std::size_t axis, const Params<double>& to) {
    constexpr std::array<std::array<int, 5>, 5> choose{
        {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}}};
    const PatchPowers<Ball<double>> powers({Ball<double>(to[0]), Ball<double>(to[1])}, map.basis->degree);
    Series out{};
    for (std::size_t t = 1; t < map.basis->terms.size(); ++t) {
        const std::size_t a = map.basis->terms[t].a, b = map.basis->terms[t].b;
        for (std::size_t i = 0; i <= a; ++i) {
            for (std::size_t j = 0; j <= b; ++j)
                out[i][j] = out[i][j] + map.d[axis][t] * Ball<double>(choose[a][i] * choose[b][j]) *
                                            powers.of[0][a - i] * powers.of[1][b - j];
        }
    }
    return out;
}

/// Sets what Critical says of H, from `about` and `y`.
void bound_growth(const PatchMap<Ball<double>>& map, std::size_t variables, Critical& c) {
    std::array<Series, 2> g{};
    for (std::size_t k = 0; k < map.dimension; ++k) {
        const Series d = shifted(map, k, c.about);
        Series from = d;
        for (auto& row : from) {
            for (Ball<double>& x : row) {
                if (x.mid != 0 || x.radius != 0) x = map.ratio * x;
            }
        }
        from[0][0] = from[0][0] + map.away[k];
        for (std::size_t v = 0; v < variables; ++v) add_product(from, derivative(d, v), g[v]);
    }
    std::array<std::array<Series, 2>, 2> h;
    for (std::size_t i = 0; i < variables; ++i) {
        for (std::size_t j = 0; j < variables; ++j) h[i][j] = derivative(g[i], j);
    }
    c.most_slope = 0;
    for (std::size_t i = 0; i < variables; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < variables; ++j) {
            Ball<double> at(i == j ? 1 : 0);
            for (std::size_t l = 0; l < variables; ++l) at = at - Ball<double>(c.y[i][l]) * h[l][j][0][0];
            std::array<double, degrees>& growth = c.growth[i][j];
            growth = {at.most()};
            for (std::size_t l = 0; l < variables; ++l) {
                for (std::size_t a = 0; a < degrees; ++a) {
                    for (std::size_t b = a == 0 ? 1 : 0; a + b < degrees; ++b)
                        growth[a + b] += std::abs(c.y[i][l]) * h[l][j][a][b].most() * (1 + 0x1p-40);
                }
            }
            // Within 2^-20 of it no higher term is more than all of them.
            for (std::size_t a = 0; a < degrees; ++a) {
                for (std::size_t b = 0; a + b < degrees; ++b)
                    row += h[i][j][a][b].most() * (a + b == 0 ? 1 : 0x1p-20) * (1 + 0x1p-40);
            }
        }
        c.most_slope = std::max(c.most_slope, row);
    }
}

}  // namespace

double Critical::contraction(double radius, std::size_t variables) const {
    double most = 0;
    for (std::size_t i = 0; i < variables; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < variables; ++j) {
            double power = 1;
            for (const double one : growth[i][j]) {
                sum += one * power;
                power *= radius;
            }
        }
        most = std::max(most, sum * (1 + 0x1p-40));
    }
    return most;
}

NearPatch::NearPatch(const Patch& patch, const double* point)
    : patch_(&patch), point_(point), units_(patch_units(patch, point)) {}

template <class T>
const NearPatch::Map<T>& NearPatch::map() {
    const auto made = [&](auto& kept) -> const Map<T>& {
        if (!kept) kept = std::make_shared<const Map<T>>(*patch_, point_, units_);
        return *kept;
    };
    if constexpr (std::is_same_v<T, TwoDoubles>)
        return made(doubles_);
    else if constexpr (std::is_same_v<T, Wide<300>>)
        return made(wide_);
    else
        return made(wider_);
}

std::optional<Critical> NearPatch::critical(const Params<double>& from) const {
    const PatchMap<double> map(*patch_, point_, units_);
    Critical c{.about = from};
    double last = HUGE_VAL;
    bool found = false;
    for (int step = 0; step < 30 && !found; ++step) {
        const PatchJet<double> jet(map, c.about, variables());
        if (!invert(second_derivatives(map, jet, c.about), variables(), c.y)) return std::nullopt;
        double moved = 0;
        for (std::size_t i = 0; i < variables(); ++i) {
            double by = 0;
            for (std::size_t j = 0; j < variables(); ++j) by += c.y[i][j] * jet.slope(j);
            by = std::clamp(by, -0.5, 0.5);
            c.about[i] -= by;
            if (!(std::abs(c.about[i]) < 4)) return std::nullopt;
            moved = std::max(moved, std::abs(by));
        }
        found = moved < 0x1p-40 || (moved < 0x1p-20 && moved >= last / 2);
        last = moved;
    }
    if (!found) return std::nullopt;
    bound_growth(PatchMap<Ball<double>>(*patch_, point_, units_), variables(), c);
    for (c.unique = 1; c.unique > 0x1p-30 && !(c.contraction(c.unique, variables()) < 0.5);) c.unique /= 2;
    if (!(c.unique > 0x1p-30)) return std::nullopt;
    NearPatch one(*patch_, point_);
    Enclosed<TwoDoubles> at;
    if (!one.enclose<TwoDoubles>(c, 0x1p-60, at)) return std::nullopt;
    return c;
}

template <class T>
bool NearPatch::enclose(const Critical& c, double goal, Enclosed<T>& out) {
    const Map<T>& map = this->map<T>();
    const std::size_t variables = this->variables();
    Params<Ball<T>> at{Ball<T>(T(c.about[0])), Ball<T>(T(c.about[1]))};
    double box = 0, m = 0, radius = 0;
    for (int step = 0; step < 100; ++step) {
        const PatchJet<Ball<T>> jet(map, at, variables);
        std::array<Ball<T>, 2> g, correction;
        double most = 0;
        for (std::size_t j = 0; j < variables; ++j) g[j] = jet.slope(j);
        for (std::size_t i = 0; i < variables; ++i) {
            correction[i] = Ball<T>(0);
            for (std::size_t j = 0; j < variables; ++j) correction[i] = correction[i] + Ball<T>(T(c.y[i][j])) * g[j];
            most = std::max(most, correction[i].most());
        }
        if (step == 0) {
            box = 4 * most + 0x1p-45;
            m = c.contraction(box, variables);
            if (!(m < 0.25 && box <= c.unique)) return false;
        }
        // Within the box of the first step, as in inverse.hpp.
        if (step > 0 && !(most < box / 8)) return false;
        const double before = radius;
        radius = 2 * most * m;
        for (std::size_t i = 0; i < variables; ++i) {
            at[i] = at[i] - correction[i];
            radius = std::max(radius, 2 * most * m + at[i].radius);
        }
        radius *= 1 + 0x1p-40;
        for (std::size_t i = 0; i < variables; ++i) at[i].radius = 0;
        out.middle = out.x = at;
        out.radius = radius;
        for (std::size_t i = 0; i < variables; ++i) out.x[i].radius = radius;
        if (radius < goal || (step > 1 && !(radius < before / 2))) return true;
    }
    return true;
}

template <class T>
NearPatch::Enclosed<T> NearPatch::enclosed() {
    Enclosed<T> out;
    out.x = out.middle = {Ball<T>(T(taken_.about[0])), Ball<T>(T(taken_.about[1]))};
    constexpr double goal = std::is_same_v<T, TwoDoubles>  ? 0x1p-88
                            : std::is_same_v<T, Wide<300>> ? 0x1p-250
                                                           : 0x1p-940;
    // It was proved when it was found, in fewer bits: a step that fails leaves a wider box.
    if (is_critical_ && !enclose<T>(taken_, goal, out)) {
        out.radius = taken_.unique;
        for (std::size_t i = 0; i < variables(); ++i) out.x[i].radius = out.radius;
    }
    return out;
}

// In rational numbers.

std::optional<Params<Rational>> NearPatch::solve_linear(const PatchMap<Rational>& map) const {
    for (std::size_t t = 1; t < map.basis->terms.size(); ++t) {
        if (map.basis->terms[t].a + map.basis->terms[t].b < 2) continue;
        for (std::size_t k = 0; k < map.dimension; ++k) {
            if (map.d[k][t] != 0) return std::nullopt;
        }
    }
    // G = (away + e x).e = 0
    const PatchJet<Rational> jet(map, {Rational(0), Rational(0)}, variables());
    std::array<std::array<Rational, 3>, 2> rows;
    for (std::size_t i = 0; i < variables(); ++i) {
        for (std::size_t j = 0; j < variables(); ++j) rows[i][j] = base::dot(jet.by[i], jet.by[j]);
        rows[i][variables()] = -base::dot(jet.at, jet.by[i]);
    }
    if (!eliminate(rows, variables())) return std::nullopt;
    Params<Rational> x{Rational(0), Rational(0)};
    for (std::size_t i = 0; i < variables(); ++i) x[i] = rows[i][variables()];
    return x;
}

const std::optional<Params<Rational>>& NearPatch::exactly() {
    if (exact_) return *exact_;
    rational_ = std::make_shared<const PatchMap<Rational>>(*patch_, point_, units_);
    std::optional<Params<Rational>>& x = exact_.emplace();
    if (!is_critical_) return x = Params<Rational>{Rational(taken_.about[0]), Rational(taken_.about[1])};
    if ((x = solve_linear(*rational_))) return x;
    const Enclosed<TwoDoubles> at = enclosed<TwoDoubles>();
    x = Params<Rational>{Rational(0), Rational(0)};
    for (std::size_t i = 0; i < variables(); ++i) {
        const double about = at.x[i].mid.high, near = std::nearbyint(about * 0x1p30) * 0x1p-30;
        if (std::abs(near - about) > 0x1p-60) return x = std::nullopt;
        (*x)[i] = Rational(near);
    }
    const PatchJet<Rational> jet(*rational_, *x, variables());
    for (std::size_t i = 0; i < variables(); ++i) {
        if (jet.slope(i) != 0) return x = std::nullopt;
    }
    return x;
}

template const NearPatch::Map<TwoDoubles>& NearPatch::map<TwoDoubles>();
template const NearPatch::Map<Wide<300>>& NearPatch::map<Wide<300>>();
template const NearPatch::Map<Wide<1200>>& NearPatch::map<Wide<1200>>();
template NearPatch::Enclosed<TwoDoubles> NearPatch::enclosed<TwoDoubles>();
template NearPatch::Enclosed<Wide<300>> NearPatch::enclosed<Wide<300>>();
template NearPatch::Enclosed<Wide<1200>> NearPatch::enclosed<Wide<1200>>();

}  // namespace barycert::core::isoparametric

#include "barycert/core/isoparametric/near_patch.hpp"

#include "barycert/base/finite.hpp"
#include "barycert/base/vectors.hpp"
#include "barycert/core/isoparametric/component.hpp"

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

/// Of d along an axis, from its coefficients at 0.
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

// What is told.

bool NearPatch::inside() {
    if (variables() == 0 || !is_critical_) return true;
    const bool square = patch_->kind == PatchKind::square;
    const auto judge = [&]<class N>(const Params<N>& x, const auto& sign_of) {
        std::optional<int> least = 1;
        const auto add = [&](const N& y) {
            const std::optional<int> own = sign_of(y);
            if (least != -1 && (!own || *own <= 0)) least = own;
        };
        N rest(1);
        for (std::size_t i = 0; i < variables(); ++i) {
            add(x[i]);
            rest = rest - x[i];
            if (square) add(N(N(1) - x[i]));
        }
        if (!square) add(rest);
        return least;
    };
    const auto of_ball = [](const auto& b) { return b.sign(); };
    if (const auto known = judge(enclosed<TwoDoubles>().x, of_ball)) return *known > 0;
    if (exactly()) return *judge(**exact_, [](const Rational& r) { return std::optional(r.sign()); }) > 0;
    const auto known = judge(enclosed<Wide<300>>().x, of_ball);
    return known && *known > 0;
}

template <class T>
std::optional<int> NearPatch::sign_of_difference(NearPatch& other) {
    const Map<T>&a = map<T>(), &b = other.map<T>();
    const PatchJet<Ball<T>> x(a, enclosed<T>().x, 0), y(b, other.enclosed<T>().x, 0);
    const double *from = patch_->origin(), *to = other.patch_->origin();
    int extent = std::min(units_.extent, other.units_.extent);
    double most = 0;
    for (std::size_t k = 0; k < patch_->dimension; ++k) most = std::max(most, std::abs(from[k] / 2 - to[k] / 2));
    if (most > 0) extent = std::min(extent, -exponent_above(most) - 1);
    const int away = std::min(units_.away, other.units_.away);
    Ball<T> sum(0);
    for (std::size_t k = 0; k < patch_->dimension; ++k) {
        const Ball<T> between = Made<Ball<T>>::times(Made<Ball<T>>::difference(from[k], to[k], extent), patch_scale) +
                                x.d[k] * Made<Ball<T>>::power(extent - units_.extent) -
                                y.d[k] * Made<Ball<T>>::power(extent - other.units_.extent);
        sum = sum + between * (x.at[k] * Made<Ball<T>>::power(away - units_.away) +
                               y.at[k] * Made<Ball<T>>::power(away - other.units_.away));
    }
    return sum.sign();
}

int NearPatch::compare(NearPatch& other) {
    if (const auto sign = sign_of_difference<TwoDoubles>(other)) return *sign;
    if (exactly() && other.exactly()) {
        const PatchJet<Rational> x(*rational_, **exact_, 0), y(*other.rational_, **other.exact_, 0);
        return Rational(base::dot(x.at, x.at) - base::dot(y.at, y.at)).sign();
    }
    return sign_of_difference<Wide<300>>(other).value_or(0);
}

template <class T>
Ball<T> NearPatch::square() {
    const Enclosed<T> at = enclosed<T>();
    const PatchJet<Ball<T>> jet(map<T>(), at.middle, 0);
    Ball<T> sum = base::dot(jet.at, jet.at);
    // The square has twice the derivatives of its half; two variables may both be off.
    const double ratio = map<T>().ratio.most();
    sum.radius = (sum.radius + 4 * ratio * taken_.most_slope * at.radius * at.radius) * (1 + 0x1p-40);
    return sum;
}

bool NearPatch::round_quickly(RoundedDistance& out) {
    const Ball<TwoDoubles> s = square<TwoDoubles>();
    const double part = s.radius / s.mid.high;
    if (!(s.mid.high > 0x1p-600 && part < 0x1p-50)) return false;
    // root^2 + rest = s; what a step of Newton's leaves is below the square of the correction, 2^-104 of the root.
    const double root = std::sqrt(s.mid.high);
    const double rest = (s.mid - TwoDoubles::product(root, root)).high / (2 * root);
    const double q = root / patch_scale, left = std::fma(-q, patch_scale, root) + rest;
    const TwoDoubles d = TwoDoubles::sum(q, left / patch_scale);
    const double off = d.high * (part + 0x1p-95);
    if (d.high + (d.low - off) != d.high || d.high + (d.low + off) != d.high) return false;
    out.value = std::ldexp(d.high, -units_.away);
    return std::isfinite(out.value) && out.value >= 0x1p-1021;
}

template <unsigned bits>
bool NearPatch::round_distance(RoundedDistance& out) {
    using N = Wide<bits>;
    const Ball<N> s = square<N>();
    const auto end = [&](double by, double grow) {
        const N x = s.mid + N(by) * N(1 + 0x1p-40);
        if (!(x > 0)) return 0.0;
        return rounded(Rational(ldexp(N(sqrt(x) / N(patch_scale) * (N(1) + N(grow))), -units_.away)));
    };
    const double low = end(-s.radius, -0x1p-280), high = end(s.radius, 0x1p-280);
    out = {end(0, 0), high - low};
    return low == high;
}

RoundedDistance NearPatch::distance() {
    RoundedDistance out;
    if (round_quickly(out) || round_distance<300>(out)) return out;
    if (!exactly()) {
        round_distance<1200>(out);
        return out;
    }
    // It is amid two doubles, or zero, or so near to one of them that more bits tell.
    const PatchJet<Rational> jet(*rational_, **exact_, 0);
    const Rational square = base::dot(jet.at, jet.at) / Rational(patch_scale * patch_scale);
    for (const double neighbour : {std::nextafter(out.value, -HUGE_VAL), std::nextafter(out.value, HUGE_VAL)}) {
        if (!std::isfinite(neighbour) || !std::isfinite(out.value)) continue;
        const Rational middle = (Rational(out.value) + Rational(neighbour)) / 2;
        if (square == middle * middle) return {rounded(middle), 0};
    }
    if (square == 0) return {};
    round_distance<1200>(out);
    return out;
}

std::array<double, 3> NearPatch::place() {
    const PatchJet<Ball<TwoDoubles>> jet(map<TwoDoubles>(), enclosed<TwoDoubles>().middle, 0);
    std::array<double, 3> out{};
    const double* const origin = patch_->origin();
    for (std::size_t k = 0; k < patch_->dimension; ++k) {
        const TwoDoubles& d = jet.d[k].mid;
        const double q = d.high / patch_scale, left = (std::fma(-q, patch_scale, d.high) + d.low) / patch_scale;
        const TwoDoubles by = TwoDoubles::sum(std::ldexp(q, -units_.extent), std::ldexp(left, -units_.extent));
        out[k] = (TwoDoubles(origin[k]) + by).high;
    }
    return out;
}

template <class T>
void NearPatch::shapes(const Params<T>& x, std::array<T, max_nodes>& n) const {
    const PatchBasis& basis = patch_basis(*patch_);
    const PatchPowers<T> powers(x, basis.degree);
    for (std::size_t i = 0; i < patch_->count; ++i) n[i] = T(0);
    for (std::size_t t = 0; t < basis.terms.size(); ++t) {
        const T one = powers.at(basis.terms[t]);
        for (std::size_t i = 0; i < patch_->count; ++i) {
            const double factor = basis.row(patch_->nodes[i])[t];
            if (factor != 0) n[i] = n[i] + Made<T>::times(one, factor);
        }
    }
}

std::uint64_t NearPatch::active_nodes() {
    std::uint64_t active = ~std::uint64_t{0};
    if (!exactly()) return active;
    std::array<Rational, max_nodes> n;
    shapes(**exact_, n);
    for (std::size_t i = 0; i < patch_->count; ++i) {
        if (n[i] == 0) active &= ~(std::uint64_t{1} << i);
    }
    return active;
}

Evaluated NearPatch::evaluate(const double* values, std::size_t components, double* out) {
    std::vector<Component> all(components);
    std::vector<std::uint8_t> open(components, 0);
    const std::uint64_t active =
        base::all_finite({values, components * patch_->count}) ? ~std::uint64_t{0} : active_nodes();
    if (!scale_components(patch_->count, active, values, all, open, out))
        return {Certainty::proved, Tier::double_double};
    std::array<Ball<TwoDoubles>, max_nodes> n;
    shapes(enclosed<TwoDoubles>().x, n);
    bool left = false;
    for (std::size_t c = 0; c < components; ++c) {
        if (open[c] == 0) continue;
        const auto value = value_of(sum_of(patch_->count, patch_scale, n, all[c]), all[c].exponent);
        if (value) out[c] = *value + 0.0;
        open[c] = value ? 0 : 1;
        left = left || !value;
    }
    if (!left) return {Certainty::proved, Tier::double_double};
    Evaluated result{Certainty::proved, Tier::exact};
    if (exactly()) {
        std::array<Rational, max_nodes> exact;
        shapes(**exact_, exact);
        for (std::size_t c = 0; c < components; ++c) {
            if (open[c] == 0) continue;
            Rational sum = 0;
            for (std::size_t i = 0; i < patch_->count; ++i) {
                if ((active >> i & 1U) != 0) sum += exact[i] * Rational(values[components * i + c]);
            }
            out[c] = rounded(sum / patch_scale);
        }
        return result;
    }
    const auto widely = [&]<unsigned bits>(std::integral_constant<unsigned, bits>) {
        std::array<Ball<Wide<bits>>, max_nodes> wide;
        shapes(enclosed<Wide<bits>>().x, wide);
        for (std::size_t c = 0; c < components; ++c) {
            if (open[c] == 0) continue;
            const auto value =
                value_of(sum_of(patch_->count, patch_scale, wide, all[c]), all[c].exponent, &out[c], &all[c].off);
            if (value) out[c] = *value + 0.0;
            open[c] = value ? 0 : 1;
        }
    };
    widely(std::integral_constant<unsigned, 300>());
    if (std::ranges::count(open, 1) != 0) widely(std::integral_constant<unsigned, 1200>());
    for (std::size_t c = 0; c < components; ++c) {
        if (open[c] == 0) continue;
        result.certainty = Certainty::undecided;
        result.off = std::max(result.off, all[c].off);
    }
    return result;
}

}  // namespace barycert::core::isoparametric

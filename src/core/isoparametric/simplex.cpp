// Curved simplices: their Bernstein coefficients, and the sign of the Jacobian.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/bernstein.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/places.hpp"
#include "core/isoparametric/simplex_basis.hpp"
#include "core/isoparametric/small_matrix.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {
namespace {

using Index = std::array<std::uint8_t, 4>;

int sum_of(const Index& i) {
    return i[0] + i[1] + i[2] + i[3];
}

int multinomial(const Index& i) {
    constexpr std::array<int, 13> factorial{1, 1, 2, 6, 24, 120, 720, 5040, 40320, 362880};
    int n = factorial[static_cast<std::size_t>(sum_of(i))];
    for (const std::uint8_t k : i) n /= factorial[k];
    return n;
}

ToBernstein to_bernstein(const Reference& of) {
    const std::size_t n = of.nodes;
    std::vector<std::vector<Rational>> a(n, std::vector<Rational>(2 * n));
    for (std::size_t node = 0; node < n; ++node) {
        for (std::size_t j = 0; j < n; ++j) {
            Rational value = multinomial(of.indices[j]);
            for (std::size_t c = 0; c < 4; ++c) {
                for (int k = 0; k < of.indices[j][c]; ++k) value *= Rational(of.indices[node][c]) / of.order;
            }
            a[node][j] = value;
        }
        a[node][n + node] = 1;
    }
    eliminate(a, n);
    boost::multiprecision::cpp_int common = 1;
    for (const auto& row : a) {
        for (const Rational& x : row) common = lcm(common, boost::multiprecision::cpp_int(denominator(x)));
    }
    ToBernstein out;
    out.denominator = common.convert_to<double>();
    for (std::size_t i = 0; i < n; ++i) {
        auto& row = out.rows.emplace_back();
        for (std::size_t j = 0; j < n; ++j) row.push_back(Rational(a[i][n + j] * common).convert_to<double>());
    }
    return out;
}

/// The multi-index below each of `above` that has one, and of each the places of those above it.
SimplexBasis::Level level_below(std::vector<Index>& above, std::size_t corners) {
    SimplexBasis::Level level;
    std::vector<Index> indices;
    for (const Index& index : above) {
        Index lower = index;
        if (lower[0] == 0) continue;
        --lower[0];
        std::array<std::uint8_t, 4> raised{};
        for (std::size_t c = 0; c < corners; ++c) {
            Index own = lower;
            ++own[c];
            raised[c] = static_cast<std::uint8_t>(std::ranges::find(above, own) - above.begin());
        }
        indices.push_back(lower);
        level.push_back(raised);
    }
    above = std::move(indices);
    return level;
}

SimplexBasis basis_of(const Reference& reference) {
    SimplexBasis s{reference, to_bernstein(reference), {}, {}};
    const auto place = [&](const Index& index) {
        return static_cast<std::size_t>(std::ranges::find(reference.indices, index) - reference.indices.begin());
    };
    for (const Index& index : reference.indices) {
        if (index[0] == 0) continue;
        SimplexBasis::Slope slope{index, place(index), {}};
        --slope.index[0];
        for (std::size_t k = 0; k < reference.dimension(); ++k) {
            Index raised = slope.index;
            ++raised[k + 1];
            slope.by[k] = place(raised);
        }
        s.slopes.push_back(slope);
    }
    std::vector<Index> above = reference.indices;
    for (int degree = reference.order - 1; degree >= 0; --degree)
        s.levels.push_back(level_below(above, reference.dimension() + 1));
    return s;
}

const std::vector<SimplexBasis>& simplices() {
    static const std::vector<SimplexBasis> all = [] {
        std::vector<SimplexBasis> made;
        for (const Reference& reference : simplex_references()) made.push_back(basis_of(reference));
        return made;
    }();
    return all;
}

/// Control points times the denominator, of nodes at place(node, axis).
template <class N, class Place>
std::vector<Vector<N>> control_points(const SimplexBasis& s, const Place& place) {
    const std::size_t d = s.reference.dimension(), n = s.reference.nodes;
    std::vector<Vector<N>> points(n, Vector<N>{N(0), N(0), N(0)});
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double factor = s.bernstein.rows[i][j];
            if (factor == 0) continue;
            for (std::size_t k = 0; k < d; ++k) points[i][k] = points[i][k] + N(factor) * place(j, k);
        }
    }
    return points;
}

/// Bernstein coefficients of the Jacobian, times one positive number. It is a sum over a coefficient of each
/// derivative; those whose indices have one sum make a coefficient of its own.
template <class N, class Place>
std::vector<N> jacobian_coefficients(const SimplexBasis& s, const Place& place) {
    const std::vector<Vector<N>> points = control_points<N>(s, place);
    const std::size_t d = s.reference.dimension(), m = s.slopes.size();
    std::array<std::vector<Vector<N>>, 3> v;
    for (std::size_t k = 0; k < d; ++k) {
        for (const auto& slope : s.slopes) {
            auto& own = v[k].emplace_back();
            for (std::size_t j = 0; j < 3; ++j) own[j] = points[slope.by[k]][j] - points[slope.base][j];
        }
    }
    if (d == 2) v[2].push_back({N(0), N(0), N(1)});
    const BernsteinBasis& basis = jacobian_basis(s.reference);
    std::vector<N> sums(basis.size(), N(0));
    for (std::size_t a = 0; a < m; ++a) {
        for (std::size_t b = 0; b < m; ++b) {
            const Vector<N> cross = base::cross(v[0][a], v[1][b]);
            for (std::size_t c = 0; c < v[2].size(); ++c) {
                const Index &i = s.slopes[a].index, &j = s.slopes[b].index;
                BernsteinBasis::Index sum{};
                int weight = multinomial(i) * multinomial(j);
                for (std::size_t k = 0; k < 4; ++k) sum[k] = static_cast<std::uint8_t>(i[k] + j[k]);
                if (d == 3) {
                    const Index& l = s.slopes[c].index;
                    weight *= multinomial(l);
                    for (std::size_t k = 0; k < 4; ++k) sum[k] = static_cast<std::uint8_t>(sum[k] + l[k]);
                }
                N& own = sums[basis.place(sum)];
                own = own + N(weight) * base::dot(cross, v[2][c]);
            }
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sums[i] * N(basis.factorials(i));
    return sums;
}

double middle(const Places& places, std::size_t node, std::size_t k, double scale) {
    const double x = places.at[node][k] * scale;
    return places.other[node] == nullptr ? x : x / 2 + places.other[node][k] * scale / 2;
}

}  // namespace

const SimplexBasis& simplex_of(const Reference& of) {
    return *std::ranges::find_if(simplices(), [&](const SimplexBasis& s) { return &s.reference == &of; });
}

std::vector<Vector<double>> rounded_control_points(const SimplexBasis& s, const Places& places, double scale) {
    auto points =
        control_points<double>(s, [&](std::size_t node, std::size_t k) { return middle(places, node, k, scale); });
    for (auto& p : points) {
        for (double& x : p) x /= s.bernstein.denominator;
    }
    return points;
}

JacobianSign simplex_jacobian_sign(const Reference& of, const Places& places, int bisections) {
    const SimplexBasis& s = simplex_of(of);
    const double scale = scale_of(of, places);
    using B = Ball<double>;
    const auto near = [&](std::size_t node, std::size_t k) {
        if (places.other[node] == nullptr) return B(places.at[node][k] * scale);
        return B(places.at[node][k] * scale / 2) + B(places.other[node][k] * scale / 2);
    };
    if (const auto sign = sign_by_bisection(of, jacobian_coefficients<B>(s, near), &B::sign, bisections)) return *sign;
    const WholePlaces place(of, places);
    return *sign_by_bisection(
        of, jacobian_coefficients<Whole>(s, place), [](const Whole& x) { return std::optional(x.sign()); }, bisections);
}

std::array<double, 6> hull_box(const Reference& of, const Places& places) {
    const double scale = scale_of(of, places);
    std::array<double, 6> box{};
    const auto points = rounded_control_points(simplex_of(of), places, scale);
    for (std::size_t k = 0; k < of.dimension(); ++k) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto& p : points) {
            low = std::min(low, p[k]);
            high = std::max(high, p[k]);
        }
        box[k] = (low - control_error) / scale;
        box[3 + k] = (high + control_error) / scale;
    }
    return box;
}

}  // namespace barycert::core::isoparametric

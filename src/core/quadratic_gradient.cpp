#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include "barycert/environment.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/blocks.hpp"
#include "core/exact_tier.hpp"
#include "core/integer.hpp"
#include "core/lanes.hpp"
#include "core/numerators-inl.hpp"
#include "core/scaled_double.hpp"

namespace barycert::core {
namespace {

namespace formulas = HWY_NAMESPACE;

// sum_i N_ik sum_m n_m c_mi over D det: a minor of differences of 2099 bits (integer.hpp) has 2 * 2099 + 1, N_ik one or
// two more; n_m has 3 * 2099 + 3, c_mi 2098 + 3, and there are four of each.
static_assert(64 * (Integer::capacity - 2) >= (2 * 2099 + 3) + (3 * 2099 + 3) + (2098 + 3) + 4);

/// The gradient of the quadratic sum_i l_i (2 l_i - 1) f_i + sum_ij 4 l_i l_j f_ij, in any arithmetic T.
///
/// It is sum_i b_i grad l_i with b_i the derivative by l_i: (4 l_i - 1) f_i + sum_{m != i} 4 l_m f_im. As sum_m l_m =
/// 1, that is sum_m l_m c_mi with c_ii = 3 f_i and c_mi = 4 f_im - f_i; so all terms are products of as many factors,
/// and l_m = n_m / D may be divided once in the end. grad l_i = N_i / det, where N_i are the cofactors of the edges v_j
/// - v_d, j < d, and N_d is less their sum.
template <Simplex s, class T>
struct QuadraticGradient {
    static constexpr int n = vertex_count(s), d = space_dimension(s);
    T numerator[d];     ///< of component k
    T denominators[2];  ///< D and det
};

/// `v`: vertices, then the point. `f`: values at corners, then at the middles of edges. `zero`: that of the arithmetic.
template <Simplex s, class T>
QuadraticGradient<s, T> quadratic_gradient_in(const T (&v)[vertex_count(s) + 1][space_dimension(s)], const T* f,
                                              const T& zero) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    formulas::Relative<s, T> relative;
    T e[d][d], normal[n][d];
    for (int k = 0; k < d; ++k) {
        for (int i = 0; i < n; ++i) relative.r[i][k] = v[i][k] - v[n][k];
        for (int j = 0; j < d; ++j) e[j][k] = v[j][k] - v[d][k];
    }
    formulas::Fractions<s, T> l;
    formulas::solve(relative, zero, l);
    QuadraticGradient<s, T> out;
    if constexpr (d == 2) {
        normal[0][0] = e[1][1];
        normal[0][1] = zero - e[1][0];
        normal[1][0] = zero - e[0][1];
        normal[1][1] = e[0][0];
        out.denominators[1] = formulas::cross(e[0], e[1]);
    } else {
        formulas::cross(e[1], e[2], normal[0]);
        formulas::cross(e[2], e[0], normal[1]);
        formulas::cross(e[0], e[1], normal[2]);
        out.denominators[1] = formulas::dot(e[0], normal[0]);
    }
    for (int k = 0; k < d; ++k) {
        normal[d][k] = zero;
        for (int j = 0; j < d; ++j) normal[d][k] = normal[d][k] - normal[j][k];
        out.numerator[k] = zero;
    }
    for (int i = 0; i < n; ++i) {
        T b = l.numerator[i] * (f[i] + f[i] + f[i]);
        for (int m = 0; m < n; ++m) {
            if (m == i) continue;
            const T& mid = f[n + quadratic_edge(std::min(i, m), std::max(i, m))];
            const T twice = mid + mid;
            b = b + l.numerator[m] * (twice + twice - f[i]);
        }
        for (int k = 0; k < d; ++k) out.numerator[k] = out.numerator[k] + normal[i][k] * b;
    }
    out.denominators[0] = l.denominator;
    return out;
}

template <Simplex s>
using Units = Unit[space_dimension(s) + 1];  // of each axis, and of the values

template <Simplex s>
QuadraticGradient<s, Integer> gradient_in_integers(const double* vertices, const double* point, const double* values,
                                                   Units<s>& units) {
    constexpr int n = vertex_count(s), d = space_dimension(s), nodes = n + mid_node_count(s);
    const auto coordinate = [&](int i, int k) { return i < n ? vertices[d * i + k] : point[k]; };
    Integer v[n + 1][d], f[nodes];
    for (int k = 0; k < d; ++k) {
        for (int i = 0; i <= n; ++i) units[k].add(coordinate(i, k));
        for (int i = 0; i <= n; ++i) v[i][k] = units[k].integer(coordinate(i, k));
    }
    for (int i = 0; i < nodes; ++i) units[d].add(values[i]);
    for (int i = 0; i < nodes; ++i) f[i] = units[d].integer(values[i]);
    return quadratic_gradient_in<s, Integer>(v, f, Integer());
}

template <Simplex s>
bool exact_quadratic_gradient(const double* vertices, const double* point, const double* values, double* out) {
    constexpr int d = space_dimension(s);
    Units<s> units;
    const auto g = gradient_in_integers<s>(vertices, point, values, units);
    const Integer denominator = g.denominators[0] * g.denominators[1];
    if (denominator.sign() == 0) return false;
    for (int k = 0; k < d; ++k) {
        // Each axis and the values have units of their own; all but those of the values and of axis k cancel.
        out[k] = round_quotient(g.numerator[k], denominator, units[d].exponent - units[k].exponent);
    }
    return true;
}

template <Simplex s>
void plain_quadratic_gradient(const double* vertices, const double* point, const double* values, double* out) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    double v[n + 1][d];
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k < d; ++k) v[i][k] = i < n ? vertices[d * i + k] : point[k];
    }
    const auto g = quadratic_gradient_in<s, double>(v, values, 0.0);
    for (int k = 0; k < d; ++k) out[k] = g.numerator[k] / g.denominators[0] / g.denominators[1];
}

/// Sets values that are not finite to zero, and `lost` in the components of the gradient in which one has a part: its
/// shape function does not have the derivative zero there. In a degenerate cell all are lost. Not inlined, for the sake
/// of the stack.
template <Simplex s>
[[gnu::noinline]] void leave_out_not_finite(const double* vertices, const double* point, std::span<double> values,
                                            bool (&lost)[3]) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i])) continue;
        values[i] = 0;
        double unit[vertex_count(s) + mid_node_count(s)] = {};
        unit[i] = 1;
        Units<s> units;
        const auto g = gradient_in_integers<s>(vertices, point, unit, units);
        const bool degenerate = g.denominators[1].sign() == 0;
        for (int k = 0; k < space_dimension(s); ++k) lost[k] = lost[k] || degenerate || g.numerator[k].sign() != 0;
    }
}

template <Simplex s>
Gradient quadratic_gradient_of(const double* vertices, const double* point, const double* values, Rounding rounding) {
    constexpr std::size_t d = space_dimension(s), nodes = vertex_count(s) + mid_node_count(s);
    Gradient g;
    g.tier = Tier::exact;
    std::array<double, nodes> f;
    std::copy_n(values, nodes, f.begin());
    bool lost[3] = {};
    leave_out_not_finite<s>(vertices, point, f, lost);
    if (rounding == Rounding::plain) {
        plain_quadratic_gradient<s>(vertices, point, f.data(), g.gradient.data());
    } else {
        g.degenerate = !exact_quadratic_gradient<s>(vertices, point, f.data(), g.gradient.data());
    }
    for (std::size_t k = 0; k < d; ++k) {
        if (lost[k] || g.degenerate) g.gradient[k] = nan;
    }
    return g;
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

Result<Gradient> quadratic_gradient(Simplex simplex, const double* vertices, const double* point, const double* values,
                                    Rounding rounding) {
    const ExactEnvironment environment;
    if (Status known = core::check_fills_space(simplex, "a gradient"); !known) return known.error();
    if (!core::all_finite(simplex, vertices, point)) return core::not_finite_error(simplex, vertices, point);
    return simplex == Simplex::triangle
               ? core::quadratic_gradient_of<Simplex::triangle>(vertices, point, values, rounding)
               : core::quadratic_gradient_of<Simplex::tetrahedron>(vertices, point, values, rounding);
}

}  // namespace barycert

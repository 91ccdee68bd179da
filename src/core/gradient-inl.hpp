// Internal: the middle tier of gradients: plain double and one step of iterative refinement, with a proven bound.
//
// Notation, as in refinement-inl.hpp. u = 2^-53, rounding to nearest; o the last vertex; E_j = v_j - o = e_j + t_j,
// e_j = fl(E_j), t_j exact by two_difference; X_k the extents of the e_j, all at least 2^-200; G their product;
// a_k = G / X_k; N_j the normals, with w = sum_j (w.N_j / D) E_j for every w, D = E_0.N_0; n_j, d the same as computed;
// K = G / |d|. delta_j = f_j - f_o, exact as the sum of two doubles. The gradient g is the one solution of
//   E_j.g = delta_j for all j,     that is     g = sum_j delta_j N_j / D.
// Take y = the plain double solution, as good or bad as it comes. With rho_j = delta_j - E_j.y exactly,
//   g = y + c,    c = sum_j rho_j N_j / D.
//
// Bounds, the triangle's being smaller than the tetrahedron's. As there,
//   |n_jk - N_jk| <= 9 u a_k,   |N_jk| <= 2.0001 a_k,   |d - D| <= 49 u G,
// so that for K <= 2^36 |D| >= |d| (1 - 2^-10): D is not zero, the cell is certified not to be degenerate.
//
// Residuals. S_j = |fl(delta_j)| + sum_k |e_jk y_k|. two_sum leaves 3 remainders of sums <= 1.001 u S_j each, the
// products remainders <= u S_j together, the low parts of delta_j and t_jk y_k are <= u S_j together: 10 numbers, which
// add up to at most 5.1 u S_j in magnitude; no one meets more than 9 additions: 46 u^2 S_j. The products t_jk y_k round
// by u^2 S_j. The last addition rounds by u |r_j|, r_j being rho_j as computed. So |r_j - rho_j| <= u |r_j| +
// 47 u^2 S_j.
//
// Corrections. With R = sum |r_j| and S = sum S_j,
//   |sum_j r_j n_jk as computed - sum_j r_j N_jk| <= 16 u a_k R      9 u from n_j; 3 roundings of at most 2.0001 a_k R
//   c_k as computed, then, is off from sum_j r_j N_jk / D by at most
//     u R a_k/|d| (16 + 98.1 K) 1.002 + 5 u R a_k/|d|                d for D; two roundings of a quotient
//   and that from c_k by at most 2.003 a_k/|d| (u R + 47 u^2 S).
// Together u R a_k/|d| (98.3 K + 24) + 94.2 u^2 S a_k/|d|, which a_k/|d| (u R (100 K + 30) + 100 u^2 S) exceeds by more
// than the roundings of its own evaluation and of R and S (below 1 + 20 u).
//
// Ranges; outside them nothing is certain. Extents at least 2^-200 and G <= 2^500, hence extents <= 2^900, a_k <=
// 2^700 and >= 2^-400, 2^-636 <= |d| <= 2^503, 1/|d| normal; |y_k| <= 2^900; 2^-500 <= S <= 2^900, or S = 0: then all
// delta_j are zero, and so are y, c and the bound, as they should be. Each operation may underflow by at most 2^-1074,
// a product's remainder by 2^-1070:
//   in n_jk against u a_k >= 2^-453;
//   in r_j against u^2 S >= 2^-606, for 12 operations;
//   in the sum of r_j n_jk against a_k u^2 S >= 2^-1006, which is why the bound for S is no smaller;
//   in the last product and in the evaluation of the bound against the bound itself, which must be at least 2^-960.
// In each case that is less than 2^-50 of what the constants above leave. Overflow of y, r or the bound ends in NaN, or
// in a bound that is infinite; no product of an error-free transform is above 2^900, nor its factors above 2^901, so
// that Dekker's is as good as the fused one and the tiers are the same on all targets. A NaN or infinity among
// coordinates makes d NaN or G infinite; one among the values makes S NaN or infinite.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_GRADIENT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_GRADIENT_INL_HPP
#undef BARYCERT_CORE_GRADIENT_INL_HPP
#else
#define BARYCERT_CORE_GRADIENT_INL_HPP
#endif

#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

/// The terms that the gradients of all components share.
template <int d, class D>
struct CellMatrix {
    using V = hn::Vec<D>;
    V edge[d][d], edge_low[d][d];  ///< E_j = edge + edge_low
    V normal[d][d];
    V inverse;          ///< 1 / d
    V reach[d];         ///< a_k / |d|
    V residual_factor;  ///< u (100 K + 30)
    hn::Mask<D> valid;  ///< not degenerate, and the ranges of the cell hold
};

template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE CellMatrix<d, D> cell_matrix(D tag, const V (&v)[d + 1][d]) {
    constexpr double u = 0x1p-53;
    const auto constant = [&](double x) { return hn::Set(tag, x); };
    CellMatrix<d, D> m;
    for (int j = 0; j < d; ++j) {
        for (int k = 0; k < d; ++k) {
            const TwoTerms<V> e = two_difference(v[j][k], v[d][k]);
            m.edge[j][k] = e.high;
            m.edge_low[j][k] = e.low;
        }
    }
    normals(m.edge, m.normal);
    m.inverse = constant(1) / dot(m.edge[0], m.normal[0]);
    const V scale = hn::Abs(m.inverse);
    V x[d];
    extents(m.edge, x);
    across(x, m.reach);
    const V volume = x[0] * m.reach[0];
    V min_extent = x[0];
    for (int k = 1; k < d; ++k) min_extent = hn::Min(min_extent, x[k]);
    for (int k = 0; k < d; ++k) m.reach[k] = m.reach[k] * scale;
    const V condition = volume * scale;
    m.residual_factor = constant(100 * u) * condition + constant(30 * u);
    m.valid = hn::And(hn::And(hn::Ge(min_extent, constant(0x1p-200)), hn::Le(volume, constant(0x1p500))),
                      hn::Le(condition, constant(0x1p36)));
    return m;
}

/// Component k of sum_j w_j n_j / d.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE V sum_over_edges(const CellMatrix<d, D>& m, const V (&w)[d], int k) {
    V sum = w[0] * m.normal[0][k];
    for (int j = 1; j < d; ++j) sum = sum + w[j] * m.normal[j][k];
    return sum * m.inverse;
}

/// Gradients as double + correction.
template <int d, class D>
struct RefinedGradient {
    using V = hn::Vec<D>;
    V plain[d], correction[d];  ///< y and c
    V error[d];                 ///< of plain + correction
    hn::Mask<D> valid;          ///< the ranges of values and results hold
};

/// The gradient of the linear field f. Where the cell is not valid nothing is said.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE RefinedGradient<d, D> refined_gradient(D tag, const CellMatrix<d, D>& m, const V (&f)[d + 1]) {
    constexpr double u = 0x1p-53;
    const auto constant = [&](double x) { return hn::Set(tag, x); };
    RefinedGradient<d, D> g;
    V delta[d], delta_low[d], residual[d];
    for (int j = 0; j < d; ++j) {
        const TwoTerms<V> t = two_difference(f[j], f[d]);
        delta[j] = t.high;
        delta_low[j] = t.low;
    }
    for (int k = 0; k < d; ++k) g.plain[k] = sum_over_edges(m, delta, k);

    V size = hn::Zero(tag), rest = hn::Zero(tag);  // S and R
    for (int j = 0; j < d; ++j) {
        Accumulator<V> r{delta[j], delta_low[j], hn::Zero(tag)};
        size = size + hn::Abs(delta[j]);
        for (int k = 0; k < d; ++k) {
            r.subtract_product(m.edge[j][k], g.plain[k]);
            r.product_rest = r.product_rest - m.edge_low[j][k] * g.plain[k];
            size = size + hn::Abs(m.edge[j][k] * g.plain[k]);
        }
        residual[j] = r.sum + (r.sum_rest + r.product_rest);
        rest = rest + hn::Abs(residual[j]);
    }

    const V bound = m.residual_factor * rest + constant(100 * u * u) * size;
    const auto constant_field = hn::Eq(size, hn::Zero(tag));
    g.valid = hn::Or(constant_field, within(tag, size, 0x1p-500, 0x1p900));
    for (int k = 0; k < d; ++k) {
        g.correction[k] = sum_over_edges(m, residual, k);
        g.error[k] = m.reach[k] * bound;
        g.valid = hn::And(g.valid, hn::And(hn::Le(hn::Abs(g.plain[k]), constant(0x1p900)),
                                           hn::Or(constant_field, hn::Ge(g.error[k], constant(0x1p-960)))));
    }
    return g;
}

/// The gradient of the linear field f, each component correctly rounded; `certain` is cleared where it may not be.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void gradient_of(D tag, const CellMatrix<d, D>& m, const V (&f)[d + 1], V (&out)[d], hn::Mask<D>& certain) {
    const RefinedGradient<d, D> g = refined_gradient<d>(tag, m, f);
    certain = hn::And(certain, g.valid);
    for (int k = 0; k < d; ++k)  // + 0: an exact zero is positive
        out[k] = rounded_sum(tag, g.plain[k], g.correction[k], g.error[k], certain) + hn::Zero(tag);
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

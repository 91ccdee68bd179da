// Internal: the middle tier. Weights as double + correction, with a bound on the error of the correction; and from them
// correctly rounded weights and values.
//
// u = 2^-53, rounding to nearest. The idea, for simplices that fill their space, is one step of iterative refinement:
// take weights l_i from plain double arithmetic, as good or bad as they come; compute what they leave over,
//   s = 1 - sum l_i,   r = p - sum l_i v_i,
// nearly exactly by error-free transforms; the exact weights are l_i + c_i, where the c_i solve the same equations for
// (r, s). The c_i are small, so plain double arithmetic is good enough for them.
//
// Notation. o: the last vertex. E_i = v_i - o, e_i = fl(E_i); X, Y, Z: extents of the e_i; G = X Y Z; a_x = Y Z,
// a_y = X Z, a_z = X Y (triangle: G = X Y, a_x = Y, a_y = X); B(w) = sum |w_k| a_k. N_i: the normals with
// w = sum_i (w.N_i / D) E_i for every w (tetrahedron: N_0 = E_1 x E_2 and cyclic; triangle: E_1 and E_0 turned);
// D = E_0.N_0; n_i, d: the same as computed. L = sum |l_i|, V_k >= |o_k| + extent + |p_k - o_k| >= |v_ik|, |p_k|.
// Then r' = r - s o = sum over all but the last of c_i E_i, and c_last = s - sum of the others.
//
// Bounds, the triangle's being smaller than the tetrahedron's:
//   |n_k - N_k| <= 9 u a_k        2 terms, 4 roundings: 8 u (1 + ...)
//   |d - D| <= 49 u G             6 terms, 8 roundings
//   |fl(w.n_i) - w.N_i| <= 16 u B(w)    9 u B from n; 3 roundings of |w.n_i| <= 2.0001 B(w): 6.1 u B
// Let k = G / |d|. If k <= 2^36, |D| >= |d|(1 - 2^-10), so D is not zero: the cell is certified not to be degenerate.
// And
//   |fl(w.n_i) / d - w.N_i / D| <= u B(w)/|d| * (98.1 k + 16) * 1.002, plus 2 roundings of the quotient: 5 u B(w)/|d|.
// Residuals. The sums below run through two_sum, so all that is lost is the rounding of sums of remainders:
//   |s| <= 3.1 u (1 + L), its error <= 6 u^2 (1 + L);
//   every component of r' is off by <= 80 u^2 (1 + L) V_k, and by u |r'_k| from its last rounding:
//     four remainders of sums <= 4 u (1 + L) V_k, those of products <= u L V_k, |s o_k| <= 3.1 u (1 + L) V_k; nine
//     numbers, 8 sums: 66 u^2; the product s o_k and the error of s: 9.1 u^2.
// Together, b = B(r')/|d|:
//   |c_i - its computed value| <= u b (98.3 k + 24) + 164 u^2 (1 + L) B(V)/|d|    all but the last
// and for the last at most 3 times that, plus 3 u (|s| + 6.1 b) + 6 u^2 (1 + L). As B(V)/|d| >= 3 k >= 1/2 (|d| <= 4.01
// G; triangle: 2 k, |d| <= 2.01 G), four times eta_0 = u b (100 k + 50) + 172 u^2 (1 + L) B(V)/|d| bounds every error.
// The larger constants also cover the roundings of eta itself (below 1 + 20 u), and leave more than 100 u b for the sum
// in `value` below.
//
// Simplices that are projected on (p need not be in their hull, so r is not small) take numerators and denominator
// in double-double instead: each monomial meets 17 u^2 (segment: one product, two sums, 9 + 4 + 4) or 43 u^2
// (triangle3d: 13 in each cross, 9 + 8 in the dot). With P and Q of filter-inl.hpp the errors are 18 u^2 P and 18 u^2 D
// for the segment (all terms of D are positive), 44 u^2 P and 44 u^2 Q for triangle3d. l_i = fl(n_i.high / d.high); c_i
// = (n_i - l_i d) / d.high, where the leading subtraction is exact (Sterbenz) and the rest rounds by at most 24 u^2
// |l_i|. So |error| <= 1.01 (E_n + |l_i| E_d) / |d| + 25 u^2 |l_i|, if E_d <= 2^-10 |d|.
//
// Ranges; outside them nothing is certain:
//   extents at least 2^-200, G <= 2^500, hence extents at most 2^900; L <= 2^100; k <= 2^36, and >= 1/8, which it
//   always is (|d| <= 4.01 G) unless d overflowed. So 2^-636 <= |d|, and 1/|d| is a normal number. Underflow loses at
//   most 2^-1070 per operation: in n_k against u a_k >= 2^-453; in r'_k times a_k/|d| = k / extent; in a dot product
//   times 1/|d|; the last two below 2^-430 against eta >= u^2/2 (B(V)/|d| >= 1/2). Overflow: of d makes k zero or NaN,
//   of n_i makes L infinite or NaN, any later one makes the error infinite or NaN. |o_k|, |p_k - o_k| <= 2^900: with
//   the extents, no product reaches 2^1003, and Dekker's is as good as the fused one, so that tiers are the same on all
//   targets. Projected: as in filter-inl.hpp; P >= D/4. Nodal values: the largest magnitude F in [2^-800, 2^900] or
//   zero.
// A NaN anywhere ends in a comparison that is false.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_REFINEMENT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_REFINEMENT_INL_HPP
#undef BARYCERT_CORE_REFINEMENT_INL_HPP
#else
#define BARYCERT_CORE_REFINEMENT_INL_HPP
#endif

#include <limits>

#include "core/error_free-inl.hpp"
#include "core/filter-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

/// Absolute coordinates of one lane's cases.
template <Simplex s, class V>
struct Absolute {
    V v[vertex_count(s)][space_dimension(s)];
    V p[space_dimension(s)];
};

/// Loads coordinates of the cases from `at` on.
template <Simplex s, class D>
HWY_INLINE Absolute<s, hn::Vec<D>> load_absolute(D tag, const double* const* vertices, const double* const* point,
                                                 std::size_t at) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    Absolute<s, hn::Vec<D>> c;
    for (int k = 0; k < d; ++k) {
        c.p[k] = hn::LoadU(tag, point[k] + at);
        for (int i = 0; i < n; ++i) c.v[i][k] = hn::LoadU(tag, vertices[d * i + k] + at);
    }
    return c;
}

template <Simplex s, class D>
struct Refined {
    using V = hn::Vec<D>;
    V weight[vertex_count(s)], correction[vertex_count(s)];
    V error;            ///< of every weight + correction
    V magnitude;        ///< 1 + sum of |weight|
    hn::Mask<D> valid;  ///< not degenerate, and the ranges hold
};

/// The sum of numbers, exact up to the rounding of the sum of the remainders. These are added up in two chains: waiting
/// for results, not their number, bounds the speed here.
template <class V>
struct Accumulator {
    V sum, sum_rest, product_rest;

    HWY_INLINE void add(V x) {
        const TwoTerms<V> t = two_sum(sum, x);
        sum = t.high;
        sum_rest = sum_rest + t.low;
    }
    HWY_INLINE void add_product(V x, V y) {
        const TwoTerms<V> p = two_product(x, y);
        add(p.high);
        product_rest = product_rest + p.low;
    }
    HWY_INLINE void subtract_product(V x, V y) {
        const TwoTerms<V> p = two_product(x, y), t = two_difference(sum, p.high);
        sum = t.high;
        sum_rest = sum_rest + t.low;
        product_rest = product_rest - p.low;
    }
};

/// The normals N_i, with w.N_i / D the weights of a vector w with respect to the edges e_i.
template <class V>
HWY_INLINE void normals(const V (&e)[3][3], V (&n)[3][3]) {
    for (int i = 0; i < 3; ++i) cross(e[(i + 1) % 3], e[(i + 2) % 3], n[i]);
}
template <class V>
HWY_INLINE void normals(const V (&e)[2][2], V (&n)[2][2]) {
    n[0][0] = e[1][1];
    n[0][1] = hn::Neg(e[1][0]);
    n[1][0] = hn::Neg(e[0][1]);
    n[1][1] = e[0][0];
}

/// a_k: the extents x on the other axes, multiplied.
template <int d, class V>
HWY_INLINE void across(const V (&x)[d], V (&a)[d]) {
    if constexpr (d == 3) {
        a[0] = x[1] * x[2];
        a[1] = x[0] * x[2];
        a[2] = x[0] * x[1];
    } else {
        a[0] = x[1];
        a[1] = x[0];
    }
}

/// For tetrahedron and triangle.
template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE Refined<s, D> refine(D tag, const Absolute<s, V>& c) {
    constexpr int n = vertex_count(s), d = space_dimension(s), last = n - 1;
    constexpr double u = 0x1p-53;
    const auto constant = [&](double x) { return hn::Set(tag, x); };
    Refined<s, D> out;

    V e[last][d], q[d], normal[last][d], x[d];
    for (int k = 0; k < d; ++k) {
        for (int i = 0; i < last; ++i) e[i][k] = c.v[i][k] - c.v[last][k];
        q[k] = c.p[k] - c.v[last][k];
    }
    normals(e, normal);
    const V inverse = constant(1) / dot(e[0], normal[0]);
    for (int i = 0; i < last; ++i) out.weight[i] = dot(q, normal[i]) * inverse;

    // The last weight is what the others leave of 1, and s what rounding leaves of that.
    Accumulator<V> others{out.weight[0], hn::Zero(tag), hn::Zero(tag)};
    for (int i = 1; i < last; ++i) others.add(out.weight[i]);
    const TwoTerms<V> final_weight = two_difference(constant(1), others.sum);
    out.weight[last] = final_weight.high;
    const V residual_sum = final_weight.low - others.sum_rest;

    V residual[d], magnitude[d];  // r' and V
    for (int k = 0; k < d; ++k) {
        Accumulator<V> r{c.p[k], hn::Zero(tag), hn::Zero(tag)};
        for (int i = 0; i < n; ++i) r.subtract_product(out.weight[i], c.v[i][k]);
        residual[k] = r.sum + (r.sum_rest + (r.product_rest - residual_sum * c.v[last][k]));
    }
    V correction_sum = hn::Zero(tag);
    for (int i = 0; i < last; ++i) {
        out.correction[i] = dot(residual, normal[i]) * inverse;
        correction_sum = i == 0 ? out.correction[i] : correction_sum + out.correction[i];
    }
    out.correction[last] = residual_sum - correction_sum;

    extents(e, x);
    V a[d];
    across(x, a);
    const V g = x[0] * a[0];
    for (int k = 0; k < d; ++k) {
        magnitude[k] = max_magnitude(c.v[last][k], q[k]);
        residual[k] = hn::Abs(residual[k]);
    }
    out.magnitude = constant(1);
    for (int i = 0; i < n; ++i) out.magnitude = out.magnitude + hn::Abs(out.weight[i]);
    const V scale = hn::Abs(inverse), k = g * scale;
    const V from_residual = constant(4 * u) * dot(residual, a) * (constant(100) * k + constant(50));
    // V_k = 2 max(|o_k|, |p_k - o_k|) + extent, and sum of a_k * extent = 3 G (triangle: 2 G).
    const V size = constant(2) * dot(magnitude, a) + constant(3) * g;
    const V from_rounding = constant(4 * 172 * u * u) * out.magnitude * size;
    out.error = scale * (from_residual + from_rounding);
    V max_size = magnitude[0];
    for (int j = 1; j < d; ++j) max_size = hn::Max(max_size, magnitude[j]);
    V min_extent = x[0];
    for (int j = 1; j < d; ++j) min_extent = hn::Min(min_extent, x[j]);
    const auto sizes = hn::And(hn::Ge(min_extent, constant(0x1p-200)), hn::Le(max_size, constant(0x1p900)));
    const auto values = hn::And(hn::Le(g, constant(0x1p500)), hn::Le(out.magnitude, constant(0x1p100)));
    out.valid = hn::And(sizes, hn::And(within(tag, k, 0.125, 0x1p36), values));
    return out;
}

/// For segment and triangle3d.
template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE Refined<s, D> refine_projected(D tag, const Absolute<s, V>& c) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    constexpr double u = 0x1p-53;
    const auto constant = [&](double x) { return hn::Set(tag, x); };
    using Number = DoubleDouble<V>;
    Refined<s, D> out;

    Relative<s, Number> exact;
    Relative<s, V> rounded;
    for (int k = 0; k < d; ++k) {
        for (int i = 0; i < n; ++i) {
            exact.r[i][k] = two_difference(c.v[i][k], c.p[k]);
            rounded.r[i][k] = exact.r[i][k].high;
            if (i > 0) {
                exact.e[i - 1][k] = two_difference(c.v[i][k], c.v[0][k]);
                rounded.e[i - 1][k] = exact.e[i - 1][k].high;
            }
        }
    }
    Fractions<s, Number> f;
    solve(exact, Number{hn::Zero(tag), hn::Zero(tag)}, f);
    const V inverse = constant(1) / f.denominator.high;
    out.magnitude = constant(1);
    V max_weight = hn::Zero(tag);
    for (int i = 0; i < n; ++i) {
        const V w = f.numerator[i].high / f.denominator.high;
        const TwoTerms<V> p = two_product(w, f.denominator.high);
        const V rest = ((f.numerator[i].high - p.high) - p.low) + (f.numerator[i].low - w * f.denominator.low);
        out.weight[i] = w;
        out.correction[i] = rest * inverse;
        out.magnitude = out.magnitude + hn::Abs(w);
        max_weight = hn::Max(max_weight, hn::Abs(w));
    }
    // The filter's bounds are (terms) * e * P: its factors 5.5 e and 46 e are replaced by 18 u^2 and 44 u^2.
    const Bounds<D> bound = filter_bounds<s>(tag, rounded);
    constexpr double from_filter =
        s == Simplex::segment ? 18 * u * u / (5.5 * filter_epsilon) : 44 * u * u / (11.5 * filter_epsilon);
    const V numerator_error = constant(from_filter) * bound.numerator;
    const V denominator_error =
        s == Simplex::segment ? constant(18 * u * u) * f.denominator.high : constant(from_filter) * bound.denominator;
    out.error = constant(1.02) * (numerator_error + max_weight * denominator_error) * hn::Abs(inverse) +
                constant(26 * u * u) * max_weight;
    out.valid = hn::And(hn::And(bound.valid, hn::Le(out.magnitude, constant(0x1p100))),
                        hn::Le(denominator_error, constant(0x1p-10) * f.denominator.high));
    return out;
}

/// Returns the double to which both x + (y - error) and x + (y + error) round: rounding is monotonic, so every number
/// between them rounds to it. Clears `certain` where they round to different doubles.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V rounded_if_certain(V x, V y, V error, hn::Mask<D>& certain) {
    const V low = x + (y - error), high = x + (y + error);
    certain = hn::And(certain, hn::Eq(low, high));
    return low;
}

/// The same of all numbers that are off by at most `error` from x + y. y -+ error rounds by u (|y| + error): added to
/// the error as 2 u |y|, and as 2^-40 of itself.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V rounded_sum(D tag, V x, V y, V error, hn::Mask<D>& certain) {
    return rounded_if_certain<D>(x, y, hn::Set(tag, 1 + 0x1p-40) * error + hn::Set(tag, 0x1p-52) * hn::Abs(y), certain);
}

/// Weight i correctly rounded, where certain.
template <Simplex s, class D>
HWY_INLINE hn::Vec<D> weight(D tag, const Refined<s, D>& r, int i, hn::Mask<D>& certain) {
    return rounded_sum(tag, r.weight[i], r.correction[i], r.error, certain);
}

/// sum of weight i times value i correctly rounded, where certain.
///
/// With l_i + c_i the refined weights, F the largest |f_i| and L as above: sum l_i f_i is split into its rounding h and
/// remainders of sums (three, each <= 1.01 u L F) and of products (together <= 1.01 u L F), whose sum rounds by at most
/// 25 u^2 L F; sum c_i f_i is off by n eta F and rounds by 4 u F sum |c_i|; adding both, and adding the error in the
/// end, round by twice u (5 u L F + F sum |c_i|). That is n eta F + 6 u F sum |c_i| + 35 u^2 L F. Now sum |c_i| is at
/// most 12.1 b + 3.1 u (1 + L) (in the notation above), of which n eta covers the first part, 73 u b; or, projected,
/// 5.5 u L. The rest is below u^2 (35 + 33)(1 + L) F < 2^-98 (1 + L) F.
template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE V value(D tag, const Refined<s, D>& r, const V (&f)[vertex_count(s)], hn::Mask<D>& certain) {
    constexpr int n = vertex_count(s);
    TwoTerms<V> p = two_product(r.weight[0], f[0]);
    Accumulator<V> sum{p.high, hn::Zero(tag), p.low};
    V corrections = r.correction[0] * f[0];
    for (int i = 1; i < n; ++i) {
        sum.add_product(r.weight[i], f[i]);
        corrections = corrections + r.correction[i] * f[i];
    }
    V max_value = max_magnitude(f[0], f[1]);
    if constexpr (n == 3) max_value = hn::Max(max_value, hn::Abs(f[2]));
    if constexpr (n == 4) max_value = hn::Max(max_value, max_magnitude(f[2], f[3]));
    const V error = max_value * (hn::Set(tag, n) * r.error + hn::Set(tag, 0x1p-98) * r.magnitude);
    certain = hn::And(certain, hn::Or(hn::Eq(max_value, hn::Zero(tag)), within(tag, max_value, 0x1p-800, 0x1p900)));
    // + 0: an exact zero is positive, whatever the signs of the nodal values
    return rounded_if_certain<D>(sum.sum, (sum.sum_rest + sum.product_rest) + corrections, error, certain) +
           hn::Zero(tag);
}

/// The values of a case by refined weights: value(f) for the nodal values f of a component, clearing `certain` where it
/// is not.
template <Simplex s, class D, class V = hn::Vec<D>>
struct RefinedValues {
    static constexpr bool proved = true;
    Refined<s, D> r;

    HWY_INLINE RefinedValues(D tag, const Absolute<s, V>& c) {
        if constexpr (s == Simplex::tetrahedron || s == Simplex::triangle) {
            r = refine<s>(tag, c);
        } else {
            r = refine_projected<s>(tag, c);
        }
    }
    HWY_INLINE hn::Mask<D> certain() const { return r.valid; }
    HWY_INLINE V at(D tag, const V (&f)[vertex_count(s)], hn::Mask<D>& certain) const {
        return value<s>(tag, r, f, certain);
    }
};

/// The value of a linear field in plain double: the one formula of batches, points and grids, so that a value has the
/// same bits from each of them.
template <Simplex s, class D>
struct PlainWeights {
    using V = hn::Vec<D>;
    Fractions<s, V> f;
    V inverse;

    HWY_INLINE PlainWeights(D tag, const Relative<s, V>& relative) {
        solve(relative, hn::Zero(tag), f);
        inverse = hn::Set(tag, 1) / f.denominator;
    }

    /// nodal(i): the values at vertex i. There is one NaN: its sign and payload would tell in which order a compiler
    /// has the operands of a sum or product.
    template <class Nodal>
    HWY_INLINE V value(D tag, const Nodal& nodal) const {
        V sum = hn::Zero(tag);
        for (int i = 0; i < vertex_count(s); ++i) sum = sum + f.numerator[i] * nodal(i);
        const V value = sum * inverse;
        return hn::IfThenElse(hn::IsNaN(value), hn::Set(tag, std::numeric_limits<double>::quiet_NaN()), value);
    }
};

/// As RefinedValues, of plain weights: all are certain, whatever they are.
template <Simplex s, class D, class V = hn::Vec<D>>
struct PlainValues {
    static constexpr bool proved = false;
    PlainWeights<s, D> weights;

    HWY_INLINE PlainValues(D tag, const Absolute<s, V>& c) : weights(tag, relative(c)) {}
    static HWY_INLINE Relative<s, V> relative(const Absolute<s, V>& c) {
        Relative<s, V> out;
        for (int k = 0; k < space_dimension(s); ++k) {
            for (int i = 0; i < vertex_count(s); ++i) out.r[i][k] = c.v[i][k] - c.p[k];
            if constexpr (Relative<s, V>::projected) {
                for (int i = 1; i < vertex_count(s); ++i) out.e[i - 1][k] = c.v[i][k] - c.v[0][k];
            }
        }
        return out;
    }
    HWY_INLINE hn::Mask<D> certain() const { return hn::Eq(hn::Zero(D()), hn::Zero(D())); }
    HWY_INLINE V at(D tag, const V (&values)[vertex_count(s)], hn::Mask<D>&) const {
        return weights.value(tag, [&](int i) HWY_ATTR { return values[i]; });
    }
};

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

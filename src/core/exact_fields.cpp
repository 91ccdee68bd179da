// Gradients of linear fields, values of quadratic ones, and values in perspective, in integers.
#include <algorithm>
#include <cmath>

#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/exact_tier.hpp"
#include "core/integer.hpp"
#include "core/lanes.hpp"
#include "core/numerators-inl.hpp"
#include "core/scaled_double.hpp"

namespace barycert::core {
namespace {

namespace formulas = HWY_NAMESPACE;

template <class Number, class Divisor>
double rounded(const Number& number, const Divisor& divisor, int exponent) {
    return round_quotient(as_integer(number), as_integer(divisor), exponent);
}

/// Cramer's rule: component k is the determinant of the edges with column k replaced by the values, over that of the
/// edges.
///
/// Widths: coordinates and values below 2^(64 N - 3) in N limbs give differences below 2^(64 N - 2), 2x2 minors below
/// 2^(128 N - 3) and determinants below 3 * 2^(192 N - 5) < 2^(192 N - 3): no sum overflows. Integer: differences of
/// 2099 bits, three of them and 3 more, see integer.hpp.
template <int d>
bool exact_gradient_in(const double* vertices, const double* values, double* out) {
    const auto number = [&](int i, int k) { return k < d ? vertices[d * i + k] : values[i]; };
    return with_lattice<d + 1, d + 1>(number, false, [&]<class T>(const Lattice<d + 1, d + 1, T>& lattice) {
        T row[d][d + 1];  // edges from the last vertex, and behind each the difference of the values
        for (int j = 0; j < d; ++j) lattice.difference(j, d, row[j]);
        const auto determinant = [&](int replaced) {
            T m[d][d];
            for (int j = 0; j < d; ++j) {
                for (int k = 0; k < d; ++k) m[j][k] = row[j][k == replaced ? d : k];
            }
            return Integer(as_integer(formulas::determinant(m)));
        };
        const Integer whole = determinant(-1);
        if (whole.sign() == 0) return false;
        // Each axis and the values have units of their own; all but those of the values and of axis k cancel.
        for (int k = 0; k < d; ++k)
            out[k] = round_quotient(determinant(k), whole, lattice.units[d].exponent - lattice.units[k].exponent);
        return true;
    });
}

// Differences have 2099 bits (see integer.hpp), numerators three times as many and 3 more for 6 products. The sum below
// is one of squares and products of numerators with 4 values of 2098 bits and 6 of 6 times that: 40 in all, 6 bits.
static_assert(64 * (Integer::capacity - 2) >= 2 * (3 * 2099 + 3) + 2098 + 6);

/// sum_i n_i (sum_{j >= i} n_j b_ij) over the square of the denominator, with b_ii = f_i and b_ij = 4 f_ij - f_i - f_j:
/// the form of quadratic-inl.hpp, without its division.
///
/// Widths. Numerators in 3 N limbs are below 3 * 2^(192 N - 5) (exact_weights.cpp; triangle: 2 N limbs, 2^(128 N - 3)),
/// the denominator below their range; values below 2^(64 M - 4) in M limbs give b below 6 * 2^(64 M - 4). An inner sum
/// is below (1 + 3 * 6) * 3 * 2^(192 N + 64 M - 9) < 2^(192 N + 64 M - 3), the outer one below
/// (4 + 6 * 6) * 9 * 2^(384 N + 64 M - 14) < 2^(384 N + 64 M - 5); in the plane below 13 * 2^(128 N + 64 M - 7) and
/// 21 * 2^(256 N + 64 M - 10): no sum overflows.
template <Simplex s, class Number, int nodes, class T>
double value(const formulas::Fractions<s, Number>& w, const Lattice<nodes, 1, T>& values) {
    constexpr int n = vertex_count(s);
    const auto at = [&](int i) { return values.at(i, 0); };
    using Inner = decltype(w.numerator[0] * at(0));
    using Outer = decltype(w.numerator[0] * Inner());
    Outer sum{};
    for (int i = 0; i < n; ++i) {
        Inner inner = w.numerator[i] * at(i);
        for (int j = i + 1; j < n; ++j) {
            const T mid = at(n + quadratic_edge(i, j)), twice = mid + mid;
            inner = inner + w.numerator[j] * ((twice + twice) - (at(i) + at(j)));
        }
        sum = sum + w.numerator[i] * inner;
    }
    return rounded(sum, w.denominator * w.denominator, values.units[0].exponent - 1074);
}

/// The same numbers without a fixed width.
template <Simplex s, class Number>
formulas::Fractions<s, Integer> as_integers(const formulas::Fractions<s, Number>& w) {
    formulas::Fractions<s, Integer> out;
    for (int i = 0; i < vertex_count(s); ++i) out.numerator[i] = as_integer(w.numerator[i]);
    out.denominator = as_integer(w.denominator);
    return out;
}

/// All components, each in integers of the narrowest type that has room.
template <Simplex s, class Number>
bool values_of(const formulas::Fractions<s, Number>& w, const double* values, int components, double* out) {
    if (w.denominator.sign() == 0) return false;
    constexpr int nodes = vertex_count(s) + mid_node_count(s);
    for (int c = 0; c < components; ++c) {
        const auto number = [&](int i, int) { return values[nodes * c + i]; };
        out[c] = with_lattice<nodes, 1, 4>(number, false, [&]<class T>(const Lattice<nodes, 1, T>& f) {
            if constexpr (std::is_same_v<Number, Integer> || std::is_same_v<T, Integer>)
                return value(as_integers<s>(w), f.template in<Integer>());
            else
                return value(w, f);
        });
    }
    return true;
}

template <Simplex s>
bool exact_quadratic_on(const double* vertices, const double* point, const double* values, int components,
                        double* out) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    const auto number = [&](int i, int k) { return i < n ? vertices[d * i + k] : point[k]; };
    return with_lattice<n + 1, d>(number, false, [&]<class T>(const Lattice<n + 1, d, T>& lattice) {
        formulas::Relative<s, T> c;
        for (int i = 0; i < n; ++i) lattice.difference(i, n, c.r[i]);
        formulas::Fractions<s, T> w;
        formulas::solve(c, formulas::Numerator<s, T>{}, w);
        return values_of<s>(w, values, components, out);
    });
}

// In perspective.

using formulas::Product;

// Differences have 2099 bits (see integer.hpp), a numerator of the window's weights 2 * 2099 + 1 for two products; a
// depth 2098. The widest numbers are a numerator times two depths and a value, 3 of which are added up, and the
// triangle's area times three depths: 3 numerators of 4199 bits in 4201, and 3 * 2098.
static_assert(64 * (Integer::capacity - 2) >= 2 * 2099 + 1 + 3 * 2098 + 2);

/// The fractions of perspective-correct weights and depth. With n_i the numerators of the weights in the window (sum
/// d), multiplied by w_0 w_1 w_2:
///     beta_i = m_i / m,  m_i = n_i w_j w_k,  m = sum m_i,      Z = d w_0 w_1 w_2 / m.
/// The units of the axes cancel in all of them, the unit of the depths in beta_i, and Z is a multiple of it.
template <class T>
struct Projected {
    using Number = Product<Product<T>>;
    Number numerator[3], denominator;
    Product<Number, T> depth;  ///< the numerator of Z
};

/// Widths, with coordinates and depths below 2^(64 N - 3) in N limbs: numerators of the window are below
/// 2^(128 N - 3) in 2 N limbs (exact_weights.cpp), their sum d below 3 * 2^(128 N - 3) < 2^(128 N - 1), its range;
/// products of two depths are below 2^(128 N - 6), m_i below 2^(256 N - 9) in 4 N limbs, m below 3 times that; d times
/// three depths is below 2^(320 N - 10) in 5 N limbs: no sum overflows.
template <class T>
void project(const Lattice<4, 3, T>& lattice, Projected<T>& out) {
    formulas::Relative<Simplex::triangle, T> c;
    for (int k = 0; k < 2; ++k) {
        const T p = lattice.at(3, k);
        for (int i = 0; i < 3; ++i) c.r[i][k] = lattice.at(i, k) - p;
    }
    formulas::Fractions<Simplex::triangle, T> window;
    formulas::solve(c, Product<T>{}, window);
    T w[3];
    for (int i = 0; i < 3; ++i) w[i] = lattice.at(i, 2);
    for (int i = 0; i < 3; ++i) out.numerator[i] = window.numerator[i] * (w[(i + 1) % 3] * w[(i + 2) % 3]);
    out.denominator = out.numerator[0] + out.numerator[1] + out.numerator[2];
    out.depth = (window.denominator * (w[0] * w[1])) * w[2];
}

/// sum m_i f_i / m. Widths: values below 2^(64 M - 3) in M limbs give products below 2^(256 N + 64 M - 12) in
/// 4 N + M limbs.
template <class V, class Number>
double value(const Number (&numerator)[3], const Integer& denominator, const Lattice<3, 1, V>& values) {
    const auto product = [&](int i) { return numerator[i] * values.at(i, 0); };
    return rounded(product(0) + product(1) + product(2), denominator, values.units[0].exponent - 1074);
}

/// `components` values.
template <class T>
void values_of(const Projected<T>& p, const double* values, int components, double* out) {
    const auto whole = [&](int i) { return Integer(as_integer(p.numerator[i])); };
    for (int c = 0; c < components; ++c) {
        const auto given = [&](int i) { return values[components * i + c]; };
        bool finite = true;
        for (int i = 0; i < 3; ++i) finite = finite && (std::isfinite(given(i)) || p.numerator[i].sign() == 0);
        const auto number = [&](int i, int) { return std::isfinite(given(i)) ? given(i) : 0; };
        out[c] = with_lattice<3, 1>(number, false, [&]<class V>(const Lattice<3, 1, V>& f) {
            if (!finite) return nan;
            if constexpr (std::is_same_v<T, Integer> || !std::is_same_v<V, Fixed<1>>)
                return value({whole(0), whole(1), whole(2)}, as_integer(p.denominator), f.template in<Integer>());
            else
                return value(p.numerator, as_integer(p.denominator), f);
        });
    }
}

}  // namespace

bool exact_gradient(Simplex simplex, const double* vertices, const double* values, double* out) {
    const bool proper = simplex == Simplex::triangle ? exact_gradient_in<2>(vertices, values, out)
                                                     : exact_gradient_in<3>(vertices, values, out);
    if (!proper) std::fill_n(out, space_dimension(simplex), nan);
    return proper;
}

bool exact_quadratic(Simplex simplex, const double* vertices, const double* point, const double* values, int components,
                     double* out) {
    return simplex == Simplex::triangle
               ? exact_quadratic_on<Simplex::triangle>(vertices, point, values, components, out)
               : exact_quadratic_on<Simplex::tetrahedron>(vertices, point, values, components, out);
}

bool exact_perspective(PerspectiveAnswer what, const double* vertices, const double* point, const double* values,
                       int components, double* out) {
    // Depths are the third axis, on which the point is at that of the first vertex, for want of one.
    const auto number = [&](int i, int k) { return i < 3 ? vertices[3 * i + k] : k < 2 ? point[k] : vertices[k]; };
    return with_lattice<4, 3>(number, false, [&]<class T>(const Lattice<4, 3, T>& lattice) {
        Projected<T> p;
        project(lattice, p);
        // The depths' product is zero exactly if the area is: no depth is.
        if (p.depth.sign() == 0 || p.denominator.sign() == 0) return false;
        if (what == PerspectiveAnswer::values) {
            values_of(p, values, components, out);
        } else if (what == PerspectiveAnswer::depth) {
            out[0] = rounded(p.depth, p.denominator, lattice.units[2].exponent - 1074);
        } else {
            for (int i = 0; i < 3; ++i) out[i] = rounded(p.numerator[i], p.denominator, 0);
        }
        return true;
    });
}

}  // namespace barycert::core

#include "barycert/core/exact_tier.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "barycert/core/fixed_integer.hpp"
#include "barycert/core/integer.hpp"
#include "barycert/core/numerators-inl.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"

namespace barycert::core {
namespace {

namespace formulas = HWY_NAMESPACE;
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

struct Parts {
    ScaledDouble at[4][2], depth[3];  ///< vertices and point
    Unit axis[2], depths;

    Parts(const double* vertices, const double* point) {
        for (int i = 0; i < 4; ++i) {
            const double* const from = i < 3 ? vertices + 3 * i : point;
            for (int k = 0; k < 2; ++k) {
                at[i][k] = scaled(from[k]);
                axis[k].add(at[i][k]);
            }
        }
        for (int i = 0; i < 3; ++i) {
            depth[i] = scaled(vertices[3 * i + 2]);
            depths.add(depth[i]);
        }
    }
};

/// Widths, with coordinates and depths below 2^(64 N - 3) in N limbs: numerators of the window are below
/// 2^(128 N - 3) in 2 N limbs (exact_weights.cpp), their sum d below 3 * 2^(128 N - 3) < 2^(128 N - 1), its range;
/// products of two depths are below 2^(128 N - 6), m_i below 2^(256 N - 9) in 4 N limbs, m below 3 times that; d times
/// three depths is below 2^(320 N - 10) in 5 N limbs: no sum overflows.
template <class T>
void project(const Parts& parts, Projected<T>& out) {
    formulas::Relative<Simplex::triangle, T> c;
    for (int k = 0; k < 2; ++k) {
        const T p = parts.axis[k].multiple<T>(parts.at[3][k]);
        for (int i = 0; i < 3; ++i) c.r[i][k] = parts.axis[k].multiple<T>(parts.at[i][k]) - p;
    }
    formulas::Fractions<Simplex::triangle, T> window;
    formulas::solve(c, Product<T>{}, window);
    T w[3];
    for (int i = 0; i < 3; ++i) w[i] = parts.depths.multiple<T>(parts.depth[i]);
    for (int i = 0; i < 3; ++i) out.numerator[i] = window.numerator[i] * (w[(i + 1) % 3] * w[(i + 2) % 3]);
    out.denominator = out.numerator[0] + out.numerator[1] + out.numerator[2];
    out.depth = (window.denominator * (w[0] * w[1])) * w[2];
}

/// use(projected) if there are weights. The depths' product is zero exactly if the area is: no depth is.
template <class Use>
bool with_projected(const Parts& parts, Use use) {
    const int bits = std::max(max_bits(parts.axis), parts.depths.bits());
    return with_integers<3>(bits, [&]<class T>() {
        Projected<T> p;
        project(parts, p);
        if (as_integer(p.depth).sign() == 0 || as_integer(p.denominator).sign() == 0) return false;
        use(p);
        return true;
    });
}

template <class Number, class Divisor>
double rounded(const Number& number, const Divisor& divisor, int exponent) {
    return round_quotient(as_integer(number), as_integer(divisor), exponent);
}

/// sum m_i f_i / m. Widths: values below 2^(64 M - 3) in M limbs give products below 2^(256 N + 64 M - 12) in
/// 4 N + M limbs.
template <class V, class Number>
double value(const Number (&numerator)[3], const Integer& denominator, const ScaledDouble* parts, const Unit& unit) {
    const auto product = [&](int i) { return numerator[i] * unit.multiple<V>(parts[i]); };
    return rounded(product(0) + product(1) + product(2), denominator, unit.exponent - 1074);
}

/// `components` values.
template <class T>
void values_of(const Projected<T>& p, const double* values, int components, double* out) {
    for (int c = 0; c < components; ++c) {
        ScaledDouble parts[3];
        Unit unit;
        bool finite = true;
        for (int i = 0; i < 3; ++i) {
            double f = values[components * i + c];
            if (!std::isfinite(f)) {
                finite = finite && as_integer(p.numerator[i]).sign() == 0;
                f = 0;
            }
            parts[i] = scaled(f);
            unit.add(parts[i]);
        }
        const auto whole = [&](int i) { return Integer(as_integer(p.numerator[i])); };
        if (!finite) {
            out[c] = nan;
        } else if (std::is_same_v<T, Integer> || unit.bits() > 64 - 3) {
            out[c] = value<Integer>({whole(0), whole(1), whole(2)}, as_integer(p.denominator), parts, unit);
        } else if constexpr (!std::is_same_v<T, Integer>) {
            out[c] = value<Fixed<1>>(p.numerator, as_integer(p.denominator), parts, unit);
        }
    }
}

}  // namespace

bool exact_perspective(PerspectiveAnswer what, const double* vertices, const double* point, const double* values,
                       int components, double* out) {
    const Parts parts(vertices, point);
    return with_projected(parts, [&](const auto& p) {
        if (what == PerspectiveAnswer::values) return values_of(p, values, components, out);
        if (what == PerspectiveAnswer::depth) {
            out[0] = rounded(p.depth, p.denominator, parts.depths.exponent - 1074);
            return;
        }
        for (int i = 0; i < 3; ++i) out[i] = rounded(p.numerator[i], p.denominator, 0);
    });
}

}  // namespace barycert::core

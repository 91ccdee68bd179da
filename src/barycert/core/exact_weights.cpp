#include "barycert/core/exact_weights.hpp"

#include <algorithm>

#include "barycert/core/fixed_integer.hpp"
#include "barycert/core/numerators-inl.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"

namespace barycert {
namespace {

namespace formulas = HWY_NAMESPACE;

/// The coordinates of `count` points as integers of type T, each axis in its own unit, a power of two, or all in one.
template <int count, int d, class T>
struct Lattice {
    T at[count][d];
    bool fits = true;  ///< otherwise T is too narrow, and `at` is not to be used

    Lattice(const double* const (&points)[count], bool common) {
        int largest[d];
        for (int k = 0; k < d; ++k) {
            largest[k] = 0;
            for (int i = 0; i < count; ++i) largest[k] = std::max(largest[k], biased_exponent(points[i][k]));
        }
        if (common) std::fill_n(largest, d, *std::max_element(largest, largest + d));
        for (int k = 0; k < d; ++k) {
            std::uint64_t lost = 0;
            for (int i = 0; i < count; ++i) at[i][k] = aligned<T>(points[i][k], largest[k], lost);
            fits = fits && lost == 0;
        }
    }

    /// Point i less point j. Inline, for GCC 12 folds the copies of different `count` into one and then warns of it.
    HWY_INLINE void difference(int i, int j, T (&out)[d]) const {
        for (int k = 0; k < d; ++k) out[k] = at[i][k] - at[j][k];
    }
};

/// Calls `decide` with the points as integers of the narrowest type that holds them. Coordinates below 2^(64 N - 3) in
/// N limbs give differences below 2^(64 N - 2), and with these
///   a 2x2 minor is below 2 * 2^(128 N - 4)                in 2 N limbs, range 2^(128 N - 1),
///   a numerator of degree 3 below 3 * 2^(64 N - 2) * that in 3 N limbs: 3 * 2^(192 N - 5),
///   four of them below 2^(192 N - 1), their range,
///   a numerator of degree 4 below 3 * (minor)^2           in 4 N limbs: 3 * 2^(256 N - 6),
/// so that no sum overflows.
template <int count, int d, class Decide>
auto with_integers(const double* const (&points)[count], bool common, Decide decide) {
    if (const Lattice<count, d, Fixed<1>> narrow(points, common); narrow.fits) return decide(narrow);
    if (const Lattice<count, d, Fixed<2>> wider(points, common); wider.fits) return decide(wider);
    return decide(Lattice<count, d, Integer>(points, common));
}

template <Simplex s>
void solve_exactly(const double* vertices, const double* point, Integer* numerators, Integer& denominator) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    constexpr bool projected = s == Simplex::segment || s == Simplex::triangle3d;
    const double* points[n + 1];
    for (int i = 0; i < n; ++i) points[i] = vertices + d * i;
    points[n] = point;
    with_integers<n + 1, d>(points, projected, [&]<class T>(const Lattice<n + 1, d, T>& lattice) {
        formulas::Relative<s, T> c;
        for (int i = 0; i < n; ++i) lattice.difference(i, n, c.r[i]);
        if constexpr (projected) {
            for (int i = 1; i < n; ++i) lattice.difference(i, 0, c.e[i - 1]);
        }
        formulas::Fractions<s, T> solution;
        formulas::solve(c, formulas::Numerator<s, T>{}, solution);
        for (int i = 0; i < n; ++i) numerators[i] = to_integer(solution.numerator[i]);
        denominator = to_integer(solution.denominator);
    });
}

}  // namespace

ExactWeights::ExactWeights(Simplex simplex, const double* vertices, const double* point)
    : count_(vertex_count(simplex)) {
    switch (simplex) {
        case Simplex::segment:
            solve_exactly<Simplex::segment>(vertices, point, numerators_, denominator_);
            break;
        case Simplex::triangle:
            solve_exactly<Simplex::triangle>(vertices, point, numerators_, denominator_);
            break;
        case Simplex::triangle3d:
            solve_exactly<Simplex::triangle3d>(vertices, point, numerators_, denominator_);
            break;
        case Simplex::tetrahedron:
            solve_exactly<Simplex::tetrahedron>(vertices, point, numerators_, denominator_);
            break;
    }
}

double ExactWeights::weight(int i) const {
    return round_quotient(numerators_[i], denominator_, 0);
}

double ExactWeights::interpolate(std::span<const double> values) const {
    ScaledDouble parts[4];
    int unit = INT_MAX;
    for (int i = 0; i < count_; ++i) {
        parts[i] = scaled(values[static_cast<std::size_t>(i)]);
        unit = std::min(unit, parts[i].exponent);
    }
    Integer sum;
    for (int i = 0; i < count_; ++i) sum = sum + numerators_[i] * integer(parts[i], unit);
    return sum.sign() == 0 ? 0.0 : round_quotient(sum, denominator_, unit);
}

int exact_orient2d(const double* a, const double* b, const double* c) {
    return with_integers<3, 2>({a, b, c}, false, []<class T>(const Lattice<3, 2, T>& lattice) {
        T ab[2], ac[2];
        lattice.difference(1, 0, ab);
        lattice.difference(2, 0, ac);
        return to_integer(formulas::cross(ab, ac)).sign();
    });
}

int exact_orient3d(const double* a, const double* b, const double* c, const double* d) {
    return with_integers<4, 3>({a, b, c, d}, false, []<class T>(const Lattice<4, 3, T>& lattice) {
        T ab[3], ac[3], ad[3];
        formulas::Product<T> m[3];
        lattice.difference(1, 0, ab);
        lattice.difference(2, 0, ac);
        lattice.difference(3, 0, ad);
        formulas::cross(ac, ad, m);
        return to_integer(formulas::dot(ab, m)).sign();
    });
}

double exact_dot(const double* x, const double* y, int count) {
    ScaledDouble px[5], py[5];
    int unit_x = INT_MAX, unit_y = INT_MAX;
    for (int i = 0; i < count; ++i) {
        px[i] = scaled(x[i]);
        py[i] = scaled(y[i]);
        unit_x = std::min(unit_x, px[i].exponent);
        unit_y = std::min(unit_y, py[i].exponent);
    }
    Integer sum;
    for (int i = 0; i < count; ++i) sum = sum + integer(px[i], unit_x) * integer(py[i], unit_y);
    return sum.sign() == 0 ? 0.0 : round_integer(sum, unit_x + unit_y);
}

}  // namespace barycert

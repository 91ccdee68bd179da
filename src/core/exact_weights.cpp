#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "core/exact_tier.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/integer.hpp"
#include "core/lanes.hpp"
#include "core/numerators-inl.hpp"
#include "core/scaled_double.hpp"

namespace barycert::core {
namespace {

namespace formulas = HWY_NAMESPACE;

/// Widths. Coordinates below 2^(64 N - 3) in N limbs give differences below 2^(64 N - 2), and with these
///   a 2x2 minor is below 2 * 2^(128 N - 4)                in 2 N limbs, range 2^(128 N - 1),
///   a numerator of degree 3 below 3 * 2^(64 N - 2) * that in 3 N limbs: 3 * 2^(192 N - 5),
///   four of them below 2^(192 N - 1), their range,
///   a numerator of degree 4 below 3 * (minor)^2           in 4 N limbs: 3 * 2^(256 N - 6),
///   a square of a length below 3 * 2^(128 N - 4)          in 2 N limbs,
///   three products of such a square and a minor below 9 * 2^(256 N - 7)         in 4 N limbs,
///   four of one and a numerator of degree 3 below 36 * 2^(320 N - 9)            in 5 N limbs,
/// so that no sum overflows.
template <int count, int d, class Decide>
auto with_points(const double* const (&points)[count], bool common, Decide decide) {
    return with_lattice<count, d>([&](int i, int k) { return points[i][k]; }, common, decide);
}

/// sum += x * f. Requires: x has fewer limbs than the sum.
template <int N>
void add_product(Fixed<N>& sum, const Integer& x, const Fixed<1>& f) {
    const bool negative = (x.sign() < 0) != f.negative();
    const std::uint64_t factor = f.negative() ? 0 - f.limbs[0] : f.limbs[0];
    std::uint64_t high = 0;  // of the product so far
    Carry carry = 0;
    for (std::size_t i = 0; i < N; ++i) {
        const UInt128 t = static_cast<UInt128>(i < x.magnitude().size() ? x.magnitude()[i] : 0) * factor + high;
        const auto limb = static_cast<std::uint64_t>(t);
        high = static_cast<std::uint64_t>(t >> 64);
        sum.limbs[i] =
            negative ? subtract_with_borrow(sum.limbs[i], limb, carry) : add_with_carry(sum.limbs[i], limb, carry);
    }
}

/// Sign of the determinant of d differences, each from one point to another.
template <int count, int d>
Sign sign_of_determinant(const double* const (&points)[count], const int (&ends)[d][2]) {
    return with_points<count, d>(points, false, [&]<class T>(const Lattice<count, d, T>& lattice) {
        T rows[d][d];
        for (int i = 0; i < d; ++i) lattice.difference(ends[i][1], ends[i][0], rows[i]);
        return static_cast<Sign>(formulas::determinant(rows).sign());
    });
}

// In integers as wide as need be: differences of 2099 bits (see integer.hpp), products of 5, of which 4 * 6 * 3 are
// added up. A product of two numbers has a limb more than its bits at most, a sum one more.
static_assert(64 * (Integer::capacity - 2) >= 5 * 2099 + 7);

/// Sign of sum n_i |r_i|^2, as numerators-inl.hpp has it, of vertices and point. All axes in one unit: squares are
/// added up.
template <Simplex s>
Sign sign_of_lifted(const double* const (&points)[vertex_count(s) + 1]) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    return with_points<n + 1, d>(points, true, []<class T>(const Lattice<n + 1, d, T>& lattice) {
        formulas::Relative<s, T> c;
        formulas::Lifted<s, T> lifted;
        for (int i = 0; i < n; ++i) lattice.difference(i, n, c.r[i]);
        formulas::lift(c, lifted);
        return static_cast<Sign>(lifted.sum.sign());
    });
}

}  // namespace

ExactWeights::ExactWeights(Simplex simplex, const double* vertices, const double* point)
    : count_(vertex_count(simplex)) {
    with_simplex(simplex, [&]<Simplex s>() { solve<s>(vertices, point); });
}

template <Simplex s>
void ExactWeights::solve(const double* vertices, const double* point) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    constexpr bool projected = s == Simplex::segment || s == Simplex::triangle3d;
    const double* points[n + 1];
    for (int i = 0; i < n; ++i) points[i] = vertices + d * i;
    points[n] = point;
    with_points<n + 1, d>(points, projected, [&]<class T>(const Lattice<n + 1, d, T>& lattice) {
        formulas::Relative<s, T> c;
        for (int i = 0; i < n; ++i) lattice.difference(i, n, c.r[i]);
        if constexpr (projected) {
            for (int i = 1; i < n; ++i) lattice.difference(i, 0, c.e[i - 1]);
        }
        formulas::Fractions<s, T> solution;
        formulas::solve(c, formulas::Numerator<s, T>{}, solution);
        for (int i = 0; i < n; ++i) numbers_[i] = as_integer(solution.numerator[i]);
        numbers_[denominator] = as_integer(solution.denominator);
    });
}

double ExactWeights::weight(int i) const {
    return round_quotient(numbers_[i], numbers_[denominator], 0);
}

double ExactWeights::interpolate(std::span<const double> values) const {
    Unit unit;
    for (const double value : values) unit.add(value);
    Integer sum;
    constexpr std::size_t narrow = 7;  // limbs: numerators of a tetrahedron in two limbs, and one more
    const auto fits = [](const Integer& x) { return x.magnitude().size() < narrow; };
    if (unit.bits() <= 64 - 3 && std::all_of(numbers_, numbers_ + count_, fits)) {
        // Four products of a value and a numerator: room as for a numerator of one degree more.
        Fixed<narrow> all{};
        for (int i = 0; i < count_; ++i)
            add_product(all, numbers_[i], unit.multiple<Fixed<1>>(scaled(values[static_cast<std::size_t>(i)])));
        sum = as_integer(all);
    } else {
        for (int i = 0; i < count_; ++i) sum = sum + numbers_[i] * unit.integer(values[static_cast<std::size_t>(i)]);
    }
    return round_quotient(sum, numbers_[denominator], unit.exponent - 1074);
}

int ExactWeights::compare(std::span<const double> values, double t) const {
    Unit unit{t};
    for (const double value : values) unit.add(value);
    // A fifth product, of the denominator, beside the four of interpolate(): at most two bits more.
    Integer sum = Integer() - numbers_[denominator] * unit.integer(t);
    for (int i = 0; i < count_; ++i) sum = sum + numbers_[i] * unit.integer(values[static_cast<std::size_t>(i)]);
    return sum.sign() * orientation();
}

bool ExactWeights::leave_out_not_finite(std::span<double> values) const {
    const bool quadratic = values.size() > static_cast<std::size_t>(count_);
    bool none_has_part = true;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i])) continue;
        values[i] = 0;
        none_has_part = none_has_part && !has_part(static_cast<int>(i), quadratic);
    }
    return none_has_part;
}

/// The quadratic's shape functions are l (2 l - 1) at corners and 4 l l' between them.
bool ExactWeights::has_part(int node, bool quadratic) const {
    if (degenerate()) return true;
    if (node >= count_) {
        const auto& ends = quadratic_edges[node - count_];
        return sign_of(ends[0]) != 0 && sign_of(ends[1]) != 0;
    }
    if (sign_of(node) == 0) return false;
    double unit[4] = {};
    unit[node] = 1;
    return !quadratic || compare({unit, static_cast<std::size_t>(count_)}, 0.5) != 0;
}

Sign exact_orient2d(const double* a, const double* b, const double* c) {
    return sign_of_determinant<3, 2>({a, b, c}, {{0, 1}, {0, 2}});
}

Sign exact_orient3d(const double* a, const double* b, const double* c, const double* d) {
    return sign_of_determinant<4, 3>({a, b, c, d}, {{0, 1}, {0, 2}, {0, 3}});
}

Sign exact_det3d(const double* p, const double* q, const double* r, const double* s, const double* t, const double* u) {
    return sign_of_determinant<6, 3>({p, q, r, s, t, u}, {{0, 1}, {2, 3}, {4, 5}});
}

Sign exact_incircle(const double* a, const double* b, const double* c, const double* d) {
    return sign_of_lifted<Simplex::triangle>({a, b, c, d});
}

Sign exact_insphere(const double* a, const double* b, const double* c, const double* d, const double* e) {
    return sign_of_lifted<Simplex::tetrahedron>({a, b, c, d, e});
}

double exact_dot(const double* x, const double* y, int count) {
    Unit unit_x, unit_y;
    for (int i = 0; i < count; ++i) {
        unit_x.add(x[i]);
        unit_y.add(y[i]);
    }
    Integer sum;
    for (int i = 0; i < count; ++i) sum = sum + unit_x.integer(x[i]) * unit_y.integer(y[i]);
    return round_integer(sum, unit_x.exponent + unit_y.exponent - 2 * 1074);
}

}  // namespace barycert::core

#include "barycert/core/exact_tier.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>

#include "barycert/core/numerators-inl.hpp"
#include "barycert/core/scaled_double.hpp"

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

/// The magnitude of a number in two's complement.
Magnitude absolute(const std::uint64_t* limbs, int count, std::uint64_t* buffer) {
    if ((limbs[count - 1] >> 63) == 0) return {limbs, static_cast<std::size_t>(count)};
    Carry borrow = 0;
    for (int i = 0; i < count; ++i) buffer[i] = subtract_with_borrow(0, limbs[i], borrow);
    return {buffer, static_cast<std::size_t>(count)};
}

int sign_of(const std::uint64_t* limbs, int count) {
    if ((limbs[count - 1] >> 63) != 0) return -1;
    return std::any_of(limbs, limbs + count, [](std::uint64_t limb) { return limb != 0; }) ? 1 : 0;
}

template <int N>
int sign_of(const Fixed<N>& x) {
    return sign_of(x.limbs.data(), N);
}
int sign_of(const Integer& x) {
    return x.sign();
}

/// sum += x * f, all in two's complement. `sum` has one limb more than x, of which there are `count`.
void add_product(std::uint64_t* sum, const std::uint64_t* x, int count, std::uint64_t f) {
    // The unsigned product less 2^64 x if f is negative and 2^(64 count) f if x is, as in integer.hpp.
    const std::uint64_t f_mask = (f >> 63) != 0 ? ~std::uint64_t{0} : 0;
    const std::uint64_t x_mask = (x[count - 1] >> 63) != 0 ? ~std::uint64_t{0} : 0;
    std::uint64_t high = 0, above = 0;  // of the product so far; x one limb up, as far as it is to be taken off
    Carry carry = 0, borrow = 0;
    for (int i = 0; i < count; ++i) {
        const UInt128 t = static_cast<UInt128>(x[i]) * f + high;
        high = static_cast<std::uint64_t>(t >> 64);
        const std::uint64_t limb = subtract_with_borrow(static_cast<std::uint64_t>(t), above, borrow);
        sum[i] = add_with_carry(sum[i], limb, carry);
        above = x[i] & f_mask;
    }
    const std::uint64_t limb = subtract_with_borrow(high - (f & x_mask), above, borrow);
    sum[count] = add_with_carry(sum[count], limb, carry);
}

/// Sign of the determinant of d differences, each from one point to another.
template <int count, int d>
Sign sign_of_determinant(const double* const (&points)[count], const int (&ends)[d][2]) {
    return with_points<count, d>(points, false, [&]<class T>(const Lattice<count, d, T>& lattice) {
        T rows[d][d];
        for (int i = 0; i < d; ++i) lattice.difference(ends[i][1], ends[i][0], rows[i]);
        return static_cast<Sign>(sign_of(formulas::determinant(rows)));
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
        return static_cast<Sign>(sign_of(lifted.sum));
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
        for (int i = 0; i < n; ++i) store(i, solution.numerator[i]);
        store(denominator, solution.denominator);
    });
}

template <class T>
void ExactWeights::store(int i, const T& number) {
    if constexpr (std::is_same_v<T, Integer>) {
        wide_[i] = number;
    } else {
        static_assert(std::tuple_size_v<decltype(number.limbs)> <= narrow_limbs);
        limbs_ = static_cast<int>(number.limbs.size());
        std::copy(number.limbs.begin(), number.limbs.end(), narrow_[i]);
    }
}

int ExactWeights::sign_of(int i) const {
    return limbs_ == 0 ? wide_[i].sign() : core::sign_of(narrow_[i], limbs_);
}

Magnitude ExactWeights::magnitude(int i, std::uint64_t* buffer) const {
    return limbs_ == 0 ? wide_[i].magnitude() : absolute(narrow_[i], limbs_, buffer);
}

double ExactWeights::weight(int i) const {
    std::uint64_t buffers[2][narrow_limbs];
    return round_quotient(sign(i) < 0, magnitude(i, buffers[0]), magnitude(denominator, buffers[1]), 0);
}

double ExactWeights::interpolate(std::span<const double> values) const {
    ScaledDouble parts[4];
    Unit unit;
    for (int i = 0; i < count_; ++i) {
        parts[i] = scaled(values[static_cast<std::size_t>(i)]);
        unit.add(parts[i]);
    }
    std::uint64_t buffer[narrow_limbs + 1];
    if (limbs_ != 0 && unit.bits() <= 64 - 3) {
        // Four products of a value and a numerator: room as for a numerator of one degree more.
        std::uint64_t sum[narrow_limbs + 1] = {}, sum_buffer[narrow_limbs + 1];
        for (int i = 0; i < count_; ++i)
            add_product(sum, narrow_[i], limbs_, unit.multiple<Fixed<1>>(parts[i]).limbs[0]);
        return round_quotient(core::sign_of(sum, limbs_ + 1) != orientation(), absolute(sum, limbs_ + 1, sum_buffer),
                              magnitude(denominator, buffer), unit.exponent - 1074);
    }
    Integer sum;
    for (int i = 0; i < count_; ++i)
        sum = sum + Integer(sign_of(i) < 0, magnitude(i, buffer)) * unit.multiple<Integer>(parts[i]);
    return round_quotient(sum.sign() != orientation(), sum.magnitude(), magnitude(denominator, buffer),
                          unit.exponent - 1074);
}

int ExactWeights::compare(std::span<const double> values, double t) const {
    Unit unit;
    unit.add(t);
    for (const double value : values) unit.add(value);
    std::uint64_t buffer[narrow_limbs];
    // A fifth product, of the denominator, beside the four of interpolate(): at most two bits more.
    Integer sum = Integer(sign_of(denominator) >= 0, magnitude(denominator, buffer)) * unit.integer(t);
    for (int i = 0; i < count_; ++i)
        sum = sum + Integer(sign_of(i) < 0, magnitude(i, buffer)) * unit.integer(values[static_cast<std::size_t>(i)]);
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

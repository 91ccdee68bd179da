// Distances to features in exact integers: comparisons, and one rounding.
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <cstdint>
#include <utility>

#include "barycert/base/vectors.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"
#include "barycert/locate/near_feature.hpp"

namespace barycert::locate {
namespace {

// Not core's Integer, which has room for degree 7 in differences of any doubles: comparisons have degree 10. Up to 512
// bits without heap: what most distances need.
using Number =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
                                      512, 0, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked,
                                      std::allocator<boost::multiprecision::limb_type>>,
                                  boost::multiprecision::et_off>;
using Vector = base::Vector3<Number>;
using base::cross, base::dot, base::minus;

/// Points as whole multiples of 2^(unit.exponent - 1074).
class Lattice {
public:
    void add(const Point3& p) {
        for (const double x : p) unit_.add(core::scaled(x));
    }
    void add(const NearFeature& f) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(f.count); ++i) add(f.at[i]);
    }
    Vector at(const Point3& p) const {
        Vector v;
        for (std::size_t k = 0; k < 3; ++k) {
            const core::ScaledDouble x = core::scaled(p[k]);
            if (x.mantissa == 0) continue;
            v[k] = x.mantissa;
            v[k] <<= static_cast<unsigned>(x.exponent - unit_.exponent);
            if (x.negative) v[k] = -v[k];
        }
        return v;
    }
    /// Of the unit, as a power of two; 0 if all is zero.
    int exponent() const { return unit_.exponent == core::ScaledDouble::none ? 0 : unit_.exponent - 1074; }

private:
    core::Unit unit_;
};

/// Of a distance: numerator / denominator.
struct Square {
    Number numerator, denominator = 1;
};

Square square_of(const Lattice& lattice, const Point3& p, const NearFeature& f) {
    const Vector a = lattice.at(f.at[0]), q = minus(lattice.at(p), a);
    if (f.count == 1) return {dot(q, q), 1};
    const Vector e = minus(lattice.at(f.at[1]), a);
    if (f.count == 2) {
        const Vector n = cross(q, e);
        return {dot(n, n), dot(e, e)};
    }
    const Vector n = cross(e, minus(lattice.at(f.at[2]), a));
    const Number height = dot(q, n);
    return {height * height, dot(n, n)};
}

int bits_of(const Number& x) {
    return static_cast<int>(msb(x)) + 1;
}

/// floor(sqrt(x)). The estimate is off by far less than 2^32, so its square fits and a step of Newton's leaves less
/// than one or two; then it is counted.
std::uint64_t root_of(core::UInt128 x) {
    auto r = static_cast<core::UInt128>(std::sqrt(static_cast<double>(x)));
    r = (r + x / r) / 2;
    while (r * r > x) --r;
    while ((r + 1) * (r + 1) <= x) ++r;
    return static_cast<std::uint64_t>(r);
}

}  // namespace

int compare_distances(const Point3& p, const NearFeature& f, const NearFeature& g) {
    Lattice lattice;
    lattice.add(p);
    lattice.add(f);
    lattice.add(g);
    const Square a = square_of(lattice, p, f), b = square_of(lattice, p, g);
    const Number x = a.numerator * b.denominator, y = b.numerator * a.denominator;
    return x < y ? -1 : x == y ? 0 : 1;
}

double distance_to(const Point3& p, const NearFeature& f) {
    Lattice lattice;
    lattice.add(p);
    lattice.add(f);
    Square s = square_of(lattice, p, f);
    if (s.numerator == 0) return 0;
    // floor(numerator 4^shift / denominator) has 124 to 126 bits, its root 62 or 63. What was cut off, of either, is
    // one more bit at the end that is not zero: it decides ties, and nothing else.
    const int excess = bits_of(s.numerator) - bits_of(s.denominator), shift = (125 - excess) >> 1;
    if (shift >= 0) {
        s.numerator <<= static_cast<unsigned>(2 * shift);
    } else {
        s.denominator <<= static_cast<unsigned>(-2 * shift);
    }
    Number quotient, rest;
    divide_qr(s.numerator, s.denominator, quotient, rest);
    const auto low = static_cast<std::uint64_t>(quotient & ~std::uint64_t{0});
    const core::UInt128 q = static_cast<core::UInt128>(static_cast<std::uint64_t>(quotient >> 64)) << 64 | low;
    const std::uint64_t root = root_of(q);
    const bool inexact = rest != 0 || static_cast<core::UInt128>(root) * root != q;
    return core::round_integer(core::Integer(false, root << 1 | (inexact ? 1 : 0), 0), lattice.exponent() - shift - 1);
}

}  // namespace barycert::locate

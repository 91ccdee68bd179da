#include "barycert/surface/levels.hpp"

#include <initializer_list>

#include "barycert/base/strict_math.hpp"
#include "barycert/core/exact_tier.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"

namespace barycert::surface {
namespace {

using core::Integer;
using core::scaled;
using core::Unit;

/// Of which all of these are multiples.
Unit unit_of(std::initializer_list<double> numbers) {
    Unit unit;
    for (const double x : numbers) unit.add(scaled(x));
    return unit;
}

/// offset - normal.x in units that depend on the plane and on `of_points` alone.
Integer exact_height(const Plane& plane, const double* x, const Unit& of_points) {
    const Unit of_plane = unit_of({plane.offset, plane.normal[0], plane.normal[1], plane.normal[2]});
    Integer sum = of_plane.multiple<Integer>(scaled(plane.offset)) * of_points.multiple<Integer>(scaled(1));
    for (std::size_t k = 0; k < 3; ++k)
        sum = sum - of_plane.multiple<Integer>(scaled(plane.normal[k])) * of_points.multiple<Integer>(scaled(x[k]));
    return sum;
}

}  // namespace

ExactCrossing::ExactCrossing(double in, double out, double value) {
    const Unit unit = unit_of({in, out, value});
    const Integer level = unit.multiple<Integer>(scaled(value));
    in_ = unit.multiple<Integer>(scaled(in)) - level;
    out_ = level - unit.multiple<Integer>(scaled(out));
}

ExactCrossing::ExactCrossing(const Plane& plane, const double* in, const double* out) {
    const Unit of_points = unit_of({1, in[0], in[1], in[2], out[0], out[1], out[2]});
    in_ = exact_height(plane, in, of_points);
    out_ = Integer() - exact_height(plane, out, of_points);
}

double ExactCrossing::value(double in, double out) const {
    // The weights of the ends are out_ / (in_ + out_) and in_ / (in_ + out_).
    const Unit unit = unit_of({in, out});
    const Integer sum = out_ * unit.multiple<Integer>(scaled(in)) + in_ * unit.multiple<Integer>(scaled(out));
    return core::round_quotient(sum.sign() < 0, sum.magnitude(), (in_ + out_).magnitude(), unit.exponent - 1074);
}

State PlaneLevel::state(std::size_t node) const {
    // Three products and three sums, each rounded by u of at most M (1 + 4 u), M the sum of the magnitudes of the
    // terms: an error of 4 u M and a little. Underflow loses 2^-1075 a product, and as much in the bound. Of what is
    // infinite or NaN the comparisons are false.
    const double* const x = points_ + 3 * node;
    double height = plane_.offset, magnitude = std::fabs(plane_.offset);
    for (std::size_t k = 0; k < 3; ++k) {
        const double product = plane_.normal[k] * x[k];
        height -= product;
        magnitude += std::fabs(product);
    }
    const double bound = 4.5 * 0x1p-53 * magnitude + 0x1p-1070;
    if (height > bound) return inside;
    if (height < -bound) return outside;
    const int sign = exact_height(plane_, x, unit_of({1, x[0], x[1], x[2]})).sign();
    return sign > 0 ? inside : sign < 0 ? outside : on;
}

}  // namespace barycert::surface

namespace barycert {

Plane plane_through(const std::array<double, 3>& point, const std::array<double, 3>& normal) {
    return {normal, core::exact_dot(normal.data(), point.data(), 3)};
}

}  // namespace barycert

#include "barycert/raster/exact_point.hpp"

#include "barycert/core/quotient.hpp"

namespace barycert::raster {
namespace {

using core::Integer;

/// With a positive denominator, their sum.
ExactPoint normalised(const Form& n, int count) {
    ExactPoint p{n, n[0] + n[1]};
    if (count == 3) p.denominator = p.denominator + n[2];
    if (p.denominator.sign() >= 0) return p;
    for (Integer& x : p.numerator) x = Integer() - x;
    p.denominator = Integer() - p.denominator;
    return p;
}

}  // namespace

ExactPoint zero_on_segment(const Form& h) {
    // h_a W_a + h_b W_b = 0 for W_a : W_b = h_b : -h_a.
    return normalised({h[1], Integer() - h[0], Integer()}, 2);
}

ExactPoint zero_in_triangle(const Form& g, const Form& h) {
    return normalised({g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0]}, 3);
}

int sign_at(const Form& h, const ExactPoint& p, int count) {
    Integer sum = h[0] * p.numerator[0] + h[1] * p.numerator[1];
    if (count == 3) sum = sum + h[2] * p.numerator[2];
    return sum.sign();
}

double value_at(const ExactPoint& p, const double* values, std::size_t stride, int count) {
    core::Unit unit;
    for (int i = 0; i < count; ++i) unit.add(core::scaled(values[stride * static_cast<std::size_t>(i)]));
    Integer sum;
    for (int i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        sum = sum + p.numerator[k] * unit.multiple<Integer>(core::scaled(values[stride * k]));
    }
    return core::round_quotient(sum.sign() < 0, sum.magnitude(), p.denominator.magnitude(), unit.exponent - 1074);
}

}  // namespace barycert::raster

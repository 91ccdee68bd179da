#include "mesh/index/exact_volumes.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/integer.hpp"
#include "core/numerators-inl.hpp"
#include "core/scaled_double.hpp"

namespace barycert::index {
namespace {

/// The determinant of the rows p[0], ..., p[d - 1], less `origin` if there is one.
template <int d, class T>
Integer determinant_of(const core::Unit (&units)[3], const double* const* p, const double* origin) {
    T rows[d][d];
    for (int k = 0; k < d; ++k) {
        const auto integer = [&](double x) { return units[k].template multiple<T>(core::scaled(x)); };
        for (int i = 0; i < d; ++i) rows[i][k] = integer(p[i][k]);
        if (origin == nullptr) continue;
        const T less = integer(origin[k]);
        for (int i = 0; i < d; ++i) rows[i][k] = rows[i][k] - less;
    }
    return core::as_integer(core::HWY_NAMESPACE::determinant(rows));
}

}  // namespace

ExactVolumes::ExactVolumes(int d, std::span<const double> points) : d_(d) {
    const auto axes = static_cast<std::size_t>(d);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (std::isfinite(points[i])) units_[i % axes].add(core::scaled(points[i]));
    }
    bits_ = core::max_bits(units_);
    for (std::size_t k = 0; k < axes; ++k) exponent_ += units_[k].exponent - 1074;
}

/// With the narrowest integers that have room: with coordinates below 2^(64 N - 3) in N limbs a difference is below
/// 2^(64 N - 2), a 2x2 minor below 2^(128 N - 3) and a determinant of three below 2^(192 N - 3), within the ranges
/// 2^(64 N - 1), 2^(128 N - 1), 2^(192 N - 1) of N, 2 N and 3 N limbs.
Integer ExactVolumes::determinant_from(const double* const* p, const double* origin) const {
    return core::with_integers<3>(bits_, [&]<class T>() {
        return d_ == 2 ? determinant_of<2, T>(units_, p, origin) : determinant_of<3, T>(units_, p, origin);
    });
}

int ExactVolumes::exponent(const Integer& n) const {
    const auto limbs = n.magnitude();
    return exponent_ + 64 * static_cast<int>(limbs.size()) - std::countl_zero(limbs.back()) - 1;
}

double ExactVolumes::rounded(const Integer& n, int scale) const {
    static constexpr std::array<std::uint64_t, 1> two{2}, six{6};
    return core::round_quotient(n.sign() < 0, n.magnitude(), d_ == 2 ? two : six, exponent_ - d_ * scale);
}

}  // namespace barycert::index

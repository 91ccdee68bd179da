#include "barycert/check/exact_volumes.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "barycert/core/fixed_integer.hpp"
#include "barycert/core/numerators-inl.hpp"
#include "barycert/core/quotient.hpp"

namespace barycert::check {
namespace {

namespace formulas = core::HWY_NAMESPACE;

template <class T>
Integer determinant(const T (&x)[2], const T (&y)[2]) {
    return core::as_integer(formulas::cross(x, y));
}

template <class T>
Integer determinant(const T (&x)[3], const T (&y)[3], const T (&z)[3]) {
    formulas::Product<T> minors[3];
    formulas::cross(y, z, minors);
    return core::as_integer(formulas::dot(x, minors));
}

/// Coordinates of a point as integers.
template <int d, class T>
void load(const core::Unit (&units)[3], const double* p, T (&out)[d]) {
    for (int k = 0; k < d; ++k) out[k] = units[k].template multiple<T>(core::scaled(p[k]));
}

/// f.operator()<T>() with the narrowest integers that have room: with coordinates below 2^(64 N - 3) in N limbs a
/// difference is below 2^(64 N - 2), a 2x2 minor below 2^(128 N - 3) and a determinant of three below 2^(192 N - 3),
/// within the ranges 2^(64 N - 1), 2^(128 N - 1), 2^(192 N - 1) of N, 2 N and 3 N limbs.
template <class F>
Integer with_width(int bits, F f) {
    return core::with_integers<3>(bits, f);
}

}  // namespace

ExactVolumes::ExactVolumes(int d, std::span<const double> points) : d_(d) {
    const auto axes = static_cast<std::size_t>(d);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (std::isfinite(points[i])) units_[i % axes].add(core::scaled(points[i]));
    }
    for (std::size_t k = 0; k < axes; ++k) {
        bits_ = std::max(bits_, units_[k].bits());
        exponent_ += units_[k].exponent - 1074;
    }
}

template <class T>
Integer ExactVolumes::cell_as(const double* const* p) const {
    const auto edges = [&]<int d>(T(&edge)[d][d]) {
        T origin[d];
        load(units_, p[0], origin);
        for (int i = 0; i < d; ++i) {
            load(units_, p[i + 1], edge[i]);
            for (int k = 0; k < d; ++k) edge[i][k] = edge[i][k] - origin[k];
        }
    };
    if (d_ == 2) {
        T edge[2][2];
        edges(edge);
        return determinant(edge[0], edge[1]);
    }
    T edge[3][3];
    edges(edge);
    return determinant(edge[0], edge[1], edge[2]);
}

template <class T>
Integer ExactVolumes::cone_as(const double* const* p) const {
    if (d_ == 2) {
        T x[2], y[2];
        load(units_, p[0], x);
        load(units_, p[1], y);
        return determinant(x, y);
    }
    T x[3], y[3], z[3];
    load(units_, p[0], x);
    load(units_, p[1], y);
    load(units_, p[2], z);
    return determinant(x, y, z);
}

Integer ExactVolumes::cell(const double* const* p) const {
    return with_width(bits_, [&]<class T>() { return cell_as<T>(p); });
}

Integer ExactVolumes::cone(const double* const* p) const {
    return with_width(bits_, [&]<class T>() { return cone_as<T>(p); });
}

int ExactVolumes::exponent(const Integer& n) const {
    const auto limbs = n.magnitude();
    return exponent_ + 64 * static_cast<int>(limbs.size()) - std::countl_zero(limbs.back()) - 1;
}

double ExactVolumes::rounded(const Integer& n, int scale) const {
    static constexpr std::array<std::uint64_t, 1> two{2}, six{6};
    return core::round_quotient(n.sign() < 0, n.magnitude(), d_ == 2 ? two : six, exponent_ - d_ * scale);
}

}  // namespace barycert::check

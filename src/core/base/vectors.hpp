/// Vectors of three numbers, in the plain arithmetic of their type.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace barycert::base {

template <class T>
using Vector3 = std::array<T, 3>;

template <class T>
Vector3<T> minus(const Vector3<T>& x, const Vector3<T>& y) {
    return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

template <class T>
Vector3<T> cross(const Vector3<T>& x, const Vector3<T>& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

template <class T>
T dot(const Vector3<T>& x, const Vector3<T>& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// Returns v scaled to length 1 up to rounding, whatever its length. Requires: finite, not zero.
inline Vector3<double> unit(const Vector3<double>& v) {
    const int shift = -std::ilogb(std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}));
    Vector3<double> d{std::scalbn(v[0], shift), std::scalbn(v[1], shift), std::scalbn(v[2], shift)};
    const double length = std::sqrt(dot(d, d));
    for (double& x : d) x /= length;
    return d;
}

}  // namespace barycert::base

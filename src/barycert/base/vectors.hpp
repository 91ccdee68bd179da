/// Vectors of three numbers, in the plain arithmetic of their type.
#pragma once

#include <array>

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

}  // namespace barycert::base

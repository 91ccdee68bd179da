/// Weights from a linear system given to Eigen. Linkage: vectors.hpp.
///
/// Not for the variants with other compiler flags: Eigen's inline functions are shared between source files.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace barycert::kernels {
namespace {

/// (v1-v0 | v2-v0 | ...)^-1 (p-v0), the explicit inverse of the edge matrix; the first weight is what is left of 1.
template <class T, int d>
int by_inverse(const T* v, const T* p, T* w) {
    using Vector = Eigen::Matrix<T, d, 1>;
    const Eigen::Map<const Eigen::Matrix<T, d, d + 1>> vertices(v);
    const Vector origin = vertices.col(0);
    const Eigen::Matrix<T, d, d> edges = vertices.template rightCols<d>().colwise() - origin;
    const Vector x = edges.inverse() * (Eigen::Map<const Vector>(p) - origin);
    w[0] = 1;
    for (int i = 0; i < d; ++i) {
        w[i + 1] = x[i];
        w[0] -= x[i];
    }
    return 0;
}

/// The system with a row of ones, (1 1 ...; v0 v1 ...) w = (1; p), in absolute coordinates; LU is the decomposition.
template <class T, int d, template <class...> class LU>
int by_decomposition(const T* v, const T* p, T* w) {
    using Matrix = Eigen::Matrix<T, d + 1, d + 1>;
    using Vector = Eigen::Matrix<T, d + 1, 1>;
    Matrix system;
    system.row(0).setOnes();
    system.template bottomRows<d>() = Eigen::Map<const Eigen::Matrix<T, d, d + 1>>(v);
    Vector right;
    right[0] = 1;
    right.template tail<d>() = Eigen::Map<const Eigen::Matrix<T, d, 1>>(p);
    Eigen::Map<Vector>{w} = LU<Matrix>(system).solve(right);
    return 0;
}

}  // namespace
}  // namespace barycert::kernels

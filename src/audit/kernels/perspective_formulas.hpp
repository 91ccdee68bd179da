/// Perspective-correct weights in a triangle a b c of the window, whose vertices are x, y, w. Notation and linkage:
/// vectors.hpp.
#pragma once

#include "audit/kernels/triangle_formulas.hpp"

namespace barycert::kernels {
namespace {

/// The vertices without their depths.
template <class T>
struct InWindow {
    T at[6];
    explicit InWindow(const T* v) : at{v[0], v[1], v[3], v[4], v[6], v[7]} {}
};

/// The window's weights as they are: right where all depths are equal.
template <class T>
int perspective_affine(const T* v, const T* p, T* w) {
    return signed_area(InWindow<T>(v).at, p, w);
}

/// 1/Z = sum alpha_i / Z_i, then weight i = Z (alpha_i / Z_i), with the window's weights by the closed formula.
template <class T>
int with_depths(const T* v, const T* p, const T (&depth)[3], T* w) {
    beta_gamma(InWindow<T>(v).at, p, w);
    const T z = 1 / (w[0] / depth[0] + w[1] / depth[1] + w[2] / depth[2]);
    for (int i = 0; i < 3; ++i) w[i] = z * (w[i] / depth[i]);
    return 0;
}

template <class T>
int perspective_textbook(const T* v, const T* p, T* w) {
    return with_depths(v, p, {v[2], v[5], v[8]}, w);
}

/// The depth that a z-buffer holds, OpenGL's from 0 at `near` to 1 at `far`: a - b/w with a = far / (far - near) and
/// b = near far / (far - near).
template <class T>
T projected_z(T w) {
    constexpr T near = T(1) / 1024, far = 1024;
    return far / (far - near) - near * far / (far - near) / w;
}

template <class T>
int perspective_projected_z(const T* v, const T* p, T* w) {
    return with_depths(v, p, {projected_z(v[2]), projected_z(v[5]), projected_z(v[8])}, w);
}

/// v/w and 1/w are linear in the window: interpolate both there, by signed areas, and divide. For a weight, v is 1 at
/// one vertex and 0 at the others.
template <class T>
int perspective_varying(const T* v, const T* p, T* w) {
    if (perspective_affine(v, p, w) != 0) return 1;
    for (int i = 0; i < 3; ++i) w[i] *= 1 / v[3 * i + 2];
    const T inverse = w[0] + w[1] + w[2];
    for (int i = 0; i < 3; ++i) w[i] /= inverse;
    return 0;
}

/// I = Z sum alpha_i I_i / Z_i.
template <class T>
T textbook_value(const T* v, const T* p, const T* f) {
    T w[3];
    beta_gamma(InWindow<T>(v).at, p, w);
    const T z = 1 / (w[0] / v[2] + w[1] / v[5] + w[2] / v[8]);
    return z * (w[0] * f[0] / v[2] + w[1] * f[1] / v[5] + w[2] * f[2] / v[8]);
}

/// (sum alpha_i (I_i / w_i)) / (sum alpha_i (1 / w_i)).
template <class T>
T varying_value(const T* v, const T* p, const T* f) {
    T w[3] = {};
    perspective_affine(v, p, w);
    const T inverse = w[0] * (1 / v[2]) + w[1] * (1 / v[5]) + w[2] * (1 / v[8]);
    return (w[0] * (f[0] / v[2]) + w[1] * (f[1] / v[5]) + w[2] * (f[2] / v[8])) / inverse;
}

}  // namespace
}  // namespace barycert::kernels

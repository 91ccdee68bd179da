/// Quotients of balls by integers, and inverses of small matrices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/isoparametric/ball.hpp"

namespace barycert::core::isoparametric {

using Matrix = std::array<std::array<double, 3>, 3>;

/// 1 / n.
template <class T>
Ball<T> inverse_of(int n) {
    if (n == 1) return Ball<T>(1);
    if constexpr (std::is_same_v<T, TwoDoubles>) {
        const double high = 1.0 / n, low = -__builtin_fma(high, n, -1.0) / n;
        return {{high, low}, 0x1p-104};
    } else {
        return {T(1) / T(n), NumberTraits<T>::of_sum};
    }
}

/// 1 / x for all x of the ball: about y, with |1 / x - y| = |1 - x y| / |x|. Nothing where 0 may be one of them.
template <class T>
std::optional<Ball<T>> inverse_of(const Ball<T>& x) {
    if (!x.sign()) return std::nullopt;
    T y;
    if constexpr (std::is_same_v<T, TwoDoubles>) {
        const TwoDoubles about(1 / x.mid.high);
        y = about + about * (TwoDoubles(1) - x.mid * about);
    } else {
        y = T(1) / x.mid;
    }
    const double least = (x.size() * (1 - 0x1p-40) - x.radius) * (1 - 0x1p-50);
    const double off = (Ball<T>(1) - x * Ball<T>(y)).most();
    return Ball<T>(y, off / least * (1 + 0x1p-48) + 0x1p-1000);
}

/// The cofactors of the first n rows and columns; n is 2 or 3.
template <class N>
std::array<std::array<N, 3>, 3> cofactors(const std::array<std::array<N, 3>, 3>& a, std::size_t n) {
    std::array<std::array<N, 3>, 3> c;
    if (n == 2) {
        c[0][0] = a[1][1];
        c[0][1] = -a[1][0];
        c[1][0] = -a[0][1];
        c[1][1] = a[0][0];
        return c;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            c[i][j] = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
        }
    }
    return c;
}

/// Gauss and Jordan: the first n columns of n rows become those of 1. False where that is not so.
template <class Rows>
bool eliminate(Rows& a, std::size_t n) {
    using std::abs;
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t i = c + 1; i < n; ++i) pivot = abs(a[i][c]) > abs(a[pivot][c]) ? i : pivot;
        std::swap(a[pivot], a[c]);
        const auto by = a[c][c];
        if (by == 0 || by - by != 0) return false;
        for (auto& x : a[c]) x /= by;
        for (std::size_t i = 0; i < n; ++i) {
            const auto factor = a[i][c];
            if (i == c || factor == 0) continue;
            for (std::size_t j = c; j < a[i].size(); ++j) a[i][j] -= factor * a[c][j];
        }
    }
    return true;
}

/// The approximate inverse of the first n rows and columns; the other entries are 0.
inline std::optional<Matrix> inverse_matrix(const Matrix& a, std::size_t n) {
    std::array<std::array<double, 6>, 3> rows{};
    for (std::size_t i = 0; i < n; ++i) {
        std::copy_n(a[i].begin(), n, rows[i].begin());
        rows[i][3 + i] = 1;
    }
    if (!eliminate(rows, n)) return std::nullopt;
    Matrix out{};
    for (std::size_t i = 0; i < n; ++i) std::copy_n(rows[i].begin() + 3, n, out[i].begin());
    return out;
}

}  // namespace barycert::core::isoparametric

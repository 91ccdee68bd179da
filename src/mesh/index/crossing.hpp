/// How a ray crosses a triangle in space, exactly, for winding numbers.
#pragma once

#include <array>

#include "barycert/predicates.hpp"

namespace barycert::index {

/// The ray goes along the first axis from p, moved aside by (0, e, e^2), where e is less than any length: it meets no
/// node and no edge, and lies in no triangle's plane. 1 if it leaves the triangle on the side to which its normal
/// (right hand) points, -1 if on the other, 0 if it does not cross it. For a point on no triangle of a set whose edges
/// each have as many triangles one way as the other, the sum is the winding number: moving p by so little changes
/// nothing.
inline int crossing(const std::array<const double*, 3>& t, const double* p) {
    // Without the first coordinate: on which side of ab the moved point lies. Its turn changes by
    // (b - a).y e^2 - (b - a).z e.
    const auto side = [&](const double* a, const double* b) {
        if (const Sign s = orient2d(a + 1, b + 1, p + 1); s != Sign::zero) return static_cast<int>(s);
        if (a[2] != b[2]) return a[2] > b[2] ? 1 : -1;
        return a[1] < b[1] ? 1 : -1;
    };
    const int s = side(t[0], t[1]);
    if (side(t[1], t[2]) != s || side(t[2], t[0]) != s) return 0;
    // All turn the same way, so the projection has an area, of sign s, and the point lies in it. The point is not in
    // the triangle's plane: there it would lie on the triangle, and callers ask for no such point.
    return static_cast<int>(orient3d(t[0], t[1], t[2], p)) == -s ? s : 0;
}

}  // namespace barycert::index

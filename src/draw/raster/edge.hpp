/// Where the side of a triangle crosses the rows of a raster, exactly.
///
/// Notation. The line of row j is y = j + 0.5. A side that is not horizontal goes from its lower end a to its upper end
/// b, dx = b.x - a.x, dy = b.y - a.y > 0. For a row with a.y < y <= b.y it has the crossing c(j) = the least column i
/// whose centre is not left of the side: i + 0.5 >= x(y) = a.x + (y - a.y) dx / dy, so c = ceil(x(y) - 0.5).
///
/// By the rule of raster.hpp (centres are moved right by e, down by e * e) a row belongs to the sides with
/// a.y < y <= b.y, and the pixels of a triangle in it are those from the crossing of its left side to that of its right
/// side, the latter excluded. Two triangles that share a side compute the same crossings from the same two ends.
///
/// The filter. With u = 2^-53, |coordinates| <= X <= 2^100, in round-to-nearest: dx, dy, y - a.y, their quotient and
/// product have one rounding each, five in all, so that the computed (y - a.y) dx / dy is off by at most
/// 5.1 u |(y - a.y) dx / dy| <= 5.1 u |dx| <= 10.2 u X; adding a.x and subtracting 0.5 round twice more, by at most
/// u (1 + 11 u) X and u (X + 0.5) (1 + 13 u). Together less than 13 u X + u. Underflow: dy >= 2^-54, for y is at least
/// 0.5 and both y - a.y and dy would else be zero; dx is exact where it is subnormal; the quotient may underflow by
/// 2^-1075 and is then multiplied by at most 2^102: nothing beside u. The bound 2^-49 X + 2^-52 = 16 u X + 2 u has
/// room for its own rounding. If x - 0.5 is further than that from every integer, its ceiling is c. orient2d decides
/// the rest, and coordinates above 2^100.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace barycert::raster {

/// The least i in [0, limit] with i + 0.5 > x. From 0.5 on x - 0.5 is exact, and the conversion is its floor.
inline std::int32_t first_centre_above(double x, std::int32_t limit) {
    if (x < 0.5) return 0;
    if (x >= limit - 0.5) return limit;
    return static_cast<std::int32_t>(x - 0.5) + 1;
}

struct Edge {
    const double *lower, *upper;
    double slope, error;  ///< error: the filter's bound; infinite: always undecided

    Edge(const double* a, const double* b) : lower(a), upper(b) {
        const double extent =
            std::max(std::max(std::fabs(a[0]), std::fabs(b[0])), std::max(std::fabs(a[1]), std::fabs(b[1])));
        slope = (b[0] - a[0]) / (b[1] - a[1]);
        error = extent <= 0x1p100 ? 0x1p-49 * extent + 0x1p-52 : HUGE_VAL;
    }

    /// x(y) - 0.5, up to `error`.
    double position(double y) const { return (lower[0] + (y - lower[1]) * slope) - 0.5; }
};

/// The crossing where the filter is undecided, by exact signs. `s`: edge.position(j + 0.5).
std::int32_t exact_crossing(const Edge& edge, std::int32_t j, std::int32_t width, double s);

/// The crossing with row j, within [0, width]. Requires: lower.y < j + 0.5 <= upper.y.
inline std::int32_t crossing(const Edge& edge, std::int32_t j, std::int32_t width) {
    const double s = edge.position(j + 0.5);
    const double up = std::ceil(s);
    // A comparison with NaN is false: undecided.
    const bool decided = up - s > edge.error && s - (up - 1) > edge.error;
    if (!decided) [[unlikely]]
        return exact_crossing(edge, j, width, s);
    if (up <= 0) return 0;
    return up >= width ? width : static_cast<std::int32_t>(up);
}

/// A triangle with its vertices in the order of y, and the rows that it may cover.
struct SortedTriangle {
    const double* vertex[3];  ///< lowest, middle, highest
    std::int32_t begin, middle,
        end;  ///< rows begin ... middle - 1 meet the lower short side, middle ... end - 1 the upper

    SortedTriangle(const double* vertices, std::int32_t height) : vertex{vertices, vertices + 2, vertices + 4} {
        if (vertex[1][1] < vertex[0][1]) std::swap(vertex[0], vertex[1]);
        if (vertex[2][1] < vertex[1][1]) std::swap(vertex[1], vertex[2]);
        if (vertex[1][1] < vertex[0][1]) std::swap(vertex[0], vertex[1]);
        begin = first_centre_above(vertex[0][1], height);
        middle = first_centre_above(vertex[1][1], height);
        end = first_centre_above(vertex[2][1], height);
    }
};

/// f(row, first, last): the pixels first ... last - 1 of each row in [begin, end) that the triangle covers, from the
/// bottom. Where the area is zero the crossings of both sides are equal, and there are none.
template <class F>
void for_spans(const SortedTriangle& t, std::int32_t width, std::int32_t begin, std::int32_t end, F f) {
    if (t.begin == t.end) return;
    const Edge whole(t.vertex[0], t.vertex[2]);
    const auto part = [&](std::int32_t from, std::int32_t to, const double* lower, const double* upper) {
        from = std::max(from, begin);
        to = std::min(to, end);
        if (from >= to) return;
        const Edge edge(lower, upper);
        for (std::int32_t j = from; j < to; ++j) {
            const std::int32_t x = crossing(whole, j, width), y = crossing(edge, j, width);
            if (x != y) f(j, std::min(x, y), std::max(x, y));
        }
    };
    part(t.begin, t.middle, t.vertex[0], t.vertex[1]);
    part(t.middle, t.end, t.vertex[1], t.vertex[2]);
}

}  // namespace barycert::raster

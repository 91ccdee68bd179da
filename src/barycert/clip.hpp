/// Clipping: what of a segment or triangle lies in a half-space, a box or the clip volume, with attributes.
///
/// A vertex is a row of numbers: its position, then its attributes. Where a bound cuts, a new vertex C stands between A
/// and B, and every one of its numbers, position and attributes alike, is V_C = W_A * V_A + (1 - W_A) * V_B.
///
/// Laws (each is a test of that name in tests/raster):
///   C1  Which part lies inside is decided exactly, for any finite numbers.
///   C2  Every number of a new vertex is the exact one rounded to nearest, ties to even: the exact one of the segment
///   or
///       triangle that was given, however many bounds have cut it. An exact zero is +0. Vertices that stay keep their
///       bits.
///   C3  The end of an edge has the same bits for both triangles that share the edge, in whatever order they name its
///       ends.
///   C4  What was clipped by a box or the clip volume lies in it, rounded as it is: clipping it again changes nothing.
///   D1  Answers depend on the numbers alone, not on the machine nor (D2) on the floating-point environment.
///
/// Why C4: rounding to nearest is monotonic and commutes with the sign. A new vertex lies exactly in the volume, so
/// that x <= w exactly, hence x <= w rounded; and where x = w exactly, both are rounded to the same number.
///
/// Not promised: that a new vertex, rounded, lies on the line of its edge, or in an oblique half-space.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/result.hpp"

namespace barycert {

/// The points x with normal . x + offset >= 0. The dimension is that of the segment; further entries are not used.
struct HalfSpace {
    std::array<double, 3> normal{};
    double offset = 0;
};

/// The points with min <= x <= max on each axis. Infinite where there is no bound.
struct ClipBox {
    std::array<double, 3> min{}, max{};
};

struct ClippedSegment {
    bool empty = true;                  ///< nothing lies inside; a and b are empty
    bool new_a = false, new_b = false;  ///< a bound has cut: that end is a new vertex
    std::vector<double> a, b;  ///< the ends of what lies inside, in the order of the segment; equal if that is a point
};

/// Clips the segment from a to b, each a row of `dimension` coordinates (1 to 3) and any attributes. What lies on a
/// bound is inside. Returns an Error if the rows differ in length or are shorter than the dimension, or a number is not
/// finite (bounds of a box may be infinite).
Result<ClippedSegment> clip_segment(int dimension, std::span<const double> a, std::span<const double> b,
                                    const HalfSpace& bound);
Result<ClippedSegment> clip_segment(int dimension, std::span<const double> a, std::span<const double> b,
                                    const ClipBox& box);

/// What became of a triangle.
enum class Clip : std::uint8_t {
    inside,   ///< all of it is inside
    cut,      ///< part of it
    outside,  ///< nothing, or only an edge or a corner
    at_eye,   ///< part of it, and this holds the point (0, 0, 0, 0), which is nowhere on a screen: what there is of the
              ///< rest is seen edge-on. Also where a new vertex is so near to it that its w is rounded to zero
};

/// The most vertices of a clipped triangle: each of the six bounds may cut off one corner.
inline constexpr int max_clipped_vertices = 9;

/// Clips a triangle in homogeneous coordinates, before the division, to the volume -w <= x, y, z <= w; all of it has
/// w >= 0, and what is behind the eye never wraps around. `vertices`: three rows of x, y, z, w and any attributes, one
/// after the other. `polygon` is replaced by the rows of the part inside, a convex polygon with the triangle's order of
/// vertices: the three of the triangle (inside), 3 to max_clipped_vertices (cut), or none. Returns an Error, and leaves
/// `polygon` as it was, if the rows are shorter than 4 or a number is not finite.
Result<Clip> clip_triangle(std::span<const double> vertices, std::vector<double>& polygon);

}  // namespace barycert

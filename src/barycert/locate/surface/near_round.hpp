/// The vertex, edge or face of a triangle that is nearest to a point, and the nearest point of that, rounded: what
/// floating point can say for certain, many at a time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace barycert::locate {

/// In a unit in which all numbers are at most 16 and the largest coordinate of corners is near 1.
struct NearPair {
    double point[3];
    double at[3][3];  ///< of corner, axis; for `round_nearest` those of the feature come first
};

/// masks[i]: of the corners of the feature of pair i that is nearest, a bit each; 0 where it is not certain.
void classify_nearest(const NearPair* pairs, std::size_t count, std::uint8_t* masks);

/// The projection of the point on the first `corners` corners, and its distance; all correctly rounded, if `certain`.
struct NearRounded {
    double distance, at[3], weights[3];
    bool certain;
};
void round_nearest(const NearPair* pairs, std::size_t count, int corners, NearRounded* to);

}  // namespace barycert::locate

/// Drift: how far the value of an attribute moves away from the exact one as a triangle in a window grows.
///
/// Enters: kernels on triangles. Cases as those of the family triangle.pixels: vertices on the grid of 1/256 pixel in
/// boxes of 4, 8, ... 4096 pixels, pixel centres in the triangle. Attributes are 1 to 2 at the vertices. That it is the
/// steps that tell, not the shape or the place: the box lies at the origin, and the triangle fills an eighth of it at
/// least.
/// Leaves: the largest error of the value by size. A kernel that steps from pixel to pixel drifts; one that computes
/// each pixel afresh does not.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/kernels.hpp"
#include "barycert/result.hpp"

namespace barycert {

struct DriftOptions {
    std::vector<Kernel> kernels;  ///< on triangles, without perspective
    std::uint64_t count = 10000;  ///< cases per size
    std::uint64_t seed = 1;
};

/// Of one kernel, over the cases of one size.
struct DriftPoint {
    int size = 0;                  ///< of the box, in pixels
    std::uint64_t cases = 0;       ///< with a finite value
    std::uint64_t not_finite = 0;  ///< without, or without an answer: the kernel crashed, hung or has been given up
    double worst_ulp = 0;          ///< largest error in ulps of the exact value, which is between 1 and 2
    double worst_relative = 0;     ///< largest |value / exact value - 1|
    std::uint64_t index = 0;       ///< of the worst case
};

struct DriftCurve {
    Kernel kernel;
    std::vector<DriftPoint> points;  ///< by ascending size
};

struct DriftReport {
    std::uint64_t seed = 0;
    std::uint64_t count = 0;
    std::vector<DriftCurve> curves;  ///< in the order of the kernels
};

/// Errors: no kernel, one that is not for triangles, count 0.
Result<DriftReport> measure_drift(const DriftOptions& options);

/// Case `index` of a size: the same on every machine.
Case drift_case(int size, std::uint64_t seed, std::uint64_t index);

}  // namespace barycert

/// Ray casting in rationals: what a pixel's centre sees of a triangle in clip space.
#pragma once

#include <optional>
#include <vector>

#include "barycert/raster.hpp"
#include "tests/draw/raster/rational.hpp"

namespace barycert {

struct RayHit {
    Rational depth;                    ///< z / w
    std::vector<Rational> attributes;  ///< linear on the triangle
};

/// Casts a ray from the eye through the centre of pixel (i, j) at the triangle (three rows of x, y, z, w, attributes).
/// Nothing if it misses the closed triangle, meets it behind the eye or outside the depths of sight, or edge-on.
std::optional<RayHit> cast_ray(const std::vector<double>& rows, RasterSize size, std::int32_t i, std::int32_t j);

}  // namespace barycert

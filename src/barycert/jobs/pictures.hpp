/// Parts of pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/jobs.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// A surface in the colours of its first field, if it has one. It must stay.
SurfaceView view_of(const Surface& surface);

/// Pixels over the box of these points (3 coordinates each) of a section by the plane. Error: a box without area, or a
/// picture that is too large.
Result<PixelGrid> pixels_over(const Plane& plane, const std::vector<double>& points, std::int64_t width);

}  // namespace barycert::jobs

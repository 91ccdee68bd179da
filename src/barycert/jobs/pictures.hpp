/// Parts of pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/jobs.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// What the job draws where that is no file: a triangle, a texture, a cube, or shapes that are clipped by a box.
Result<Scene> small_picture(const RenderJob& job);

/// A surface in the colours of its first field, if it has one. It must stay.
SurfaceView view_of(const Surface& surface);

/// Pixels over the box of these points (3 coordinates each) of a section by the plane. Error: a box without area, or a
/// picture that is too large.
Result<PixelGrid> pixels_over(const Plane& plane, const std::vector<double>& points, std::int64_t width);

}  // namespace barycert::jobs

/// Parts of pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/jobs.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// A triangle and segments with colours, before and after they are clipped by a box.
Result<Scene> clip_scene(RasterSize size);

/// The picture of a mesh: what of its report is its own.
Result<RenderReport> draw_mesh(const RenderJob& job);

/// Pixels over the box of these points (3 coordinates each) of a section by the plane. Error: a box without area, or a
/// picture that is too large.
Result<PixelGrid> pixels_over(const Plane& plane, const std::vector<double>& points, std::int64_t width);

}  // namespace barycert::jobs

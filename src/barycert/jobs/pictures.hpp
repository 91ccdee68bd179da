/// Pictures that have a source of their own.
#pragma once

#include "barycert/jobs.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// A triangle and segments with colours, before and after they are clipped by a box.
Result<Scene> clip_scene(RasterSize size);

/// The picture of a mesh: what of its report is its own.
Result<RenderReport> draw_mesh(const RenderJob& job);

}  // namespace barycert::jobs

/// Colours of samples to those of pixels.
#pragma once

#include <cstdint>
#include <span>

#include "barycert/raster.hpp"

namespace barycert::raster {

/// Rows of pixels from `row` on, each `samples` rows of samples; the mean in linear light, weighted with the opacity.
void resolve(std::span<const Rgba> colours, int samples, std::int32_t width, std::int32_t row, Image& image);

}  // namespace barycert::raster

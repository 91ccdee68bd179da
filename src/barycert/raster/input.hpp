/// What the functions of raster.hpp require of their input, as Errors.
#pragma once

#include <span>

#include "barycert/result.hpp"

namespace barycert::raster {

/// Three vertices with two finite coordinates each.
Status check_vertices(std::span<const double> vertices);

}  // namespace barycert::raster

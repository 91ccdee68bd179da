/// What a row has besides the values of point fields.
#pragma once

#include "barycert/sample/points/sampler_data.hpp"

namespace barycert::sample {

/// Sets the values of the cell fields of the cell, and what is computed at the point, into their columns of a row whose
/// values of point fields stand. `point`: where gradients on cells of second order are evaluated; not read if there are
/// none.
void set_rest_of_row(const SamplerData& data, Rounding rounding, Mesh::Index cell, const double* point, double* row);

}  // namespace barycert::sample

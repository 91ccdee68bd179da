/// Values for a point that no cell holds.
#pragma once

#include <optional>

#include "barycert/sample/points/sampler_data.hpp"

namespace barycert::sample {

/// Under the policies nearest and extrapolate: sets one value a column and returns the distance to the mesh; nothing if
/// no point of the mesh is within the limit. Point fields get, correctly rounded or plain as asked for, the value at
/// the orthogonal projection to the nearest vertex, edge or face, or that of the function of the nearest cell; cell
/// fields that of the nearest cell. On cells of second order the weights of the projection are rounded first, so that
/// they remain those of a point of the cell, then the quadratic is evaluated there.
std::optional<double> value_outside(const SamplerData& data, const SampleOptions& options, const double* point,
                                    double* values, TierCounts& tiers);

}  // namespace barycert::sample

/// The Euclidean length of a vector of doubles.
#pragma once

#include <span>

namespace barycert::sample {

/// sqrt(sum v_i^2), within 0.51 units in the last place of the exact length where that is not subnormal, else within
/// 0.76 (its unit may be twice that of the sum's root); infinite where that exceeds the doubles. NaN if a component is
/// NaN, else infinite if one is. Subnormal and huge components are no different from others.
double euclidean_length(std::span<const double> v);

}  // namespace barycert::sample

/// Internal: an exact point that two cells have in common.
#pragma once

#include "barycert/check.hpp"
#include "barycert/check/overlap.hpp"

namespace barycert::check {

/// What two closed cells have in common: its dimension (-1: nothing), and a point in its relative interior, computed in
/// integers. If the interiors meet, that point lies in both. Precondition: coordinates finite. Slow: tens of
/// microseconds, or up to some milliseconds (coordinates over the whole range of doubles, numbers of 30,000 bits).
struct Common {
    int dimension = -1;
    CommonPoint witness;
};
Common common_part(int d, const Corners& a, const Corners& b);

}  // namespace barycert::check

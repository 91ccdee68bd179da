/// An exact point that two cells share.
#pragma once

#include "barycert/check.hpp"
#include "barycert/check/names.hpp"
#include "barycert/index/overlap.hpp"

namespace barycert::check {

/// The intersection of two closed cells: its dimension (-1: empty) and a point in its relative interior, computed in
/// integers. If the interiors meet, that point lies in both. Precondition: coordinates finite. Slow: tens of
/// microseconds, or up to some milliseconds (coordinates over the whole range of doubles, numbers of 30,000 bits).
struct CommonPart {
    int dimension = -1;
    CommonPoint point;
};
CommonPart common_part(int d, const Corners& a, const Corners& b);

}  // namespace barycert::check

/// Shape measures of one cell, in plain floating point.
///
/// Enters: the edges of a cell from its first corner, divided by a power of two so that the largest component is in
/// [1, 2), and its volume in the same unit, accurately: plain formulas lose all its digits on slivers. In double where
/// the volume is at least 2^-300, for then no length is below that and no product of two underflows; else in long
/// double, whose exponents are enough for any cell.
#pragma once

namespace barycert::check {

struct Shape {
    double radius_edge = 0, aspect = 0;     ///< see measures.hpp
    double min_angle = 0, max_angle = 180;  ///< degrees
};

/// Corners 1, 2 (and 3) less corner 0, d numbers each; |volume|, 0 for a degenerate cell. Real is double or long
/// double.
template <class Real>
Shape shape(int d, const Real* edges, Real volume);

extern template Shape shape(int, const double*, double);
extern template Shape shape(int, const long double*, long double);

}  // namespace barycert::check

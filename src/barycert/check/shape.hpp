/// Internal: shape measures of one cell, in plain double.
///
/// Enters: a cell whose largest edge component is in [1, 2), relative to its first corner, and its volume, correctly
/// rounded. So nothing overflows, and the volume, where plain formulas lose all their digits on slivers, does not.
#pragma once

namespace barycert::check {

struct Shape {
    double radius_edge = 0, aspect = 0;     ///< see measures.hpp
    double min_angle = 0, max_angle = 180;  ///< degrees
};

/// Corners 1, 2 (and 3) less corner 0, d numbers each; |volume| in the same unit.
Shape shape(int d, const double* edges, double volume);

}  // namespace barycert::check

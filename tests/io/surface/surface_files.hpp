/// Surfaces for tests of their files.
#pragma once

#include <cmath>
#include <limits>

#include "barycert/surface.hpp"

namespace barycert::testing {

/// Two triangles with fields whose names are hard to write, and numbers that are hard to read back.
inline Surface two_triangles() {
    Surface s;
    s.points = {0.1, -1e300, 5e-324, 1, 0, 0, 1.0 / 3, 2, -0.25, 1e-5, 123456789.123456789, 7};
    s.cells = {0, 1, 2, 2, 1, 3};
    s.mesh_cells = {17, 4};
    s.point_fields = {{"T (K)", 1, {0.1, std::nan(""), -HUGE_VAL, 5e-324}},
                      {"u <&\"'> Größe", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0.7}},
                      {"x", 1, {1, 2, 3, 4}}};
    s.cell_fields = {{"region", 2, {1, 2, 3, 1.0 / 7}}};
    return s;
}

/// Two segments in the plane.
inline Surface two_segments() {
    Surface s;
    s.dimension = 2;
    s.points = {0.1, -1e300, 1, 0, 1.0 / 3, 2};
    s.cells = {0, 1, 1, 2};
    s.mesh_cells = {3, 9};
    s.point_fields = {{"T", 1, {0.1, 0.2, 0.3}}};
    s.cell_fields = {{"cell", 1, {5, 6}}};
    return s;
}

}  // namespace barycert::testing

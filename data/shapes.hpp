/// The shapes of data/plc, and the plane mesh that no mesher makes for us.
///
/// Coordinates come from +, -, *, / and sqrt, or are rounded to six decimals, so that every machine makes the same.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::data {

using Point = std::array<double, 3>;
using Ring = std::vector<int>;

struct Facet {
    std::vector<Ring> polygons;
    std::vector<Point> holes;
    int marker;
};

struct Shape {
    std::string name;  ///< with the extension that says the format
    std::string note;
    std::vector<Point> points;
    std::vector<Facet> facets;
    std::vector<Point> cavities;
};

/// x to six decimals: hides the last bits, in which mathematical libraries differ.
double rounded(double x);

std::vector<Shape> all_shapes();

/// A rectangle of 2 by 1 with a round hole: 2,040 triangles between 18 rings of 60 nodes, those within jittered.
Mesh plate();

}  // namespace barycert::data

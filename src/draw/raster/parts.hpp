/// Triangles and lines as what covers samples.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/raster.hpp"
#include "barycert/scene.hpp"
#include "draw/raster/layers.hpp"

namespace barycert::raster {

/// A triangle within the clip volume, in the window of samples. Numbers are finite, w > 0, the area in the window is
/// not zero.
struct Primitive {
    std::array<double, 6> window;  ///< x and y of each vertex
    std::array<double, 3> z;       ///< z / w, the depth
    std::array<double, 3> w;
    std::array<std::uint32_t, 3> rows;  ///< of their numbers: vertices, or, if it was clipped, rows of `cut`
    std::uint32_t source;               ///< the triangle, or the line
    bool clipped = false, line = false;
};

/// The parts that a range of triangles has become.
struct Parts {
    std::vector<Primitive> all;
    std::vector<double> cut;  ///< numbers of new vertices and those beside them
    RenderCounts counts;
};

/// Clips triangle after triangle, and appends what is left of them. `samples`: how many, across and up.
class Clipper {
public:
    Clipper(const Layers& layers, RasterSize samples, Parts& to) : layers_(layers), samples_(samples), to_(to) {}

    void add(std::size_t triangle);

private:
    const Layers& layers_;
    RasterSize samples_;
    Parts& to_;
    std::vector<double> rows_, polygon_;
    std::vector<std::array<double, 2>> window_;
};

/// A line as two triangles; nothing if an end is not before the eye, or both are at one place.
void add_line(const Layers& layers, std::size_t index, RasterSize samples, std::vector<Primitive>& to);

}  // namespace barycert::raster

/// Triangles with numbers at their vertices, and lines over them, drawn on all threads into pixels of several
/// samples each.
///
/// A pixel has samples * samples samples, at the centres of a raster that is so much finer: each is covered by the
/// triangles that raster.hpp's law R1 gives its centre to, and shows of these the one with the lowest depth, of equal
/// ones the first. The pixel's colour is the mean of its samples', in linear light, weighted with their opacity.
///
/// With one sample, with FillMethods of steps and with Rounding::correct numbers are computed at each sample. Else a
/// triangle has one colour in a pixel: that of the middle of the samples that it covers there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "barycert/raster.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"

namespace barycert::raster {

/// In clip space; its width in pixels. Drawn where no triangle is before it.
struct Line {
    std::array<std::array<double, 4>, 2> ends;
    double width = 1;
    Rgba colour{0, 0, 0, 255};
};

struct Layers {
    RasterSize size;
    int samples = 1;
    Rgba background{255, 255, 255, 255};
    std::span<const double> clip;  ///< x, y, z, w of each vertex in clip space, finite
    std::span<const std::int32_t> triangles;
    std::size_t numbers = 0;  ///< at each vertex
    std::function<void(std::size_t vertex, double* to)> number = {};
    std::function<Rgba(const double* numbers, std::size_t triangle)> colour = {};
    FillMethod method = FillMethod::barycentric;
    Interpolation interpolation = Interpolation::perspective;
    Rounding rounding = Rounding::plain;
    std::span<const Line> lines = {};
    PixelValues* kept = nullptr;  ///< with one sample: the numbers at each pixel
};

/// The matrix times each position: x, y, z, w. Exact and rounded once, if that is asked for.
std::vector<double> in_clip_space(std::span<const double> positions, const Matrix4& to_clip, Rounding rounding);

/// Counts are of samples, in place of pixels. Requires: sizes fit, and are valid.
Image draw(const Layers& layers, RenderCounts& counts);

}  // namespace barycert::raster

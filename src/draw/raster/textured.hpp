/// Textured triangles: what is drawn, on what.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/raster.hpp"

namespace barycert::raster {

/// Triangles to be drawn in the rows first_row, ..., end_row - 1 of an image. All has been checked.
struct TexturedWork {
    Image& image;
    const Texture& texture;
    std::span<const TexturedVertex> vertices;
    bool perspective;
    std::int32_t first_row, end_row;

    const TexturedVertex* corners(std::uint32_t triangle) const { return vertices.data() + std::size_t{3} * triangle; }
};

/// Draws these triangles, in this order, and returns the number of pixels. The pixels of a row do not depend on what
/// other rows are drawn.
std::size_t draw_triangles(const TexturedWork& work, std::span<const std::uint32_t> triangles);

}  // namespace barycert::raster

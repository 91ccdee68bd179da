/// Figures as pictures.
#pragma once

#include <cstdint>

#include "barycert/figure.hpp"
#include "barycert/result.hpp"
#include "draw/picture.hpp"

namespace barycert::draw {

/// Whether the figure can be drawn.
Status check(const Figure& figure);

enum class Form : std::uint8_t {
    image,    ///< what the camera sees
    vectors,  ///< polygons and lines in its place, where View::is_flat
};

/// The window with what the camera sees, axes, the colour bar, the title. Requires: check(figure).
Result<Picture> laid_out(const Figure& figure, Form form, FigureCounts& counts);

}  // namespace barycert::draw

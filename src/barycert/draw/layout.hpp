/// Figures as pictures.
#pragma once

#include "barycert/draw/picture.hpp"
#include "barycert/figure.hpp"

namespace barycert::draw {

/// Whether the figure can be drawn.
Status check(const Figure& figure);

/// The window with what the camera sees, axes, the colour bar, the title. `vectors`: what can be polygons is.
/// Precondition: check(figure).
Result<Picture> laid_out(const Figure& figure, bool vectors, FigureCounts& counts);

}  // namespace barycert::draw

/// Figures as pictures.
#pragma once

#include "barycert/draw/picture.hpp"
#include "barycert/figure.hpp"

namespace barycert::draw {

/// Whether the figure can be drawn.
Status check(const Figure& figure);

/// The window with what the camera sees, axes, the colour bar, the title. `resolution`: pixels of the image in it for
/// one of the picture. Precondition: check(figure).
Result<Picture> laid_out(const Figure& figure, double resolution, FigureCounts& counts);

}  // namespace barycert::draw

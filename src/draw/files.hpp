/// Pictures as files, and the font of their text: DejaVu Sans, so that a picture is the same on every machine.
#pragma once

#include <string>
#include <string_view>

#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "draw/picture.hpp"

namespace barycert::draw {

/// In pixels, of one line.
double text_width(std::string_view text, double size);

/// The picture in pixels, `scale` for one of its own. Error: as of blank_image; a side above 32767.
Result<Image> drawn(const Picture& picture, Rgba ground, double scale = 1);

/// The bytes of a file by its suffix; as SVG if it is none of is_figure_name.
Result<std::string> file_text(std::string_view path, const Picture& picture, Rgba ground = {255, 255, 255, 255},
                              double scale = 1);

/// By the suffix. `scale`: pixels of a .png for one of the picture. Error: as `drawn`; the file cannot be written.
Status write_picture(const std::string& path, const Picture& picture, Rgba ground, double scale = 1);

}  // namespace barycert::draw

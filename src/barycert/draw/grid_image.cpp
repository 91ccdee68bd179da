#include <algorithm>

#include "barycert/draw/view.hpp"

namespace barycert::draw {

GridImage::GridImage(const FigureGrid& grid, const ColourScale& scale) : grid_(grid), scale_(scale) {
    const double aspect = grid.spacing[0] / grid.spacing[1];
    constexpr double most = 1e15;  // more than a picture has
    const auto pixels = [&](double x) { return static_cast<std::size_t>(std::min(std::round(x), most)); };
    width_ = pixels(static_cast<double>(grid.width) * std::max(aspect, 1.0));
    height_ = pixels(static_cast<double>(grid.height) / std::min(aspect, 1.0));
}

void GridImage::row(std::size_t r, std::uint8_t* pixels) const {
    std::fill_n(pixels, 4 * width_, std::uint8_t{0});
    // Each shows the value whose place holds its middle.
    const std::size_t upwards = height_ - 1 - r;
    const std::size_t first = (2 * upwards + 1) * grid_.height / (2 * height_) * grid_.width;
    for (std::size_t x = 0; x < width_; ++x) {
        const std::size_t i = first + (2 * x + 1) * grid_.width / (2 * width_);
        if (!is_drawn(grid_, scale_.log, i)) continue;
        const Rgba colour = scale_(grid_.values[i]);
        std::copy_n(colour.data(), 4, pixels + 4 * x);
    }
}

}  // namespace barycert::draw

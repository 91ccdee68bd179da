/// Colours of values.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/raster.hpp"
#include "draw/picture.hpp"

namespace barycert::draw {

using ColourMap = std::array<Rgba, 256>;

/// One of colour_map_names(); NAME_r is the same from its other end. Nothing if there is none.
std::optional<ColourMap> colour_map(std::string_view name);

/// Where x lies between the ends of a range: 0 at `low`, 1 at `high`, beyond them less or more. Where both are one
/// number 0.5 there, 0 below it and 1 above. Finite numbers.
double place_in_range(double x, double low, double high);

/// The range in 256 equal parts, of its logarithm if `log`; beyond it its ends. Or labels, ascending: a colour each.
struct ColourScale {
    ColourMap map{};
    double low = 0, high = 1;
    bool log = false;
    std::vector<double> labels = {};
    Rgba no_value{150, 150, 150, 255};

    Rgba operator()(double x) const;
    /// 0 at `low`, 1 at `high`. Requires: x > 0 if `log`.
    double place(double x) const;
};

/// A bar with a scale's colours, round numbers beside it, a title above; below it what is drawn outside of the range.
struct ColourBar {
    ColourScale scale;
    std::string title = {};                           ///< the field, its component and unit
    std::vector<std::string> names = {};              ///< of labels
    bool below = false, above = false, none = false;  ///< there is something of these

    double width() const;
    double least_height() const;
    /// Into the picture, from `corner` on, `height` tall.
    void draw(Picture& picture, Pixel corner, double height) const;
};

}  // namespace barycert::draw

// Options of pictures.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "app/cli/options.hpp"
#include "barycert/figure.hpp"
#include "barycert/raster.hpp"
#include "barycert/scene.hpp"
#include "barycert/surface.hpp"
#include "core/base/text.hpp"
#include "draw/colour_map.hpp"

namespace barycert::cli {
namespace {

/// The help behind "Picture: "; alone it begins with a capital.
std::string with_heading(Text what, std::string help) {
    if (what.empty()) help.front() = static_cast<char>(std::toupper(help.front()));
    return what + help;
}

}  // namespace

std::optional<Plane> plane_of(const std::string& given) {
    std::string text = given;
    std::erase(text, ' ');
    const std::size_t axis = std::string_view("xyzXYZ").find(text[0]);  // of no text: none
    if (axis != std::string_view::npos && text.size() > 2 && text[1] == '=') {
        const std::optional<double> offset = finite(std::string_view(text).substr(2));
        if (!offset) return std::nullopt;
        Plane plane{{0, 0, 0}, *offset};
        plane.normal[axis % 3] = 1;
        return plane;
    }
    const auto n = numbers(',', finite, 4, 4)(text);
    if (!n || ((*n)[0] == 0 && (*n)[1] == 0 && (*n)[2] == 0)) return std::nullopt;
    return Plane{{(*n)[0], (*n)[1], (*n)[2]}, (*n)[3]};
}

void Options::figure(FigureOptions& f, Text what) const {
    const auto help = [&](const char* text) { return with_heading(what, text); };
    parsed("--range", "MIN,MAX",
           help("the values of the first and the last colour; default: min and max of the values drawn"),
           "MIN,MAX, finite numbers, MIN < MAX", f.range, [](Text text) {
               const auto ends = ends_of(text);
               return ends && ends->first < ends->second ? ends : std::nullopt;
           });
    flag("--log", f.log, help("colours by the logarithm of values, which are to be above 0"));
    flag("--labels", f.labels, help("a colour of its own for each value, 12 at most, such as numbers of materials"));
    parsed("--colormap", "NAME",
           help("colours from low to high, by matplotlib's names; NAME_r: turned round; default: ") + f.colour_map,
           fmt::format("{}, perhaps with _r", fmt::join(colour_map_names(), "|")), f.colour_map,
           [](Text text) { return draw::colour_map(text) ? std::optional(text) : std::nullopt; });
    text("--title", f.title, help("what stands above it"), "TEXT");
    text("--unit", f.unit, help("of the values, at the colour bar"), "TEXT");
    flag("--no-bar", f.bar, help("no colour bar"), false);
    parsed("--background", "COLOUR", help("white (default), black, dark, none or #RRGGBB; text on a dark one is light"),
           "white, black, dark, none or #RRGGBB", f.background, [](Text text) -> std::optional<Rgba> {
               if (text == "white") return Rgba{255, 255, 255, 255};
               if (text == "black") return Rgba{0, 0, 0, 255};
               if (text == "dark") return Rgba{21, 25, 28, 255};
               if (text == "none") return Rgba{255, 255, 255, 0};
               const auto all = text.size() == 7 && text[0] == '#'
                                    ? base::whole_number<std::uint32_t, 16>(text.substr(1))
                                    : std::nullopt;
               if (!all) return std::nullopt;
               const auto byte = [&](unsigned shift) { return static_cast<std::uint8_t>(*all >> shift & 255U); };
               return Rgba{byte(16), byte(8), byte(0), 255};
           });
    choice<Axes>(
        "--axes", f.axes,
        {{"automatic", Axes::automatic}, {"box", Axes::box}, {"triad", Axes::triad}, {"none", Axes::none}},
        help("automatic (default): with numbers in the plane, a triad in space; box: around what is in space, with "
             "numbers"));
    parsed("--resolution", "N", help("pixels of a .png for one of its size, above 0, at most 32; default: 1"),
           "a number above 0, at most 32", f.resolution, [](Text text) {
               const auto x = positive(text);
               return x && *x <= 32 ? x : std::nullopt;
           });
}

void Options::view(FigureOptions& f, Text what) const {
    const auto help = [&](const char* text) { return with_heading(what, text); };
    integer("--samples", f.samples, 1, max_samples, help("of each pixel, across and up; 1: no smooth edges"));
    size(f.size);
    const auto aim = [&camera = f.camera](const std::optional<std::pair<double, double>>& angles) {
        if (angles) std::tie(camera.azimuth, camera.elevation) = *angles;
        return angles.has_value();
    };
    auto* const view = taken("--view", "NAME", help("where the camera stands: iso, or on the side +x, -x, ..., -z"),
                             "iso, +x, -x, +y, -y, +z or -z", [aim](Text text) { return aim(angles_of(text)); });
    taken("--camera", "AZIMUTH,ELEVATION",
          help("the same in degrees: from the x axis towards y, and above the xy plane; default: 30,25"),
          "AZIMUTH,ELEVATION, finite numbers of degrees", [aim](Text text) { return aim(ends_of(text)); })
        ->excludes(view);
    parsed("--zoom", "FACTOR", help("above 1: nearer; default: 1"), "a number above 0", f.camera.zoom, positive);
    flag("--parallel", f.camera.parallel, help("no perspective"));
}

void Options::edges(bool& edges, bool& outline, Text what) const {
    flag("--edges", edges, with_heading(what, "the edges of cells on what is drawn"));
    flag("--outline", outline, with_heading(what, "edges where the boundary of the mesh bends by 30 degrees or more"));
}

void Options::size(RasterSize& size) const {
    parsed("--size", "WxH", fmt::format("Width and height in pixels; default: {}x{}", size.width, size.height),
           fmt::format("width and height in pixels, 1 to {}, such as 640x480", max_raster_side), size,
           [](Text text) -> std::optional<RasterSize> {
               const auto sides = numbers('x', count_of, 2, 2)(text);
               if (!sides || std::max((*sides)[0], (*sides)[1]) > max_raster_side) return std::nullopt;
               return RasterSize{static_cast<std::int32_t>((*sides)[0]), static_cast<std::int32_t>((*sides)[1])};
           });
}

}  // namespace barycert::cli

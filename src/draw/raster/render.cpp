#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"
#include "draw/raster/colour_bytes.hpp"
#include "draw/raster/layers.hpp"

namespace barycert {
namespace raster {
namespace {

Error misfit(const std::string& what, const std::string& expected, const std::string& found) {
    return {.code = "scene.member", .what = what, .expected = expected, .found = found, .remedy = "correct the scene"};
}

/// An array has finite numbers for each of `vertices`, or none.
Status check_array(const std::vector<double>& numbers, std::size_t per_vertex, std::size_t vertices,
                   const std::string& what) {
    if (numbers.empty()) return Done{};
    if (numbers.size() != per_vertex * vertices)
        return misfit("the " + what + "s of the scene",
                      std::to_string(per_vertex) + " numbers for each of " + std::to_string(vertices) + " vertices",
                      std::to_string(numbers.size()) + " numbers");
    const std::size_t i = base::first_not_finite(numbers);
    if (i == numbers.size()) return Done{};
    return base::not_finite(
        "number " + std::to_string(i % per_vertex) + " of the " + what + " of vertex " + std::to_string(i / per_vertex),
        numbers[i], "correct the scene");
}

Status check_choices(const Scene& s) {
    if (s.texture) {
        if (Status good = check_image(s.texture->image); !good) return good;
        if (s.texture_coordinates.empty() && !s.positions.empty())
            return misfit("a texture", "texture coordinates at the vertices", "none");
    }
    if (s.rounding == Rounding::plain) return Done{};
    if (s.method != FillMethod::barycentric)
        return misfit("correct rounding", "method barycentric", "a method of steps or auxiliary lines");
    if (s.interpolation == Interpolation::projected_z)
        return misfit("correct rounding", "perspective or affine interpolation", "projected z, which is wrong as such");
    return Done{};
}

Status check(const Scene& s) {
    if (Status good = check_raster_size(s.size); !good) return good;
    if (std::int64_t{s.size.width} * s.size.height > max_image_pixels)
        return misfit("the picture is too large", "at most " + std::to_string(max_image_pixels) + " pixels",
                      std::to_string(s.size.width) + " by " + std::to_string(s.size.height));
    if (s.samples < 1 || s.samples > max_samples)
        return misfit("samples a pixel, across and up", "1 to " + std::to_string(max_samples),
                      std::to_string(s.samples));
    if (s.positions.size() % 4 != 0)
        return misfit("the positions of the scene", "x, y, z, w of each vertex",
                      std::to_string(s.positions.size()) + " numbers");
    const std::size_t vertices = s.positions.size() / 4;
    if (Status good = check_array(s.positions, 4, vertices, "position"); !good) return good;
    if (Status good = check_array(s.colours, 3, vertices, "colour"); !good) return good;
    if (Status good = check_array(s.texture_coordinates, 2, vertices, "texture coordinate"); !good) return good;
    if (s.triangles.size() % 3 != 0)
        return misfit("the triangles of the scene", "three vertices each",
                      std::to_string(s.triangles.size()) + " indices");
    for (std::size_t i = 0; i < s.triangles.size(); ++i) {
        if (s.triangles[i] < 0 || static_cast<std::size_t>(s.triangles[i]) >= vertices)
            return misfit("vertex " + std::to_string(i % 3) + " of triangle " + std::to_string(i / 3),
                          "an index below " + std::to_string(vertices), std::to_string(s.triangles[i]));
    }
    if (const std::size_t i = base::first_not_finite(s.to_clip.m); i != s.to_clip.m.size())
        return misfit("the matrix of the scene", "finite numbers", std::to_string(s.to_clip.m[i]));
    return check_choices(s);
}

/// Numbers of a vertex or pixel from which its colour is made: the colour if there is one, u and v likewise.
std::size_t attribute_count(const Scene& s) {
    return (s.colours.empty() ? 0U : 3U) + (s.texture_coordinates.empty() ? 0U : 2U);
}

/// NaN counts as 0.
Rgba colour_of(const Scene& s, const double* attributes) {
    const bool colours = !s.colours.empty();
    const double* const place = attributes + (colours ? 3 : 0);
    Rgba result{0, 0, 0, 255};
    if (s.texture) result = texel(*s.texture, place[0], place[1]);
    if (!colours) return result;
    for (std::size_t k = 0; k < 3; ++k)
        result[k] = !s.texture ? component_byte(attributes[k])
                               : component_byte(std::clamp(attributes[k], 0.0, 1.0) * (result[k] / 255.0));
    return result;
}

/// Appends the vertex's colour if there is one, then likewise its u and v.
void append_numbers(const Scene& s, std::size_t vertex, double* to) {
    if (!s.colours.empty()) to = std::copy_n(s.colours.data() + 3 * vertex, 3, to);
    if (!s.texture_coordinates.empty()) std::copy_n(s.texture_coordinates.data() + 2 * vertex, 2, to);
}

}  // namespace
}  // namespace raster

Result<Image> render(const Scene& scene, RenderCounts* counts, PixelValues* attributes) {
    const ExactEnvironment environment;
    if (Status good = raster::check(scene); !good) return good.error();
    if (attributes != nullptr && scene.samples != 1)
        return raster::misfit("attributes at pixels", "one sample a pixel", std::to_string(scene.samples));
    const std::vector<double> clip = raster::in_clip_space(scene.positions, scene.to_clip, scene.rounding);
    if (const std::size_t i = base::first_not_finite(clip); i != clip.size())
        return raster::misfit("vertex " + std::to_string(i / 4), "coordinates that do not overflow in clip space",
                              std::to_string(clip[i]));
    raster::Layers layers{.size = scene.size,
                          .samples = scene.samples,
                          .background = scene.background,
                          .clip = clip,
                          .triangles = scene.triangles,
                          .numbers = raster::attribute_count(scene),
                          .method = scene.method,
                          .interpolation = scene.interpolation,
                          .rounding = scene.rounding,
                          .kept = attributes};
    layers.number = [&](std::size_t vertex, double* to) { raster::append_numbers(scene, vertex, to); };
    layers.colour = [&](const double* numbers, std::size_t) { return raster::colour_of(scene, numbers); };
    if (attributes != nullptr) {
        Result<PixelValues> empty = empty_pixels(scene.size, static_cast<int>(layers.numbers));
        if (!empty) return empty.error();
        *attributes = std::move(*empty);
    }
    RenderCounts told;
    Image image = raster::draw(layers, told);
    if (counts != nullptr) *counts = told;
    return image;
}

}  // namespace barycert

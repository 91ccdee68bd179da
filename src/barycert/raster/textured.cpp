#include "barycert/raster.hpp"

#include <cmath>
#include <string>

#include "barycert/environment.hpp"
#include "barycert/raster/textured_lanes.hpp"

namespace barycert {
namespace {

Status check_textured(const Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                      bool perspective) {
    if (Status s = check_image(image); !s) return s;
    if (Status s = check_image(texture.image); !s) return s;
    if (Status s = check_raster_size({image.width, image.height}); !s) return s;
    if (texture.filter != Filter::nearest)
        return Error{.what = "the filter of a texture that is drawn on lanes",
                     .expected = "Filter::nearest",
                     .remedy = "use render() of scene.hpp, which filters"};
    if (vertices.size() % 3 != 0)
        return Error{.what = "number of vertices",
                     .expected = "three for each triangle",
                     .found = std::to_string(vertices.size())};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const TexturedVertex& t = vertices[i];
        const bool finite = std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.u) && std::isfinite(t.v);
        if (!finite || !std::isfinite(t.w) || (perspective && !(t.w > 0)))
            return Error{.what = "vertex " + std::to_string(i % 3) + " of triangle " + std::to_string(i / 3),
                         .expected = perspective ? "finite numbers, w > 0" : "finite numbers",
                         .found = finite ? "w = " + std::to_string(t.w) : "one that is not finite"};
    }
    return Done{};
}

}  // namespace

Result<std::size_t> draw_textured(Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                                  bool perspective) {
    const ExactEnvironment environment;
    if (Status s = check_textured(image, texture, vertices, perspective); !s) return s.error();
    const raster::PixelRows out{reinterpret_cast<std::uint32_t*>(image.data.data()), image.width, image.height};
    const raster::TexelRows texels{reinterpret_cast<const std::uint32_t*>(texture.image.data.data()),
                                   texture.image.width, texture.image.height, texture.wrap};
    return raster::draw_lanes(out, texels, vertices, perspective);
}

}  // namespace barycert

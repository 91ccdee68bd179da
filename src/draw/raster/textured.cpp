// Textured triangles: checked, and drawn band by band of the image, each band by one thread.
#include "draw/raster/textured.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "core/base/lists.hpp"
#include "draw/raster/edge.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace raster {
namespace {

Status check_textured(const Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                      bool perspective) {
    if (Status s = check_image(image); !s) return s;
    if (Status s = check_image(texture.image); !s) return s;
    if (Status s = check_raster_size({image.width, image.height}); !s) return s;
    if (texture.filter != Filter::nearest)
        return file_error("argument.value", {}, "the filter of a texture that is drawn on lanes", "Filter::nearest", "",
                          "use render() of scene.hpp, which filters");
    if (vertices.size() % 3 != 0)
        return file_error("argument.size", {}, "number of vertices", "three for each triangle",
                          std::to_string(vertices.size()));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const TexturedVertex& t = vertices[i];
        const bool finite = std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.u) && std::isfinite(t.v);
        if (!finite || !std::isfinite(t.w) || (perspective && !(t.w > 0)))
            return file_error("argument.value", {},
                              "vertex " + std::to_string(i % 3) + " of triangle " + std::to_string(i / 3),
                              perspective ? "finite numbers, w > 0" : "finite numbers",
                              finite ? "w = " + std::to_string(t.w) : "one that is not finite");
    }
    return Done{};
}

/// Rows of the image that are drawn by one thread. Such a band is small enough for a near cache: small triangles come
/// in any order, and each row of one would else wait for a line of the image.
std::int32_t rows_of_band(const Image& image) {
    constexpr std::int32_t near_pixels = 1 << 16, most_bands = 64;
    return std::max({std::int32_t{16}, near_pixels / image.width, (image.height + most_bands - 1) / most_bands});
}

/// Bands that a triangle meets: first, ..., end - 1.
struct Met {
    std::int32_t first, end;
};

}  // namespace
}  // namespace raster

Result<std::size_t> draw_textured(Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                                  bool perspective, int threads) {
    using namespace raster;
    const ExactEnvironment environment;
    if (Status s = check_textured(image, texture, vertices, perspective); !s) return s.error();
    constexpr std::size_t together = 1 << 16;  // triangles: bounds the memory of the lists
    const std::int32_t rows = rows_of_band(image);
    const auto bands = static_cast<std::size_t>((image.height + rows - 1) / rows);
    std::vector<Met> met;
    std::atomic<std::size_t> drawn{0};
    for (std::size_t begin = 0; begin < vertices.size() / 3; begin += together) {
        const std::size_t end = std::min(vertices.size() / 3, begin + together);
        std::size_t rows_of_triangles = 0;
        met.resize(end - begin);
        for (std::size_t k = begin; k < end; ++k) {
            const auto [low, high] = std::minmax({vertices[3 * k].y, vertices[3 * k + 1].y, vertices[3 * k + 2].y});
            const std::int32_t first = first_centre_above(low, image.height);
            const std::int32_t last = first_centre_above(high, image.height);
            rows_of_triangles += static_cast<std::size_t>(last - first);
            met[k - begin] = {first / rows, first == last ? first / rows : (last - 1) / rows + 1};
        }
        const base::Lists<std::uint32_t> triangles(bands, [&](const auto& add) {
            for (std::size_t k = begin; k < end; ++k) {
                for (std::int32_t b = met[k - begin].first; b < met[k - begin].end; ++b)
                    add(static_cast<std::size_t>(b), static_cast<std::uint32_t>(k));
            }
        });
        // Measures the work in points: a row takes a fourth of the time of a point.
        base::in_arena(threads, rows_of_triangles / 4, [&] {
            base::parallel_for(bands, [&](std::size_t b) {
                const std::int32_t row = static_cast<std::int32_t>(b) * rows;
                drawn += draw_triangles(
                    {image, texture, vertices, perspective, row, std::min(image.height, row + rows)}, triangles[b]);
            });
        });
    }
    return drawn.load();
}

}  // namespace barycert

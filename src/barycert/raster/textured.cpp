// Textured triangles: checked, and drawn band by band of the image, each band by one thread.
#include "barycert/raster/textured.hpp"

#include <atomic>

#include "barycert/base/arena.hpp"
#include "barycert/base/finite.hpp"
#include "barycert/base/lists.hpp"
#include "barycert/environment.hpp"
#include "barycert/raster/edge.hpp"

namespace barycert {
namespace raster {
namespace {

Status check_textured(const Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                      bool perspective) {
    if (Status s = check_image(image); !s) return s;
    if (Status s = check_image(texture.image); !s) return s;
    if (Status s = check_raster_size({image.width, image.height}); !s) return s;
    if (texture.filter != Filter::nearest)
        return file_error({}, "the filter of a texture that is drawn on lanes", "Filter::nearest", "",
                          "use render() of scene.hpp, which filters");
    if (vertices.size() % 3 != 0)
        return file_error({}, "number of vertices", "three for each triangle", std::to_string(vertices.size()));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const TexturedVertex& t = vertices[i];
        const bool finite = std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.u) && std::isfinite(t.v);
        if (!finite || !std::isfinite(t.w) || (perspective && !(t.w > 0)))
            return file_error({}, "vertex " + std::to_string(i % 3) + " of triangle " + std::to_string(i / 3),
                              perspective ? "finite numbers, w > 0" : "finite numbers",
                              finite ? "w = " + std::to_string(t.w) : "one that is not finite");
    }
    return Done{};
}

/// Bands of rows, and the triangles that meet each, in their order. A band is small enough for a near cache: small
/// triangles come in any order, and each row of one would else wait for a line of the image.
class Bands {
public:
    Bands(std::int32_t width, std::int32_t height)
        : height_(height),
          rows_(std::max({std::int32_t{16}, near_pixels / width, (height + most_bands - 1) / most_bands})) {}

    std::size_t count() const { return static_cast<std::size_t>((height_ + rows_ - 1) / rows_); }
    std::int32_t first_row(std::size_t band) const { return static_cast<std::int32_t>(band) * rows_; }
    std::int32_t end_row(std::size_t band) const { return std::min(height_, first_row(band) + rows_); }
    /// Of work: a row takes a fourth of the time of a point.
    std::size_t pieces() const { return rows_of_triangles_ / 4; }
    std::span<const std::uint32_t> triangles(std::size_t band) const { return lists_[band]; }

    /// Takes the triangles begin, ..., end - 1.
    void sort(std::span<const TexturedVertex> vertices, std::size_t begin, std::size_t end) {
        met_.resize(end - begin);
        rows_of_triangles_ = 0;
        for (std::size_t k = begin; k < end; ++k) {
            const auto [low, high] = std::minmax({vertices[3 * k].y, vertices[3 * k + 1].y, vertices[3 * k + 2].y});
            const std::int32_t first = first_centre_above(low, height_), last = first_centre_above(high, height_);
            rows_of_triangles_ += static_cast<std::size_t>(last - first);
            met_[k - begin] = {first / rows_, first == last ? first / rows_ : (last - 1) / rows_ + 1};
        }
        lists_ = {count(), [&](const auto& add) {
                      for (std::size_t k = begin; k < end; ++k) {
                          for (std::int32_t b = met_[k - begin].first; b < met_[k - begin].end; ++b)
                              add(static_cast<std::size_t>(b), static_cast<std::uint32_t>(k));
                      }
                  }};
    }

private:
    static constexpr std::int32_t near_pixels = 1 << 16, most_bands = 64;
    struct Met {
        std::int32_t first, end;
    };

    std::int32_t height_, rows_;
    std::size_t rows_of_triangles_ = 0;
    std::vector<Met> met_;
    base::Lists<std::uint32_t> lists_;  ///< triangles of each band
};

}  // namespace
}  // namespace raster

Result<std::size_t> draw_textured(Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                                  bool perspective, int threads) {
    using namespace raster;
    const ExactEnvironment environment;
    if (Status s = check_textured(image, texture, vertices, perspective); !s) return s.error();
    constexpr std::size_t together = 1 << 16;  // triangles: bounds the memory of the lists
    Bands bands(image.width, image.height);
    std::atomic<std::size_t> drawn{0};
    for (std::size_t begin = 0; begin < vertices.size() / 3; begin += together) {
        bands.sort(vertices, begin, std::min(vertices.size() / 3, begin + together));
        base::in_arena(threads, bands.pieces(), [&] {
            base::parallel_for(bands.count(), [&](std::size_t b) {
                drawn += draw_triangles({image, texture, vertices, perspective, bands.first_row(b), bands.end_row(b)},
                                        bands.triangles(b));
            });
        });
    }
    return drawn.load();
}

}  // namespace barycert

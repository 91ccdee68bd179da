#include <algorithm>
#include <cmath>
#include <string>

#include "barycert/base/finite.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/core/exact_tier.hpp"
#include "barycert/environment.hpp"
#include "barycert/predicates.hpp"
#include "barycert/raster.hpp"
#include "barycert/raster/draw.hpp"
#include "barycert/scene.hpp"

namespace barycert {
namespace raster {
namespace {

Error misfit(const std::string& what, const std::string& expected, const std::string& found) {
    return {.what = what, .expected = expected, .found = found, .remedy = "correct the scene"};
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

/// All vertices in clip space.
Result<std::vector<double>> clip_positions(const Scene& s) {
    std::vector<double> clip(s.positions.size());
    for (std::size_t i = 0; i < clip.size(); i += 4) {
        const double* const p = s.positions.data() + i;
        for (std::size_t r = 0; r < 4; ++r) {
            const double* const m = s.to_clip.m.data() + 4 * r;
            clip[i + r] = s.rounding == Rounding::correct ? core::exact_dot(m, p, 4)
                                                          : m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3] * p[3];
            if (!std::isfinite(clip[i + r]))
                return misfit("vertex " + std::to_string(i / 4), "coordinates that do not overflow in clip space",
                              std::to_string(clip[i + r]));
        }
    }
    return clip;
}

class Renderer {
public:
    Renderer(const Scene& scene, Canvas& canvas, std::vector<double> clip)
        : scene_(scene), canvas_(canvas), clip_(std::move(clip)) {}

    void run() {
        for (std::size_t t = 0; t < scene_.triangles.size(); t += 3) draw(scene_.triangles.data() + t);
        counts_.pixels = static_cast<std::uint64_t>(
            std::count_if(canvas_.depth.begin(), canvas_.depth.end(), [](double z) { return z < HUGE_VAL; }));
    }

private:
    void draw(const std::int32_t* corners) {
        ++counts_.triangles;
        const std::size_t n = canvas_.shading.components(), stride = 4 + n;
        rows_.clear();
        for (int c = 0; c < 3; ++c) append_row(static_cast<std::size_t>(corners[c]));
        // No error can occur: all numbers are finite.
        const Clip clip = clip_triangle(rows_, polygon_).value();
        counts_.clipped += static_cast<std::uint64_t>(clip == Clip::cut);
        if (clip == Clip::outside || clip == Clip::at_eye) {
            ++(clip == Clip::outside ? counts_.outside : counts_.degenerate);
            return;
        }
        bool area = false;
        const std::uint64_t covered = counts_.covered;
        const std::size_t vertices = polygon_.size() / stride;
        window_.clear();
        for (std::size_t i = 0; i < vertices; ++i) {
            const double* const row = polygon_.data() + stride * i;
            window_.push_back(viewport(scene_.size, row[0], row[1], row[3], scene_.rounding));
        }
        for (std::size_t i = 1; i + 1 < vertices; ++i) {
            const std::size_t fan[3] = {0, i, i + 1};
            if (orient2d(window_[0].data(), window_[i].data(), window_[i + 1].data()) == Sign::zero) continue;
            area = true;
            draw_part(fan);
        }
        ++(!area ? counts_.degenerate : counts_.covered == covered ? counts_.between_pixels : counts_.drawn);
    }

    /// A triangle of the fan.
    void draw_part(const std::size_t (&fan)[3]) {
        const std::size_t n = canvas_.shading.components(), stride = 4 + n;
        WindowTriangle part;
        attributes_.clear();
        for (std::size_t i = 0; i < 3; ++i) {
            const double* const row = polygon_.data() + stride * fan[i];
            part.window[2 * i] = window_[fan[i]][0];
            part.window[2 * i + 1] = window_[fan[i]][1];
            part.z[i] = row[2] / row[3];
            part.w[i] = row[3];
            attributes_.insert(attributes_.end(), row + 4, row + stride);
        }
        part.attributes = attributes_;
        draw_triangle(canvas_, part);
    }

    void append_row(std::size_t vertex) {
        const auto append = [&](const std::vector<double>& all, std::size_t count) {
            if (all.empty()) return;
            const double* const from = all.data() + count * vertex;
            rows_.insert(rows_.end(), from, from + count);
        };
        append(clip_, 4);
        append(scene_.colours, 3);
        append(scene_.texture_coordinates, 2);
    }

    const Scene& scene_;
    Canvas& canvas_;
    std::vector<double> clip_;
    std::vector<double> rows_, polygon_, attributes_;
    std::vector<std::array<double, 2>> window_;
    RenderCounts& counts_ = canvas_.counts;
};

}  // namespace
}  // namespace raster

Result<Image> render(const Scene& scene, RenderCounts* counts, PixelValues* attributes) {
    const ExactEnvironment environment;
    if (Status good = raster::check(scene); !good) return good.error();
    Result<std::vector<double>> clip = raster::clip_positions(scene);
    if (!clip) return clip.error();
    raster::Canvas canvas;
    canvas.image = blank_image(scene.size.width, scene.size.height, scene.background).value();  // its size is checked
    canvas.depth.assign(canvas.image.data.size() / 4, HUGE_VAL);
    canvas.shading = {!scene.colours.empty(),
                      !scene.texture_coordinates.empty(),
                      scene.texture ? &*scene.texture : nullptr,
                      scene.method,
                      scene.interpolation,
                      scene.rounding};
    if (attributes != nullptr) {
        Result<PixelValues> empty = empty_pixels(scene.size, static_cast<int>(canvas.shading.components()));
        if (!empty) return empty.error();
        *attributes = std::move(*empty);
        canvas.attributes = attributes;
    }
    raster::Renderer(scene, canvas, std::move(*clip)).run();
    if (counts != nullptr) *counts = canvas.counts;
    return std::move(canvas.image);
}

}  // namespace barycert

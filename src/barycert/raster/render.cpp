#include "barycert/base/finite.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/core/exact_tier.hpp"
#include "barycert/environment.hpp"
#include "barycert/perspective.hpp"
#include "barycert/raster/colour_bytes.hpp"
#include "barycert/raster/fill_rows.hpp"
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

/// A triangle within the clip volume, in the window. Numbers are finite, w > 0, the area in the window is not zero.
struct WindowTriangle {
    std::array<double, 6> window;  ///< x and y of each vertex
    std::array<double, 3> z;       ///< z / w, the depth
    std::array<double, 3> w;
    std::vector<double> attributes;  ///< attribute_count numbers a vertex
};

/// False where plain weights may be off by more than 2^-38. With X and Y the extent of the triangle, a pixel's centre
/// in it is within X and Y of each vertex, so that the four differences of a signed area are exact or off by half an
/// ulp, and the area by at most 2 * 3.01 * 2^-53 X Y + 2^-53 X Y < 2^-50 X Y. Twice the triangle's area D is as exact.
/// For |D| >= 2^-11 X Y the quotient of both is off by less than 2^-50 * 2^11 * 2 + 2^-53 < 2^-37.9.
bool thick_enough(const std::array<double, 6>& v) {
    const double area = (v[2] - v[0]) * (v[5] - v[1]) - (v[4] - v[0]) * (v[3] - v[1]);
    const double wide = std::max({v[0], v[2], v[4]}) - std::min({v[0], v[2], v[4]});
    const double tall = std::max({v[1], v[3], v[5]}) - std::min({v[1], v[3], v[5]});
    return std::abs(area) >= 0x1p-11 * wide * tall;
}

/// The depth and the attributes of `count` pixels from what is linear in the window, in place.
///
/// With perspective, 1/w and v/w are interpolated. All are multiplied by the least w, so that 1/w cannot overflow; it
/// may underflow, for a vertex 2^1074 times as far away as another one, whose share is then below the last place.
void divide_by_scale(double* numbers, std::size_t attributes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const double* const in = numbers + (2 + attributes) * i;
        double* const to = numbers + (1 + attributes) * i;  // never ahead of what is still to be read
        const double depth = in[0], scale = in[1];
        to[0] = depth;
        for (std::size_t k = 0; k < attributes; ++k) to[1 + k] = in[2 + k] / scale;
    }
}

class Renderer {
public:
    /// `attributes`: of each pixel, if they are wanted. The size of the scene is checked.
    Renderer(const Scene& scene, std::vector<double> clip, PixelValues* attributes)
        : scene_(scene),
          clip_(std::move(clip)),
          image_(blank_image(scene.size.width, scene.size.height, scene.background).value()),
          depth_(image_.data.size() / 4, HUGE_VAL),
          attributes_(attributes) {}

    Image run(RenderCounts* counts) {
        for (std::size_t t = 0; t < scene_.triangles.size(); t += 3) draw(scene_.triangles.data() + t);
        counts_.pixels =
            static_cast<std::uint64_t>(std::ranges::count_if(depth_, [](double z) { return z < HUGE_VAL; }));
        if (counts != nullptr) *counts = counts_;
        return std::move(image_);
    }

private:
    void draw(const std::int32_t* corners) {
        ++counts_.triangles;
        const std::size_t stride = 4 + n_;
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
            if (orient2d(window_[0].data(), window_[i].data(), window_[i + 1].data()) == Sign::zero) continue;
            area = true;
            set_part({0, i, i + 1});
            draw_part();
        }
        ++(!area ? counts_.degenerate : counts_.covered == covered ? counts_.between_pixels : counts_.drawn);
    }

    /// To a triangle of the fan.
    void set_part(const std::size_t (&fan)[3]) {
        const std::size_t stride = 4 + n_;
        part_.attributes.clear();
        for (std::size_t i = 0; i < 3; ++i) {
            const double* const row = polygon_.data() + stride * fan[i];
            part_.window[2 * i] = window_[fan[i]][0];
            part_.window[2 * i + 1] = window_[fan[i]][1];
            part_.z[i] = row[2] / row[3];
            part_.w[i] = row[3];
            part_.attributes.insert(part_.attributes.end(), row + 4, row + stride);
        }
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

    /// What is linear in the window at each vertex: the depth, the scale if there is one, attributes times the scale.
    std::vector<double> linear_values() const {
        const bool affine = scene_.interpolation == Interpolation::affine;
        const bool projected = scene_.interpolation == Interpolation::projected_z;
        const double least = std::ranges::min(part_.w);
        std::vector<double> values;
        for (std::size_t i = 0; i < 3; ++i) {
            const double scale = affine ? 1 : projected ? 1 / ((part_.z[i] + 1) / 2) : least / part_.w[i];
            values.push_back(part_.z[i]);
            if (!affine) values.push_back(scale);
            for (std::size_t k = 0; k < n_; ++k) values.push_back(scale * part_.attributes[n_ * i + k]);
        }
        return values;
    }

    /// fill(j, first, last, numbers): the depth and the attributes of these pixels of row j, 1 + components numbers
    /// each.
    template <class Fill>
    void draw_rows(const SortedTriangle& sorted, Fill fill) {
        std::vector<double> row;
        for_spans(sorted, image_.width, [&](std::int32_t j, std::int32_t first, std::int32_t last) {
            fill(j, first, last, row);
            counts_.covered += static_cast<std::uint64_t>(last - first);
            const std::size_t begin = image_.offset(first, j) / 4;
            for (std::size_t i = 0; i < static_cast<std::size_t>(last - first); ++i) {
                const double* const pixel = row.data() + (1 + n_) * i;
                double& depth = depth_[begin + i];
                if (!(pixel[0] < depth)) {
                    ++counts_.hidden;
                    continue;
                }
                depth = pixel[0];
                const Rgba colour = colour_of(scene_, pixel + 1);
                std::copy_n(colour.data(), 4, image_.data.data() + 4 * (begin + i));
                if (attributes_ != nullptr) std::copy_n(pixel + 1, n_, attributes_->data.data() + n_ * (begin + i));
            }
        });
    }

    /// With depths and attributes that are each the exact function of the vertices' window coordinates, w and
    /// attributes in perspective, rounded once.
    void draw_correct(const SortedTriangle& sorted) {
        std::array<double, 9> vertices;
        for (std::size_t i = 0; i < 3; ++i) {
            vertices[3 * i] = part_.window[2 * i];
            vertices[3 * i + 1] = part_.window[2 * i + 1];
            vertices[3 * i + 2] = part_.w[i];
        }
        CorrectRows depth{part_.window, part_.z, 1};
        std::vector<double> depths, values;
        draw_rows(sorted, [&](std::int32_t j, std::int32_t first, std::int32_t last, auto& out) {
            const auto count = static_cast<std::size_t>(last - first);
            depths.resize(count);
            depth.fill(j, first, last, depths.data());
            values.resize(n_ * count);
            // No error can occur: sizes fit, coordinates are finite, w > 0.
            (void)perspective_values(vertices.data(), depth.centres, part_.attributes, static_cast<int>(n_), values);
            out.clear();
            for (std::size_t i = 0; i < count; ++i) {
                out.push_back(depths[i]);
                out.insert(out.end(), values.data() + n_ * i, values.data() + n_ * (i + 1));
            }
        });
    }

    /// Draws the part where it is in front, and counts the pixels that it covers.
    void draw_part() {
        const SortedTriangle sorted(part_.window.data(), image_.height);
        const bool correct = scene_.rounding == Rounding::correct;
        if (correct && n_ != 0 && scene_.interpolation != Interpolation::affine) return draw_correct(sorted);
        const std::vector<double> values = linear_values();
        const std::size_t linear = values.size() / 3;
        const auto draw = [&](auto rows) {
            draw_rows(sorted, [&](std::int32_t j, std::int32_t first, std::int32_t last, auto& numbers) {
                const auto count = static_cast<std::size_t>(last - first);
                numbers.resize(linear * count);
                rows.fill(j, first, last, numbers.data());
                if (scene_.interpolation != Interpolation::affine) divide_by_scale(numbers.data(), n_, count);
            });
        };
        with_rows(sorted, part_.window.data(), values, static_cast<int>(linear), scene_.method,
                  correct || !thick_enough(part_.window) ? Rounding::correct : Rounding::plain, draw);
    }

    const Scene& scene_;
    std::size_t n_ = attribute_count(scene_);
    std::vector<double> clip_;
    Image image_;
    std::vector<double> depth_;  ///< of each pixel; infinite where nothing is drawn
    PixelValues* attributes_;
    RenderCounts counts_;
    std::vector<double> rows_, polygon_;
    std::vector<std::array<double, 2>> window_;
    WindowTriangle part_;
};

}  // namespace
}  // namespace raster

Result<Image> render(const Scene& scene, RenderCounts* counts, PixelValues* attributes) {
    const ExactEnvironment environment;
    if (Status good = raster::check(scene); !good) return good.error();
    Result<std::vector<double>> clip = raster::clip_positions(scene);
    if (!clip) return clip.error();
    if (attributes != nullptr) {
        Result<PixelValues> empty = empty_pixels(scene.size, static_cast<int>(raster::attribute_count(scene)));
        if (!empty) return empty.error();
        *attributes = std::move(*empty);
    }
    return raster::Renderer(scene, std::move(*clip), attributes).run(counts);
}

}  // namespace barycert

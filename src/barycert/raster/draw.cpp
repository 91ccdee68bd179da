#include "barycert/raster/draw.hpp"

#include <algorithm>
#include <cmath>

#include "barycert/base/strict_math.hpp"
#include "barycert/perspective.hpp"
#include "barycert/raster/fill_rows.hpp"

namespace barycert::raster {
namespace {

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

/// What is linear in the window at each vertex: the depth, the scale if there is one, attributes times the scale.
std::vector<double> linear_values(const WindowTriangle& t, const Shading& s) {
    const std::size_t n = s.components();
    std::array<double, 3> depth = t.w;
    if (s.interpolation == Interpolation::projected_z) {
        for (std::size_t i = 0; i < 3; ++i) depth[i] = (t.z[i] + 1) / 2;
    }
    const double least = *std::min_element(depth.begin(), depth.end());
    std::vector<double> values;
    for (std::size_t i = 0; i < 3; ++i) {
        values.push_back(t.z[i]);
        double scale = 1;
        if (s.interpolation != Interpolation::affine) {
            scale = (s.interpolation == Interpolation::projected_z ? 1 : least) / depth[i];
            values.push_back(scale);
        }
        for (std::size_t k = 0; k < n; ++k) values.push_back(scale * t.attributes[n * i + k]);
    }
    return values;
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

/// fill(j, first, last, numbers): the depth and the attributes of these pixels of row j, 1 + components numbers each.
template <class Fill>
void draw_rows(Canvas& canvas, const SortedTriangle& sorted, Fill fill) {
    const std::size_t n = canvas.shading.components();
    std::vector<double> row;
    for_spans(sorted, canvas.image.width, [&](std::int32_t j, std::int32_t first, std::int32_t last) {
        fill(j, first, last, row);
        canvas.counts.covered += static_cast<std::uint64_t>(last - first);
        const std::size_t begin = canvas.image.offset(first, j) / 4;
        for (std::size_t i = 0; i < static_cast<std::size_t>(last - first); ++i) {
            const double* const pixel = row.data() + (1 + n) * i;
            double& depth = canvas.depth[begin + i];
            if (!(pixel[0] < depth)) {
                ++canvas.counts.hidden;
                continue;
            }
            depth = pixel[0];
            const Rgba colour = canvas.shading.colour(pixel + 1);
            std::copy_n(colour.data(), 4, canvas.image.data.data() + 4 * (begin + i));
            if (canvas.attributes != nullptr)
                std::copy_n(pixel + 1, n, canvas.attributes->data.data() + n * (begin + i));
        }
    });
}

/// With depths and attributes that are each the exact function of the vertices' window coordinates, w and attributes,
/// rounded once.
void draw_correct(Canvas& canvas, const SortedTriangle& sorted, const WindowTriangle& t) {
    const auto components = static_cast<int>(canvas.shading.components());
    const bool affine = canvas.shading.interpolation == Interpolation::affine;
    std::array<double, 9> vertices;
    for (std::size_t i = 0; i < 3; ++i) {
        vertices[3 * i] = t.window[2 * i];
        vertices[3 * i + 1] = t.window[2 * i + 1];
        vertices[3 * i + 2] = t.w[i];
    }
    CorrectRows depth{t.window, t.z, 1}, linear{t.window, t.attributes, components};
    std::vector<double> points, depths, values;
    draw_rows(canvas, sorted, [&](std::int32_t j, std::int32_t first, std::int32_t last, auto& out) {
        const auto n = static_cast<std::size_t>(components), count = static_cast<std::size_t>(last - first);
        depths.resize(count);
        depth.fill(j, first, last, depths.data());
        values.resize(n * count);
        if (n != 0 && affine) {
            linear.fill(j, first, last, values.data());
        } else if (n != 0) {
            // No error can occur: sizes fit, coordinates are finite, w > 0.
            set_centres(j, first, last, points);
            (void)perspective_values(vertices.data(), points, t.attributes, components, values);
        }
        out.clear();
        for (std::size_t i = 0; i < count; ++i) {
            out.push_back(depths[i]);
            out.insert(out.end(), values.data() + n * i, values.data() + n * (i + 1));
        }
    });
}

}  // namespace

Rgba Shading::colour(const double* attributes) const {
    const double* const place = attributes + (colours ? 3 : 0);
    Rgba result{0, 0, 0, 255};
    if (texture != nullptr) result = texel(*texture, place[0], place[1]);
    if (!colours) return result;
    for (std::size_t k = 0; k < 3; ++k)
        result[k] = texture == nullptr ? component_byte(attributes[k])
                                       : component_byte(std::clamp(attributes[k], 0.0, 1.0) * (result[k] / 255.0));
    return result;
}

void draw_triangle(Canvas& canvas, const WindowTriangle& t) {
    const Shading& s = canvas.shading;
    const SortedTriangle sorted(t.window.data(), canvas.image.height);
    if (s.rounding == Rounding::correct) return draw_correct(canvas, sorted, t);
    const std::vector<double> values = linear_values(t, s);
    const std::size_t linear = values.size() / 3;
    const auto draw = [&](auto rows) {
        draw_rows(canvas, sorted, [&](std::int32_t j, std::int32_t first, std::int32_t last, auto& numbers) {
            const auto count = static_cast<std::size_t>(last - first);
            numbers.resize(linear * count);
            rows.fill(j, first, last, numbers.data());
            if (s.interpolation != Interpolation::affine) divide_by_scale(numbers.data(), s.components(), count);
        });
    };
    with_rows(sorted, t.window.data(), values, static_cast<int>(linear), s.method,
              thick_enough(t.window) ? Rounding::plain : Rounding::correct, draw);
}

}  // namespace barycert::raster

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/predicates.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "draw/raster/edge.hpp"
#include "draw/raster/fill_rows.hpp"

namespace barycert {
namespace raster {

std::int32_t exact_crossing(const Edge& edge, std::int32_t j, std::int32_t width, double s) {
    const auto not_left = [&](std::int32_t i) {
        const double centre[2] = {i + 0.5, j + 0.5};
        return orient2d(edge.lower, edge.upper, centre) != Sign::positive;
    };
    if (edge.error < 0.25) {
        // x(y) - 0.5 is within 0.5 of the integer k: its ceiling is k or k + 1.
        const double k = std::round(s);
        if (k < 0) return 0;
        if (k >= width) return width;
        const auto i = static_cast<std::int32_t>(k);
        return not_left(i) ? i : i + 1;
    }
    std::int32_t low = 0, high = width;  // all columns before `low` are left of the side; `high` is width, or not left
    while (low < high) {
        const std::int32_t middle = low + (high - low) / 2;
        if (not_left(middle))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

namespace {

constexpr std::uint64_t max_bytes = std::uint64_t{8} << 30;

Status check_vertices(std::span<const double> vertices) {
    if (vertices.size() != 6)
        return file_error("argument.size", {}, "number of coordinates of a triangle", "6",
                          std::to_string(vertices.size()));
    const std::size_t i = base::first_not_finite(vertices);
    if (i == vertices.size()) return Done{};
    return base::not_finite("coordinate " + std::to_string(i % 2) + " of vertex " + std::to_string(i / 2), vertices[i]);
}

Status check_fill(std::span<const double> vertices, std::span<const double> values, const PixelValues& out,
                  const FillOptions& options) {
    if (Status s = check_raster_size(out.size); !s) return s;
    if (Status s = check_vertices(vertices); !s) return s;
    const auto components = static_cast<std::size_t>(std::max(out.components, 0));
    if (components == 0 || values.size() != 3 * components)
        return file_error("argument.size", {}, "number of values of a triangle",
                          "3 for each of the raster's components, of which there is at least 1",
                          std::to_string(values.size()) + " for " + std::to_string(out.components));
    const std::size_t pixels = static_cast<std::size_t>(out.size.width) * static_cast<std::size_t>(out.size.height);
    if (out.data.size() != pixels * components)
        return file_error("argument.size", {}, "size of the raster's data", std::to_string(pixels * components),
                          std::to_string(out.data.size()));
    if (options.rounding == Rounding::correct && options.method != FillMethod::barycentric)
        return file_error("argument.value", {}, "correctly rounded values by steps or auxiliary lines",
                          "FillMethod::barycentric", "",
                          "all methods have the same exact values: use FillMethod::barycentric");
    return Done{};
}

}  // namespace
}  // namespace raster

Status check_raster_size(RasterSize size) {
    for (const auto& [name, side] : {std::pair{"width", size.width}, std::pair{"height", size.height}}) {
        if (side < 1 || side > max_raster_side)
            return file_error("argument.value", {}, std::string("the ") + name + " of a raster",
                              "1 to " + std::to_string(max_raster_side) + " pixels", std::to_string(side));
    }
    return Done{};
}

Status cover_triangle(RasterSize size, std::span<const double> vertices, std::vector<PixelSpan>& spans) {
    const ExactEnvironment environment;
    if (Status s = check_raster_size(size); !s) return s;
    if (Status s = raster::check_vertices(vertices); !s) return s;
    const raster::SortedTriangle t(vertices.data(), size.height);
    raster::for_spans(t, size.width, t.begin, t.end, [&](std::int32_t row, std::int32_t begin, std::int32_t end) {
        spans.push_back({row, begin, end});
    });
    return Done{};
}

Result<PixelValues> empty_pixels(RasterSize size, int components) {
    if (Status s = check_raster_size(size); !s) return s.error();
    const auto pixels = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
    const std::uint64_t max_components = raster::max_bytes / sizeof(double) / pixels;
    if (components < 1 || static_cast<std::uint64_t>(components) > max_components)
        return file_error("argument.value", {}, "number of components at each pixel",
                          "1 to " + std::to_string(max_components) + " in a raster of this size",
                          std::to_string(components));
    PixelValues empty{size, components, {}};
    empty.data.assign(pixels * static_cast<std::uint64_t>(components), std::numeric_limits<double>::quiet_NaN());
    return empty;
}

Result<std::size_t> fill_triangle(std::span<const double> vertices, std::span<const double> values, PixelValues& out,
                                  const FillOptions& options) {
    const ExactEnvironment environment;
    if (Status s = raster::check_fill(vertices, values, out, options); !s) return s.error();
    const raster::SortedTriangle t(vertices.data(), out.size.height);
    const auto fill = [&](auto rows) {
        std::size_t count = 0;
        raster::for_spans(
            t, out.size.width, t.begin, t.end, [&](std::int32_t j, std::int32_t first, std::int32_t last) {
                const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(out.size.width);
                rows.fill(j, first, last,
                          &out.data[(at + static_cast<std::size_t>(first)) * static_cast<std::size_t>(out.components)]);
                count += static_cast<std::size_t>(last - first);
            });
        return count;
    };
    return raster::with_rows(t, vertices.data(), values, out.components, options.method, options.rounding, fill);
}

// Bounds on the errors of fill_rows.hpp.
//
// Notation. u = 2^-53; |coordinates| <= X, |values| <= F; W and H the extents of the triangle; D twice its signed area;
// G = |df/dx| <= 2 F H / |D|, for D df/dx = sum f_i (y_{i+1} - y_{i+2}). Everything is below 2^100, so nothing
// overflows; what underflows changes a result by 2^-1074 times a factor of at most 2^300, which `tiny` covers. A
// sequence of n roundings is written as a factor (1 + t)^n, |t| <= u; second-order terms are covered by the factors'
// being rounded up, as far as the number of steps is below 2^17.
//
// Barycentric. A centre that is covered lies in the triangle's box, so |x_i| <= W, |y_i| <= H, each with one rounding.
//   A numerator of two products: |error| <= 2 W H (1 + t)^4 - ... <= 8.1 u W H; so is the error of the divisor D.
//   |n_i / D - computed| <= (8.1 u W H + 8.1 u W H) / (|D| - 8.1 u W H) + u, as |n_i / D| <= 1.
//   Three products and two sums: at most 3 F times that, and 3 * 3 u F.
// Bilinear. With t = (y - a.y) / dy in [0, 1], three roundings: x on a side is off by at most 5.1 u 2 X + 1.1 u X <= 12
// u X
//   and f by 5.1 u 2 F + 1.1 u F <= 12 u F. So each end of the line deviates from the field by E = 12 u F + 12 u X G.
//   Between the ends interpolation deviates by no more than E, and setting s to 0 or 1 moves the point by at most
//   12 u X: 12 u X G. Rounding s (three times) and the last sum: 2 F (5.1 u) + 3 u F.
// Scanline. Step n <= H + 1 rows and m <= W + 1 pixels. The value on the long side has the error of its start, 12 u F,
//   that of its step, 3.1 u (2 F / dy) n <= 6.3 u F, as n <= dy, and n roundings of numbers up to F (1 + ...): together
//   (n + 19) u F; x likewise (n + 19) u X, which costs G times that. df/dx has a numerator of two products, off by
//   8.1 u (2 F) H, and a divisor that is off by 8.1 u W H: (16.2 F H + 8.1 W H G) u / (|D| - 8.1 u W H) + u G; it is
//   multiplied by at most m + 1. The m + 1 roundings along the row are of numbers up to 3 F.
double fill_error(std::span<const double> vertices, std::span<const double> values, FillMethod method) {
    const ExactEnvironment environment;
    constexpr double u = 0x1p-53, infinite = std::numeric_limits<double>::infinity(), tiny = 0x1p-700;
    if (!raster::check_vertices(vertices) || values.size() != 3) return infinite;
    const double* v = vertices.data();
    double extent = 0, largest = 0;
    for (const double x : vertices) extent = std::max(extent, std::fabs(x));
    for (const double f : values) largest = std::max(largest, std::fabs(f));
    if (!(extent <= 0x1p100) || !(largest <= 0x1p100)) return infinite;
    const double width = std::max({v[0], v[2], v[4]}) - std::min({v[0], v[2], v[4]});
    const double height = std::max({v[1], v[3], v[5]}) - std::min({v[1], v[3], v[5]});
    const double area = std::fabs((v[2] - v[0]) * (v[5] - v[1]) - (v[4] - v[0]) * (v[3] - v[1]));
    // 17, not 8.1 twice: `area` has an error itself.
    const double least_area = area - 17 * u * width * height;
    if (!(least_area > 0)) return infinite;
    if (method == FillMethod::barycentric)
        return u * largest * (3 * (17 * width * height / least_area + 1.1) + 9.1) + tiny;
    const double slope = 2 * largest * height / least_area;
    if (method == FillMethod::bilinear) return u * (26 * largest + 25 * extent * slope) + tiny;
    const double rows = height + 1, columns = width + 2;
    const double step = (17 * largest * height + 9 * width * height * slope) / least_area + 2 * slope;
    return u * ((rows + 20) * (largest + extent * slope) + columns * step + 3.1 * columns * largest) + tiny;
}

}  // namespace barycert

#include "barycert/raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/raster/edge.hpp"
#include "barycert/raster/fill_rows.hpp"
#include "barycert/raster/input.hpp"

namespace barycert {
namespace raster {
namespace {

constexpr std::uint64_t max_bytes = std::uint64_t{8} << 30;

Status check_fill(std::span<const double> vertices, std::span<const double> values, const PixelValues& out,
                  const FillOptions& options) {
    if (Status s = check_raster_size(out.size); !s) return s;
    if (Status s = check_vertices(vertices); !s) return s;
    const auto components = static_cast<std::size_t>(std::max(out.components, 0));
    if (components == 0 || values.size() != 3 * components)
        return Error{.what = "number of values of a triangle",
                     .expected = "3 for each of the raster's components, of which there is at least 1",
                     .found = std::to_string(values.size()) + " for " + std::to_string(out.components)};
    const std::size_t pixels = static_cast<std::size_t>(out.size.width) * static_cast<std::size_t>(out.size.height);
    if (out.data.size() != pixels * components)
        return Error{.what = "size of the raster's data",
                     .expected = std::to_string(pixels * components),
                     .found = std::to_string(out.data.size())};
    if (options.rounding == Rounding::correct && options.method != FillMethod::barycentric)
        return Error{.what = "correctly rounded values by steps or auxiliary lines",
                     .expected = "FillMethod::barycentric",
                     .remedy = "all methods have the same exact values: use FillMethod::barycentric"};
    return Done{};
}

/// Correctly rounded values of all pixels of the triangle, row by row, by weights.hpp.
Result<std::size_t> fill_correct(const SortedTriangle& t, std::span<const double> vertices,
                                 std::span<const double> values, PixelValues& out) {
    constexpr std::array<std::int32_t, 3> corners{0, 1, 2};
    std::vector<double> points;
    std::vector<std::int32_t> cells;
    std::size_t count = 0;
    Status status = Done{};
    for_spans(t, out.size.width, [&](std::int32_t j, std::int32_t first, std::int32_t last) {
        if (!status) return;
        points.clear();
        for (std::int32_t i = first; i < last; ++i) points.insert(points.end(), {i + 0.5, j + 0.5});
        cells.assign(static_cast<std::size_t>(last - first), 0);
        const auto components = static_cast<std::size_t>(out.components);
        const std::span<double> row(out.data.data() + row_offset(out, first, j), components * cells.size());
        status = interpolate(MeshQueries{Simplex::triangle, vertices, corners, cells, points},
                             NodalValues<double>{values, out.components}, row);
        count += cells.size();
    });
    if (!status) return status.error();
    return count;
}

template <class Rows>
std::size_t fill_plain(const SortedTriangle& t, Rows rows, PixelValues& out) {
    std::size_t count = 0;
    for_spans(t, out.size.width, [&](std::int32_t j, std::int32_t first, std::int32_t last) {
        rows.fill(j, first, last, out.data.data() + row_offset(out, first, j));
        count += static_cast<std::size_t>(last - first);
    });
    return count;
}

}  // namespace
}  // namespace raster

Result<PixelValues> empty_pixels(RasterSize size, int components) {
    if (Status s = check_raster_size(size); !s) return s.error();
    const auto pixels = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
    const std::uint64_t max_components = raster::max_bytes / sizeof(double) / pixels;
    if (components < 1 || static_cast<std::uint64_t>(components) > max_components)
        return Error{.what = "number of components at each pixel",
                     .expected = "1 to " + std::to_string(max_components) + " in a raster of this size",
                     .found = std::to_string(components)};
    PixelValues empty{size, components, {}};
    empty.data.assign(pixels * static_cast<std::uint64_t>(components), std::numeric_limits<double>::quiet_NaN());
    return empty;
}

Result<std::size_t> fill_triangle(std::span<const double> vertices, std::span<const double> values, PixelValues& out,
                                  const FillOptions& options) {
    const ExactEnvironment environment;
    if (Status s = raster::check_fill(vertices, values, out, options); !s) return s.error();
    const raster::SortedTriangle t(vertices.data(), out.size.height);
    if (options.rounding == Rounding::correct) return raster::fill_correct(t, vertices, values, out);
    switch (options.method) {
        case FillMethod::scanline:
            return raster::fill_plain(t, raster::ScanlineRows(t, vertices.data(), values, out.components), out);
        case FillMethod::bilinear:
            return raster::fill_plain(t, raster::BilinearRows(t, vertices.data(), values, out.components), out);
        default:
            return raster::fill_plain(t, raster::BarycentricRows(vertices.data(), values, out.components), out);
    }
}

}  // namespace barycert

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "barycert/base/finite.hpp"
#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/raster/edge.hpp"

namespace barycert {
namespace raster {

Status check_vertices(std::span<const double> vertices) {
    if (vertices.size() != 6)
        return Error{
            .what = "number of coordinates of a triangle", .expected = "6", .found = std::to_string(vertices.size())};
    const std::size_t i = base::first_not_finite(vertices);
    if (i == vertices.size()) return Done{};
    return base::not_finite("coordinate " + std::to_string(i % 2) + " of vertex " + std::to_string(i / 2), vertices[i]);
}

bool not_left_of(const Edge& edge, std::int32_t i, std::int32_t j) {
    const double centre[2] = {i + 0.5, j + 0.5};
    return orient2d(edge.lower, edge.upper, centre) != Sign::positive;
}

std::int32_t exact_crossing(const Edge& edge, std::int32_t j, std::int32_t width, double s) {
    if (edge.error < 0.25) {
        // x(y) - 0.5 is within 0.5 of the integer k: its ceiling is k or k + 1.
        const double k = std::round(s);
        if (k < 0) return 0;
        if (k >= width) return width;
        const auto i = static_cast<std::int32_t>(k);
        return not_left_of(edge, i, j) ? i : i + 1;
    }
    std::int32_t low = 0, high = width;  // all columns before `low` are left of the side; `high` is width, or not left
    while (low < high) {
        const std::int32_t middle = low + (high - low) / 2;
        if (not_left_of(edge, middle, j))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

}  // namespace raster

Status check_raster_size(RasterSize size) {
    for (const auto& [name, side] : {std::pair{"width", size.width}, std::pair{"height", size.height}}) {
        if (side < 1 || side > max_raster_side)
            return Error{.what = std::string("the ") + name + " of a raster",
                         .expected = "1 to " + std::to_string(max_raster_side) + " pixels",
                         .found = std::to_string(side)};
    }
    return Done{};
}

Status cover_triangle(RasterSize size, std::span<const double> vertices, std::vector<PixelSpan>& spans) {
    const ExactEnvironment environment;
    if (Status s = check_raster_size(size); !s) return s;
    if (Status s = raster::check_vertices(vertices); !s) return s;
    raster::for_spans(raster::SortedTriangle(vertices.data(), size.height), size.width,
                      [&](std::int32_t row, std::int32_t begin, std::int32_t end) {
                          spans.push_back({row, begin, end});
                      });
    return Done{};
}

}  // namespace barycert

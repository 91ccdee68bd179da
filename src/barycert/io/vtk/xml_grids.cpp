// The points of grids in XML files: image data, rectilinear and structured grids.

#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "barycert/base/text.hpp"
#include "barycert/io/vtk/xml.hpp"

namespace barycert::io {
namespace {

using Counts = std::array<std::size_t, 3>;

using Extent = std::array<std::int64_t, 6>;

/// So many finite numbers, or integers as large as counts may be, and no more.
template <class T, std::size_t count>
std::optional<std::array<T, count>> parse_all(std::string_view text) {
    constexpr auto most = static_cast<std::int64_t>(max_entities);
    std::array<T, count> numbers{};
    bool good = true;
    for (T& x : numbers) {
        const std::string_view word = next_word(text);
        if constexpr (std::is_same_v<T, double>) {
            x = base::parse_double(word).value_or(HUGE_VAL);
            good = good && std::isfinite(x);
        } else {
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
            good = good && error == std::errc{} && end == word.data() + word.size() && -most <= x && x <= most;
        }
    }
    if (!good || !next_word(text).empty()) return std::nullopt;
    return numbers;
}

Status read_image_points(const XmlArrays& arrays, const XmlElement& data, const Extent& extent, const Counts& counts,
                         RawGrid& grid) {
    const std::string_view origin_text = data.attribute("Origin").value_or("0 0 0"),
                           spacing_text = data.attribute("Spacing").value_or("1 1 1");
    const auto origin = parse_all<double, 3>(origin_text), spacing = parse_all<double, 3>(spacing_text);
    if (!origin || !spacing)
        return arrays.tree().error(data, "the origin and spacing of the grid", "three finite numbers each",
                                   in_quotes(origin_text) + " and " + in_quotes(spacing_text));
    if (const auto direction = data.attribute("Direction"); direction.has_value()) {
        if (parse_all<double, 9>(*direction) != std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1})
            return arrays.tree().error(data, "the direction of the grid", "1 0 0 0 1 0 0 0 1", in_quotes(*direction),
                                       "write its points as a structured or unstructured grid");
    }
    grid.points.resize(3 * counts[0] * counts[1] * counts[2]);
    in_parallel(counts[2], [&](std::size_t k) {
        std::size_t at = 3 * k * counts[0] * counts[1];
        std::array<std::size_t, 3> i{0, 0, k};
        for (i[1] = 0; i[1] < counts[1]; ++i[1]) {
            for (i[0] = 0; i[0] < counts[0]; ++i[0]) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const auto index = static_cast<double>(extent[2 * axis] + static_cast<std::int64_t>(i[axis]));
                    grid.points[at++] = (*origin)[axis] + (*spacing)[axis] * index;
                }
            }
        }
    });
    return Done{};
}

Status read_rectilinear_points(const XmlArrays& arrays, const XmlElement& piece, const Counts& counts, RawGrid& grid) {
    const XmlTree& tree = arrays.tree();
    const XmlElement* const coordinates = tree.child(piece, "Coordinates");
    std::array<std::vector<double>, 3> axes;
    std::size_t found = 0;
    if (coordinates != nullptr) {
        for (const std::size_t i : coordinates->children) {
            const XmlElement& array = tree.elements[i];
            if (array.name != "DataArray" || found == 3) continue;
            if (Status s = arrays.read(array, "the coordinates along an axis", counts[found], axes[found]); !s)
                return s;
            grid.narrow_points = grid.narrow_points || XmlArrays::type_of(array) == NumberType::float32;
            ++found;
        }
    }
    if (found != 3)
        return arrays.tree().error(piece, "the points of a piece", "three arrays in Coordinates",
                                   std::to_string(found));
    grid.points.reserve(3 * counts[0] * counts[1] * counts[2]);
    for (const double z : axes[2]) {
        for (const double y : axes[1]) {
            for (const double x : axes[0]) grid.points.insert(grid.points.end(), {x, y, z});
        }
    }
    return Done{};
}

}  // namespace

bool is_structured(std::string_view type) {
    return type == "ImageData" || type == "RectilinearGrid" || type == "StructuredGrid";
}

Status read_grid_points(const XmlArrays& arrays, const XmlElement& data, const XmlElement& piece,
                        const std::string& type, RawGrid& grid) {
    const std::string_view whole_text = data.attribute("WholeExtent").value_or(""),
                           text = piece.attribute("Extent").value_or("");
    const auto whole = parse_all<std::int64_t, 6>(whole_text), extent = parse_all<std::int64_t, 6>(text);
    if (!extent || whole != extent)
        return arrays.tree().error(piece, "the extent of the piece", "that of the whole, six integers",
                                   in_quotes(text) + " of " + in_quotes(whole_text));
    Counts counts{};
    std::uint64_t points = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t count = (*extent)[2 * axis + 1] - (*extent)[2 * axis] + 1;
        counts[axis] = count > 0 ? static_cast<std::size_t>(count) : 0;
        if (__builtin_mul_overflow(points, counts[axis], &points)) points = max_entities + 1;
        points = std::min(points, max_entities + 1);
    }
    if (points > max_entities)
        return arrays.tree().error(piece, "the points of the grid", "at most " + std::to_string(max_entities),
                                   "the extent " + in_quotes(text));
    if (points == 0) return Done{};
    // Few bytes describe any number of points: no more than memory holds.
    const std::uint64_t memory =
        static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    if (type != "StructuredGrid" && points > memory / 2 / (3 * sizeof(double)))
        return arrays.tree().error(piece, "the points of the grid",
                                   "as many as fit in half of the memory of this machine", std::to_string(points),
                                   "use a smaller grid");
    if (type == "ImageData") return read_image_points(arrays, data, *extent, counts, grid);
    if (type == "RectilinearGrid") return read_rectilinear_points(arrays, piece, counts, grid);
    return read_points(arrays, piece, points, grid);
}

}  // namespace barycert::io

#include <vtkCellType.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <utility>

#include "barycert/base/output_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/vti/appended.hpp"
#include "barycert/io/vtk/mesh_to_grid.hpp"
#include "barycert/io/vtk/point_rows.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

constexpr const char *cell_name = "cell", *feature_name = "feature", *mask_name = "vtkValidPointMask",
                     *distance_name = "distance";

std::string fault_of(const PointRows& rows) {
    if (rows.dimension != 2 && rows.dimension != 3) return "the dimension is neither 2 nor 3";
    const auto dimension = static_cast<std::size_t>(rows.dimension);
    if (rows.points.size() % dimension != 0) return "the coordinates do not make whole points";
    const std::size_t count = rows.points.size() / dimension;
    if (count > io::max_entities) return "there are more than 2147483647 points";
    for (const double x : rows.points) {
        if (!std::isfinite(x)) return "a coordinate is not finite";
    }
    std::vector<std::string> names;
    bool fits = true;
    const auto check = [&](const char* name, std::size_t size) {
        if (size != 0) names.emplace_back(name);
        fits = fits && (size == 0 || size == count);
    };
    check(cell_name, rows.cells.size());
    check(feature_name, rows.features.size());
    check(mask_name, rows.inside.size());
    check(distance_name, rows.distances.size());
    for (const Field& field : rows.fields) {
        if (field.components < 1) return "a field has no components";
        fits = fits && field.data.size() == count * static_cast<std::size_t>(field.components);
    }
    if (!fits) return "an array does not have one row per point";
    return io::fault_of_names(rows.fields, std::move(names), io::Names::xml);
}

/// An array, how many numbers it has and what writes them.
struct ArrayOut {
    VtiArray array;
    std::uint64_t count = 0;
    std::function<void(base::OutputFile&)> write;

    std::uint64_t size() const { return count * number_size(array.type); }
};

/// count numbers at(0), at(1), ...
template <class T, class At>
ArrayOut array_of(VtiArray array, std::size_t count, At at) {
    return {std::move(array), count, [count, at](base::OutputFile& file) {
                std::vector<T> some(std::min<std::size_t>(count, std::size_t{1} << 16));
                for (std::size_t first = 0; first < count; first += some.size()) {
                    const std::size_t size = std::min(some.size(), count - first);
                    for (std::size_t i = 0; i < size; ++i) some[i] = static_cast<T>(at(first + i));
                    file.write({reinterpret_cast<const char*>(some.data()), size * sizeof(T)});
                }
            }};
}

/// The numbers as they are.
ArrayOut array_of(VtiArray array, std::span<const double> numbers) {
    return {std::move(array), numbers.size(), [numbers](base::OutputFile& file) {
                file.write({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
            }};
}

/// Arrays below an element such as PointData.
struct PointSection {
    std::string element;
    std::vector<ArrayOut> arrays;
};

std::vector<PointSection> sections_of(const PointRows& rows) {
    const std::size_t count = rows.points.size() / static_cast<std::size_t>(rows.dimension);
    std::vector<ArrayOut> found;
    if (!rows.cells.empty())
        found.push_back(array_of<std::int64_t>({cell_name, 1, VtiType::int64}, count,
                                               [cells = rows.cells](std::size_t i) { return cells[i]; }));
    if (!rows.features.empty())
        found.push_back(array_of<std::uint8_t>({feature_name, 1, VtiType::uint8}, count,
                                               [features = rows.features](std::size_t i) { return features[i]; }));
    if (!rows.inside.empty())
        found.push_back(array_of<std::int8_t>({mask_name, 1, VtiType::int8}, count,
                                              [inside = rows.inside](std::size_t i) { return inside[i]; }));
    if (!rows.distances.empty()) found.push_back(array_of({distance_name, 1, VtiType::float64}, rows.distances));
    if (count != 0) {
        for (const Field& field : rows.fields)
            found.push_back(array_of({field.name, field.components, VtiType::float64}, field.data));
    }
    const VtiArray coordinates{"Points", 3, VtiType::float64};
    const auto in_plane = [points = rows.points](std::size_t i) {
        return i % 3 == 2 ? 0.0 : points[i / 3 * 2 + i % 3];
    };
    std::vector<PointSection> sections;
    sections.push_back({"PointData", std::move(found)});
    sections.push_back({"CellData", {}});
    sections.push_back({"Points",
                        {rows.dimension == 3 ? array_of(coordinates, rows.points)
                                             : array_of<double>(coordinates, 3 * count, in_plane)}});
    // Each point a cell. Node numbers go up to 2^31 - 1.
    const auto number = [](std::size_t i) { return i; };
    const auto next = [](std::size_t i) { return i + 1; };
    const auto vertex = [](std::size_t) { return VTK_VERTEX; };
    sections.push_back({"Cells",
                        {array_of<std::int32_t>({"connectivity", 1, VtiType::int32}, count, number),
                         array_of<std::int32_t>({"offsets", 1, VtiType::int32}, count, next),
                         array_of<std::uint8_t>({"types", 1, VtiType::uint8}, count, vertex)}});
    return sections;
}

Status write(const std::string& path, const PointRows& rows) {
    const std::vector<PointSection> sections = sections_of(rows);
    const std::string count = std::to_string(rows.points.size() / static_cast<std::size_t>(rows.dimension));
    std::string head = vtk_file_head("UnstructuredGrid") + "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" +
                       count + "\" NumberOfCells=\"" + count + "\">\n";
    std::uint64_t offset = 0;
    for (const PointSection& section : sections) {
        head += "      <" + section.element + ">\n";
        for (const ArrayOut& a : section.arrays) {
            head += array_element(a.array, offset);
            offset += appended_header + a.size();
        }
        head += "      </" + section.element + ">\n";
    }
    head += "    </Piece>\n  </UnstructuredGrid>\n" + std::string(appended_begin);
    base::OutputFile file(path);
    file.write(head);
    for (const PointSection& section : sections) {
        for (const ArrayOut& a : section.arrays) {
            const std::uint64_t size = a.size();
            char header[appended_header];
            std::memcpy(header, &size, appended_header);
            file.write({header, appended_header});
            a.write(file);
        }
    }
    file.write(appended_tail);
    return file.commit();
}

}  // namespace

Status write_vtk_points(const std::string& path, const PointRows& rows) {
    const ExactEnvironment environment;
    if (const std::string fault = fault_of(rows); !fault.empty()) return io::cannot_write("the points", fault, path);
    return write(path, rows);
}

}  // namespace barycert::io

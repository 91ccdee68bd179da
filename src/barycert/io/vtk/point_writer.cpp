#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/io/vtk/cell_types.hpp"
#include "barycert/io/vtk/mesh_arrays.hpp"
#include "barycert/io/vtk/point_rows.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml_writer.hpp"

namespace barycert::io {
namespace {

constexpr const char *cell_name = "cell", *feature_name = "feature", *mask_name = "vtkValidPointMask",
                     *distance_name = "distance";

std::string fault_of(const PointRows& rows) {
    if (rows.dimension != 2 && rows.dimension != 3) return "the dimension is neither 2 nor 3";
    const auto dimension = static_cast<std::size_t>(rows.dimension);
    if (rows.points.size() % dimension != 0) return "the coordinates do not make whole points";
    const std::size_t count = rows.points.size() / dimension;
    if (count > max_entities) return "there are more than 2147483647 points";
    const bool told = rows.inside.size() == count;
    for (std::size_t i = 0; i < rows.points.size(); ++i) {
        // A point of a row outside may be anywhere.
        if (!std::isfinite(rows.points[i]) && !(told && rows.inside[i / dimension] == 0))
            return "a coordinate is not finite";
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
    for (const FieldRows& field : rows.fields) {
        if (field.components < 1) return "a field has no components";
        fits = fits && field.values.size() == count * static_cast<std::size_t>(field.components);
        names.push_back(field.name);
    }
    for (const ColumnRows& column : rows.carried) {
        std::size_t size = std::visit([](const auto& values) { return values.size(); }, column.values);
        if (const auto* const texts = std::get_if<std::span<const char>>(&column.values); texts != nullptr)
            size = static_cast<std::size_t>(std::count(texts->begin(), texts->end(), '\0'));
        fits = fits && size == count;
        names.push_back(column.name);
    }
    if (!fits) return "an array does not have one row per point";
    return fault_of_names(std::move(names), Names::xml);
}

OutArray array_of_carried(const ColumnRows& column) {
    if (const auto* const numbers = std::get_if<std::span<const std::int64_t>>(&column.values); numbers != nullptr)
        return array_in_memory<std::int64_t>({column.name, 1, VtiType::int64}, *numbers);
    if (const auto* const numbers = std::get_if<std::span<const double>>(&column.values); numbers != nullptr)
        return array_in_memory<double>({column.name, 1, VtiType::float64}, *numbers);
    return array_in_memory<char>({column.name, 1, VtiType::text}, std::get<std::span<const char>>(column.values));
}

std::vector<OutSection> sections_of(const PointRows& rows) {
    const std::size_t count = rows.points.size() / static_cast<std::size_t>(rows.dimension);
    std::vector<OutArray> found;
    if (!rows.cells.empty())
        found.push_back(array_made<std::int64_t>({cell_name, 1, VtiType::int64}, count,
                                                 [cells = rows.cells](std::size_t i) { return cells[i]; }));
    if (!rows.features.empty())
        found.push_back(array_made<std::uint8_t>({feature_name, 1, VtiType::uint8}, count,
                                                 [features = rows.features](std::size_t i) { return features[i]; }));
    if (!rows.inside.empty())
        found.push_back(array_made<std::int8_t>({mask_name, 1, VtiType::int8}, count,
                                                [inside = rows.inside](std::size_t i) { return inside[i]; }));
    if (!rows.distances.empty()) found.push_back(array_in_memory({distance_name, 1, VtiType::float64}, rows.distances));
    if (count != 0) {
        for (const FieldRows& field : rows.fields)
            found.push_back(array_in_memory({field.name, field.components, VtiType::float64}, field.values));
        for (const ColumnRows& column : rows.carried) found.push_back(array_of_carried(column));
    }
    std::vector<OutSection> sections;
    sections.push_back({"PointData", std::move(found)});
    sections.push_back({"CellData", {}});
    sections.push_back({"Points", {array_of_points(rows.points, rows.dimension)}});
    // Each point a cell. Node numbers go up to 2^31 - 1.
    const auto number = [](std::size_t i) { return i; };
    const auto next = [](std::size_t i) { return i + 1; };
    const auto vertex = [](std::size_t) { return vtk_vertex; };
    sections.push_back({"Cells",
                        {array_made<std::int32_t>({"connectivity", 1, VtiType::int32}, count, number),
                         array_made<std::int32_t>({"offsets", 1, VtiType::int32}, count, next),
                         array_made<std::uint8_t>({"types", 1, VtiType::uint8}, count, vertex)}});
    return sections;
}

}  // namespace

Status write_vtk_points(const std::string& path, const PointRows& rows, VtkData data) {
    const ExactEnvironment environment;
    if (const std::string fault = fault_of(rows); !fault.empty()) return cannot_write("the points", fault, path);
    const std::string count = std::to_string(rows.points.size() / static_cast<std::size_t>(rows.dimension));
    return write_xml({.data_set = "UnstructuredGrid",
                      .attributes = {},
                      .piece = " NumberOfPoints=\"" + count + "\" NumberOfCells=\"" + count + "\"",
                      .sections = sections_of(rows)},
                     path, data);
}

}  // namespace barycert::io

/// Polygons in space as files of surfaces have them: .off .stl .ply .obj. Errors are thrown as Exceptions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/plc/plc_text.hpp"

namespace barycert::io {

struct Polygons {
    std::vector<double> points;         ///< 3 coordinates a point
    std::vector<Mesh::Index> corners;   ///< of all polygons, one after the other
    std::vector<std::uint32_t> counts;  ///< corners of each; empty: all are triangles
    std::vector<Field> point_fields, cell_fields;
    int index_base = 0;
    Notes notes;

    std::size_t point_count() const { return points.size() / 3; }
    std::size_t count() const { return counts.empty() ? corners.size() / 3 : counts.size(); }
    std::size_t corners_of(std::size_t polygon) const { return counts.empty() ? 3 : counts[polygon]; }
};

Polygons read_off(PlcText& in);
Polygons read_obj(PlcText& in);
/// Text or binary. Corners of equal coordinates are one point, numbered as they first come.
Polygons read_stl(PlcText& in);
/// Text or binary, with fields of points and polygons: properties that are numbers, but for coordinates.
Polygons read_ply(PlcText& in);

/// The whole file, which is any of these by the end of its path; `counts` is empty if all are triangles.
Polygons read_polygons(const std::string& path);

/// The beginning of a file of `size` bytes that may be read so: whether it has binary data, in which a zero byte is no
/// fault.
bool is_binary_surface(std::string_view path, std::string_view beginning, std::size_t size);

/// Polygons that name no point, or a count that the file cannot hold.
void check_corners(PlcText& in, Polygons& all);

}  // namespace barycert::io

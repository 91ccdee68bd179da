// VTK's PolyData files, see io/vti/appended.hpp.
#include <cstdint>
#include <string_view>
#include <utility>

#include "barycert/io/surface/surface_writers.hpp"
#include "barycert/io/vti/appended.hpp"
#include "barycert/io/vtk/xml_writer.hpp"

namespace barycert::io {
namespace {

std::vector<OutArray> arrays_of(const std::vector<Field>& fields) {
    std::vector<OutArray> all;
    all.reserve(fields.size() + 1);
    for (const Field& f : fields) all.push_back(array_of_field(f));
    return all;
}

Status check_names(const std::string& path, const std::vector<OutArray>& arrays) {
    std::vector<VtiArray> own;
    own.reserve(arrays.size());
    for (const OutArray& a : arrays) own.push_back(a.array);
    return check_arrays(path, own);
}

bool has_array(const std::vector<OutArray>& arrays, std::string_view name) {
    for (const OutArray& a : arrays) {
        if (a.array.name == name) return true;
    }
    return false;
}

}  // namespace

Result<SurfaceFile> write_vtp(const Surface& s, const std::string& path, VtkData data) {
    std::vector<OutArray> of_points = arrays_of(s.point_fields), of_cells = arrays_of(s.cell_fields);
    if (!s.mesh_cells.empty() && !has_array(of_cells, "cell"))
        of_cells.push_back(array_in_memory<Mesh::Index>({"cell", 1, VtiType::int32}, s.mesh_cells));
    for (const auto* const arrays : {&of_points, &of_cells}) {
        if (Status good = check_names(path, *arrays); !good) return good.error();
    }
    const std::string cells = std::to_string(s.cell_count());
    const bool lines = s.dimension == 2;
    // VTK's own indices are 64 bits wide: it takes these as they are.
    const auto node = [&s](std::size_t i) { return s.cells[i]; };
    const auto end = [n = s.corners()](std::size_t i) { return n * (i + 1); };
    const OutFile file{
        .data_set = "PolyData",
        .attributes = {},
        .piece = " NumberOfPoints=\"" + std::to_string(s.point_count()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
                 (lines ? cells : "0") + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + (lines ? "0" : cells) + "\"",
        .sections = {{"PointData", std::move(of_points)},
                     {"CellData", std::move(of_cells)},
                     {"Points", {array_of_points(s.points, s.dimension)}},
                     {lines ? "Lines" : "Polys",
                      {array_made<std::int64_t>({"connectivity", 1, VtiType::int64}, s.cells.size(), node),
                       array_made<std::int64_t>({"offsets", 1, VtiType::int64}, s.cell_count(), end)}}}};
    if (Status written = write_xml(file, path, data); !written) return written.error();
    return SurfaceFile{};
}

}  // namespace barycert::io

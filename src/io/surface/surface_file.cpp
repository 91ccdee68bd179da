#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"
#include "core/base/finite.hpp"
#include "files/format.hpp"
#include "io/errors.hpp"
#include "io/row_output.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/out_file.hpp"

namespace barycert {
namespace io {
namespace {

const char* fault_of(const std::vector<Field>& fields, std::size_t rows) {
    for (const Field& f : fields) {
        if (f.components < 1) return "a field without components";
        if (f.data.size() != rows * static_cast<std::size_t>(f.components)) return "a field that does not fit";
    }
    return nullptr;
}

const char* fault_of(const Surface& s) {
    if (s.dimension != 2 && s.dimension != 3) return "a dimension that is neither 2 nor 3";
    if (s.points.size() % s.corners() != 0 || s.cells.size() % s.corners() != 0) return "points or cells not whole";
    if (std::max(s.point_count(), s.cell_count()) > INT32_MAX) return "more than 2147483647 points or cells";
    if (!base::all_finite(s.points)) return "a coordinate that is not finite";
    const auto is_point = [&](Mesh::Index i) { return i >= 0 && static_cast<std::size_t>(i) < s.point_count(); };
    if (!std::all_of(s.cells.begin(), s.cells.end(), is_point)) return "a corner of a cell that is no point";
    if (!s.mesh_cells.empty() && s.mesh_cells.size() != s.cell_count()) return "cells of the mesh that do not fit";
    if (const char* const fault = fault_of(s.point_fields, s.point_count()); fault != nullptr) return fault;
    return fault_of(s.cell_fields, s.cell_count());
}

/// The head, then points and cells: in text without fields; in binary, with them, segments at z = 0.
Status write_file(const Surface& s, const std::string& path, bool binary, const std::string& head) {
    RowOutput file(path, binary);
    file.text(head);
    const bool lines = s.dimension == 2;
    const std::size_t corners = s.corners();
    for (std::size_t v = 0; v < s.point_count(); ++v) {
        file.numbers(std::span(s.points).subspan(corners * v, corners));
        if (lines) file.number(0.0);
        if (binary) file.row_of(s.point_fields, v);
        file.end_row();
    }
    for (std::size_t c = 0; c < s.cell_count(); ++c) {
        if (!lines) file.number(std::uint8_t{3});
        file.numbers(std::span(s.cells).subspan(corners * c, corners));
        if (binary) file.row_of(s.cell_fields, c);
        file.end_row();
    }
    return file.commit();
}

/// Text; triangles without fields. Error: segments.
Result<SurfaceFile> write_off(const Surface& s, const std::string& path) {
    if (s.dimension == 2)
        return file_error("file.suffix", path, "an .off file holds polygons only", {}, "segments in the plane",
                          "choose .vtp or .ply");
    SurfaceFile result;
    for (const auto* const fields : {&s.point_fields, &s.cell_fields})
        std::ranges::transform(*fields, std::back_inserter(result.left_out), &Field::name);
    const std::string counts = std::to_string(s.point_count()) + ' ' + std::to_string(s.cell_count());
    if (Status written = write_file(s, path, false, "OFF\n" + counts + " 0\n"); !written) return written.error();
    return result;
}

// PLY files. G. Turk, "The PLY Polygon File Format", 1994.

static_assert(std::endian::native == std::endian::little, "PLY files are written as numbers stand in memory");

/// The properties of all fields, one a component. Names have no character that may pass for an end, and differ.
std::string properties_of(const std::vector<Field>& fields, std::set<std::string> taken,
                          std::vector<std::string>& renamed) {
    std::string text;
    for (const Field& f : fields) {
        for (int c = 0; c < f.components; ++c) {
            const std::string wanted = f.components == 1 ? f.name : f.name + '_' + std::to_string(c);
            std::string name = wanted.empty() ? "_" : wanted;
            std::ranges::replace_if(name, std::not_fn(is_letter_or_digit), '_');
            while (!taken.insert(name).second) name += '_';
            text.append("property double ").append(name).append("\n");
            if (name != wanted) renamed.emplace_back(wanted).append(" as ").append(name);
        }
    }
    return text;
}

/// Binary, little-endian: vertices with coordinates and fields as double properties; faces, or edges (vertex1,
/// vertex2) at z = 0, with fields of cells. Names of properties have letters, digits and underscores only, and differ.
Result<SurfaceFile> write_ply(const Surface& s, const std::string& path) {
    SurfaceFile result;
    const bool lines = s.dimension == 2;
    std::string head = "ply\nformat binary_little_endian 1.0\ncomment written by barycert\nelement vertex " +
                       std::to_string(s.point_count()) + "\nproperty double x\nproperty double y\nproperty double z\n";
    head += properties_of(s.point_fields, {"x", "y", "z"}, result.renamed);
    head += std::string("element ") + (lines ? "edge " : "face ") + std::to_string(s.cell_count()) + '\n';
    head += lines ? "property int vertex1\nproperty int vertex2\n" : "property list uchar int vertex_indices\n";
    head += properties_of(s.cell_fields, {"vertex1", "vertex2", "vertex_indices"}, result.renamed);
    if (Status written = write_file(s, path, true, head + "end_header\n"); !written) return written.error();
    return result;
}

/// VTK's PolyData: polygons, or lines at z = 0; fields as arrays of doubles; the cells of the mesh as the array "cell",
/// where no field has that name. Error: a name that XML cannot hold, or is there twice.
Result<SurfaceFile> write_vtp(const Surface& s, const std::string& path, VtkData data) {
    std::vector<OutArray> of_points = arrays_of(s.point_fields), of_cells = arrays_of(s.cell_fields);
    if (!s.mesh_cells.empty() && std::ranges::count(s.cell_fields, "cell", &Field::name) == 0)
        of_cells.push_back(array_in_memory<Mesh::Index>("cell", s.mesh_cells));
    for (const auto* const arrays : {&of_points, &of_cells}) {
        if (Status good = check_arrays(path, *arrays); !good) return good.error();
    }
    const std::string cells = std::to_string(s.cell_count());
    const bool lines = s.dimension == 2;
    // VTK's own indices are 64 bits wide: it takes these as they are.
    const auto node = [&s](std::size_t i) { return s.cells[i]; };
    const auto end = [n = s.corners()](std::size_t i) { return n * (i + 1); };
    const OutFile file{.data_set = "PolyData",
                       .piece = " NumberOfPoints=\"" + std::to_string(s.point_count()) +
                                "\" NumberOfVerts=\"0\" NumberOfLines=\"" + (lines ? cells : "0") +
                                "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + (lines ? "0" : cells) + "\"",
                       .sections = {{"PointData", std::move(of_points)},
                                    {"CellData", std::move(of_cells)},
                                    {"Points", {array_of_points(s.points, s.dimension)}},
                                    {lines ? "Lines" : "Polys",
                                     {array_made<std::int64_t>("connectivity", s.cells.size(), node),
                                      array_made<std::int64_t>("offsets", s.cell_count(), end)}}}};
    if (Status written = write_xml(file, path, data); !written) return written.error();
    return SurfaceFile{};
}

}  // namespace
}  // namespace io

Result<SurfaceFile> write_surface(const Surface& surface, const std::string& path, VtkData data) {
    const ExactEnvironment environment;
    if (const char* const fault = io::fault_of(surface); fault != nullptr)
        return file_error("surface.inconsistent", path, "the surface is inconsistent", {}, fault);
    const base::FormatKind kind = base::kind_of(path);
    if (kind == base::FormatKind::vtp) return io::write_vtp(surface, path, data);
    if (kind == base::FormatKind::ply) return io::write_ply(surface, path);
    if (kind == base::FormatKind::off) return io::write_off(surface, path);
    return io::unknown_suffix(path, "unknown suffix of a surface", base::suffixes_written(base::Use::surface),
                              "choose another name");
}

}  // namespace barycert

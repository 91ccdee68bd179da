#include <algorithm>
#include <cmath>
#include <cstddef>

#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/surface/surface_writers.hpp"
#include "barycert/surface.hpp"

namespace barycert {
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
    if (!std::all_of(s.points.begin(), s.points.end(), [](double x) { return std::isfinite(x); }))
        return "a coordinate that is not finite";
    const auto is_point = [&](Mesh::Index i) { return i >= 0 && static_cast<std::size_t>(i) < s.point_count(); };
    if (!std::all_of(s.cells.begin(), s.cells.end(), is_point)) return "a corner of a cell that is no point";
    if (!s.mesh_cells.empty() && s.mesh_cells.size() != s.cell_count()) return "cells of the mesh that do not fit";
    if (const char* const fault = fault_of(s.point_fields, s.point_count()); fault != nullptr) return fault;
    return fault_of(s.cell_fields, s.cell_count());
}

}  // namespace

Result<SurfaceFile> write_surface(const Surface& surface, const std::string& path, VtkData data) {
    const ExactEnvironment environment;
    if (const char* const fault = fault_of(surface); fault != nullptr)
        return Error{.what = "the surface is inconsistent", .file = path, .found = fault};
    if (io::has_suffix(path, ".vtp")) return io::write_vtp(surface, path, data);
    if (io::has_suffix(path, ".ply")) return io::write_ply(surface, path);
    if (io::has_suffix(path, ".off")) return io::write_off(surface, path);
    const std::size_t dot = path.find_last_of("./");
    const bool suffix = dot != std::string::npos && path[dot] == '.';
    return Error{.what = "unknown suffix of a surface",
                 .file = path,
                 .expected = ".vtp, .ply or .off",
                 .found = suffix ? '"' + path.substr(dot) + '"' : "no suffix",
                 .remedy = "choose another name"};
}

}  // namespace barycert

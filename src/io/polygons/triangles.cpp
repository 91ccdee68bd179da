#include "io/polygons/triangles.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "io/errors.hpp"
#include "io/in_space.hpp"
#include "io/paths.hpp"
#include "io/polygons/polygons.hpp"
#include "mesh/facets/facet_triangles.hpp"
#include "mesh/facets/plc_triangles.hpp"
#include "mesh/part.hpp"

namespace barycert::io {
namespace {

void note_uncut(Surface& surface, std::size_t count, const char* what, const std::string& path) {
    if (count == 0) return;
    surface.notes.push_back({Note::Kind::left_out,
                             std::string(what) + " that cross themselves or are flat (" + std::to_string(count) +
                                 "): no triangles fill them",
                             path, true});
}

}  // namespace

Surface surface_of(Mesh mesh, InSpace space) {
    Surface surface;
    surface.points = std::move(space.points);
    if (surface.points.empty()) {
        for (std::size_t i = 0; i < mesh.point_count(); ++i)
            surface.points.insert(surface.points.end(), {mesh.points[2 * i], mesh.points[2 * i + 1], 0});
    }
    surface.cells = std::move(mesh.cells);
    surface.point_fields = std::move(mesh.point_fields);
    surface.cell_fields = std::move(mesh.cell_fields);
    surface.facets = space.facets.empty() ? std::move(mesh.cell_numbers) : std::move(space.facets);
    surface.notes = std::move(mesh.notes);
    surface.index_base = mesh.index_base;
    if (!mesh.mid_nodes.empty())
        surface.notes.push_back(
            {Note::Kind::converted, "triangles of second order: they are taken by their corners", {}, true});
    return surface;
}

bool is_polygons_file(const std::string& path) {
    return base::is_read_as(path, base::Use::plc);
}

bool is_plc_file(const std::string& path) {
    const FormatKind kind = base::kind_of(path);
    return kind == FormatKind::poly || kind == FormatKind::smesh;
}

bool is_surface_file(const std::string& path) {
    return is_polygons_file(path) || base::kind_of(path) == FormatKind::vtp;
}

Surface surface_of(Polygons polygons, const std::string& path) {
    Surface surface = std::move(static_cast<Surface&>(polygons));
    std::size_t uncut = 0;
    if (polygons.counts.empty()) {
        surface.cells = std::move(polygons.rings);
    } else {
        auto corner = polygons.rings.begin();
        for (std::size_t i = 0; i < polygons.count(); ++i) {
            const auto end = corner + polygons.counts[i];
            const std::vector<Mesh::Index> ring(corner, end);
            const surface::FacetTriangles cut = surface::triangles_of_facet(surface.points, {&ring, 1}, {});
            uncut += cut.triangles.empty() ? 1 : 0;
            surface::add_facet(surface, i, cut);
            corner = end;
        }
        for (Field& field : surface.cell_fields) field = mesh::rows_of(field, surface.facets);
        surface::settle_facets(surface, polygons.count());
    }
    note_uncut(surface, uncut, "polygons", path);
    return surface;
}

Surface surface_of(const Plc& plc, const std::string& path) {
    surface::PlcTriangles cut = surface::triangles_of(plc);
    const auto uncut = std::ranges::count_if(cut.faults, [](const surface::PlcTriangles::Fault& f) {
        return f.fault.kind != surface::FacetFault::Kind::on_segment;
    });
    note_uncut(cut.surface, static_cast<std::size_t>(uncut), "facets", path);
    return std::move(cut.surface);
}

}  // namespace barycert::io

namespace barycert {

Result<Surface> read_surface(const std::string& path, const ReadOptions& options) {
    Result<std::variant<Mesh, Surface>> read = read_mesh_or_surface(path, options);
    if (!read) return read.error();
    if (auto* const surface = std::get_if<Surface>(&*read)) return std::move(*surface);
    Mesh& mesh = std::get<Mesh>(*read);
    if (mesh.dimension == 3)
        return file_error("mesh.dimension", path, "this is a mesh of tetrahedra, not a surface", "triangles", {},
                          "take its boundary: `barycert render boundary`");
    return io::surface_of(std::move(mesh), io::InSpace());
}

Result<std::variant<Mesh, Surface>> read_mesh_or_surface(const std::string& path, const ReadOptions& options) {
    return io::read_guarded(path, [&]() -> std::variant<Mesh, Surface> {
        if (io::is_plc_file(path)) return io::surface_of(read_plc(path).value(), path);
        if (io::is_polygons_file(path)) {
            Surface surface = io::surface_of(io::read_polygons(path), path);
            if (surface.cells.empty()) io::refuse_file("mesh.empty", path, "the surface has no triangles");
            return surface;
        }
        io::InSpace space;
        Mesh mesh = io::read_mesh_in_space(path, options, &space).value();
        if (space.points.empty() && space.facets.empty()) return mesh;
        Surface surface = io::surface_of(std::move(mesh), std::move(space));
        if (const double z = surface.points.size() < 3 ? 0 : surface.points[2];
            z != 0 && io::in_plane(surface.points, z))
            surface.notes.push_back({Note::Kind::guessed,
                                     "the triangles lie in the plane z = " + base::shortest(z) +
                                         " and are taken for a surface in space; with z = 0 they are a mesh",
                                     path, true});
        return surface;
    });
}

}  // namespace barycert

#include "barycert/io.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/point_table.hpp"

namespace barycert {
PointSource::~PointSource() = default;

namespace io {
namespace {

/// True if a file that a mesh may be in is there.
bool names_a_mesh(const std::string& path) {
    const std::vector<std::string> files = mesh_files(path);
    std::error_code ignored;
    return std::any_of(files.begin(), files.end(),
                       [&](const std::string& file) { return std::filesystem::exists(file, ignored); });
}

/// The nodes of a mesh.
Result<std::unique_ptr<PointSource>> open_nodes(const std::string& path, int dimension, const PointOptions& options) {
    Result<Mesh> mesh = read_mesh(path, {.faces = false, .neighbours = false});
    if (!mesh) return mesh.error();
    PointTable table;
    table.dimension = mesh->dimension;
    table.points = std::move(mesh->points);
    table.fields = std::move(mesh->point_fields);
    if (!mesh->point_markers.empty()) table.labels.push_back({"marker", std::move(mesh->point_markers)});
    table.notes = std::move(mesh->notes);
    return points_of_table(std::move(table), path, dimension, options);
}

}  // namespace
}  // namespace io

Result<std::unique_ptr<PointSource>> open_points(const std::string& path, int dimension, const PointOptions& options) {
    const ExactEnvironment environment;
    if (dimension != 2 && dimension != 3) {
        return file_error(path, "points can have 2 or 3 coordinates", "2 or 3", std::to_string(dimension));
    }
    if (io::is_vtk_points_file(path)) return io::open_vtk_points(path, dimension, options);
    const Result<io::FileFormat> format = io::format_of_points(path);
    if (!format) {
        // A stem, or the file of a mesh; what is neither is told as a file of points that is not known.
        if (!io::names_a_mesh(path)) {
            Error unknown = format.error();
            unknown.expected =
                "points (.csv .txt .npy .node .vtu .vtp .vtk .vti .vtr .vts, - for CSV from stdin) or a mesh";
            return unknown;
        }
        return io::open_nodes(path, dimension, options);
    }
    switch (*format) {
        case io::FileFormat::csv:
            return io::open_csv_source(path, dimension, options);
        case io::FileFormat::npy:
            return io::open_npy_source(path, dimension, options);
        default:
            return io::open_node_source(path, dimension, options);
    }
}

}  // namespace barycert

#include <cstddef>
#include <new>
#include <string>

#include "barycert/environment.hpp"
#include "barycert/io/vtk/mesh_to_grid.hpp"
#include "barycert/io/vtk/vtu_output.hpp"
#include "barycert/vtk.hpp"

namespace barycert {
namespace {

/// Bytes of the file but for its head, and room for a head: the stream then takes no more than the file does.
std::size_t file_size(const Mesh& mesh, std::size_t index_size) {
    std::size_t bytes = 24 * mesh.point_count() + 8 * mesh.point_markers.size();
    bytes += mesh.cell_count() * (index_size + 1) + (mesh.cells.size() + mesh.mid_nodes.size()) * index_size;
    for (const auto* fields : {&mesh.point_fields, &mesh.cell_fields}) {
        for (const Field& field : *fields) bytes += field.data.size() * sizeof(double) + field.name.size() * 6 + 512;
    }
    return bytes + 4096;
}

}  // namespace

Status write_vtu(const Mesh& mesh, const std::string& path) {
    const ExactEnvironment environment;
    if (const std::string fault = io::fault_of_mesh(mesh, io::Names::xml); !fault.empty())
        return io::cannot_write("the mesh", fault, path);
    try {
        const std::size_t size = file_size(mesh, io::needs_wide_indices(mesh) ? 8 : 4);
        return io::write_vtu_grid(io::grid_of(mesh, io::Names::xml), path, size);
    } catch (const std::bad_alloc&) {
        return io::vtk_failure(path, "too little memory");
    }
}

}  // namespace barycert

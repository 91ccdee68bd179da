#include <tbb/task_arena.h>

#include "barycert/gmsh.hpp"
#include "barycert/io.hpp"
#include "barycert/io/mesh_format.hpp"
#include "barycert/vtk.hpp"

namespace barycert {

Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options) {
    const Result<io::MeshFormat> format = io::mesh_format(path);
    if (!format) return format.error();
    switch (*format) {
        case io::MeshFormat::gmsh:
            return read_gmsh(path, {.step = {}, .threads = options.threads});
        case io::MeshFormat::vtk:
            if (options.threads <= 0) return read_vtk(path);
            return tbb::task_arena(options.threads).execute([&] { return read_vtk(path); });
        default:
            return read_tetgen(path, options);
    }
}

std::vector<std::string> mesh_files(const std::string& path) {
    const Result<io::MeshFormat> format = io::mesh_format(path);
    if (format && *format == io::MeshFormat::vtk) return vtk_mesh_files(path);
    if (format && *format == io::MeshFormat::gmsh) return {path};
    return tetgen_files(path);
}

Status write_mesh(const Mesh& mesh, const std::string& path, const WriteOptions& options) {
    const Result<io::MeshFormat> format = io::mesh_output_format(path);
    if (!format) return format.error();
    switch (*format) {
        case io::MeshFormat::gmsh:
            return write_gmsh(mesh, path);
        case io::MeshFormat::vtk:
            return write_vtk(mesh, path, options.data);
        default:
            return write_tetgen(mesh, tetgen_stem(path), options);
    }
}

Result<std::vector<std::string>> written_mesh_files(const std::string& path) {
    const Result<io::MeshFormat> format = io::mesh_output_format(path);
    if (!format) return format.error();
    return *format == io::MeshFormat::tetgen ? tetgen_files(path) : std::vector<std::string>{path};
}

}  // namespace barycert

#include <tbb/task_arena.h>

#include "barycert/io.hpp"
#include "barycert/io/converted/read_converted.hpp"
#include "barycert/io/medit/read_medit.hpp"
#include "barycert/io/mesh_format.hpp"
#include "barycert/io/vtk/collection.hpp"

namespace barycert {
namespace {

template <class Read>
Result<Mesh> on_threads(int threads, const Read& read) {
    return threads <= 0 ? read() : tbb::task_arena(threads).execute(read);
}

}  // namespace

Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options) {
    const Result<io::MeshFormat> format = io::mesh_format(path);
    if (!format) return format.error();
    if (options.step.made() && *format != io::MeshFormat::vtk) return io::no_series(path);
    switch (*format) {
        case io::MeshFormat::gmsh:
            return read_gmsh(path, {.step = {}, .threads = options.threads});
        case io::MeshFormat::vtk:
            return on_threads(options.threads, [&] { return read_vtk(path, options.step); });
        case io::MeshFormat::medit:
            return on_threads(options.threads, [&] { return io::read_medit(path, options); });
        case io::MeshFormat::by_meshio:
            return io::read_converted(path, io::meshio_format(path));
        default:
            return read_tetgen(path, options);
    }
}

std::vector<std::string> mesh_files(const std::string& path) {
    const Result<io::MeshFormat> format = io::mesh_format(path);
    if (format && *format == io::MeshFormat::vtk) return vtk_mesh_files(path);
    if (format && *format == io::MeshFormat::by_meshio) return io::converted_files(path);
    if (format && *format != io::MeshFormat::tetgen) return {path};
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

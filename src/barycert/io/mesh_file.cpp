#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/plc.hpp"
#include "barycert/vtk.hpp"

namespace barycert {
namespace {

namespace fs = std::filesystem;

/// A mesh that is not there is often a PLC, a folder or a mistyped stem.
Error with_hint(Error error, const fs::path& path) {
    std::error_code ignored;
    const std::string extension = path.extension().string();
    if (std::find(plc_extensions.begin(), plc_extensions.end(), extension) != plc_extensions.end()) {
        error.remedy = "this is a PLC, not a mesh: mesh it first with `barycert mesh " + path.string() + "`";
    } else if (!fs::exists(path, ignored) && !fs::exists(path.string() + ".node", ignored)) {
        error.remedy = "MESH is the stem of TetGen's files, or one of them: part.1 for part.1.node and part.1.ele";
    } else if (fs::is_directory(path, ignored) && !fs::exists(path.string() + ".node", ignored)) {
        error.remedy = "this is a folder: name the stem of TetGen's files in it";
    }
    return error;
}

}  // namespace

Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options) {
    if (io::is_vtk_file(path)) return read_vtk(path);
    Result<Mesh> mesh = read_tetgen(path, options);
    if (!mesh) return with_hint(mesh.error(), path);
    return mesh;
}

std::vector<std::string> mesh_files(const std::string& path) {
    if (io::is_vtk_file(path)) return vtk_mesh_files(path);
    return tetgen_files(path);
}

}  // namespace barycert

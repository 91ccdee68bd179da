// barycert audits meshes of all formats.

#include "audit_inputs.hpp"

namespace barycert::cli {

std::vector<std::string> audited_files(const std::string& path) {
    return mesh_files(path);
}

Result<Mesh> read_audited(const std::string& path, const ReadOptions& options) {
    return read_mesh(path, options);
}

}  // namespace barycert::cli

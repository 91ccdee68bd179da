#include "barycert/io/formats.hpp"
#include "barycert/mesh/pulling.hpp"

namespace barycert::io {

void cut_into_simplices(Mesh& mesh, const std::string& path) {
    if (mesh.shapes.types.empty()) return;
    if (const auto open = mesh::cut_into_simplices(mesh))
        refuse_file(path,
                    "the faces of cell " + std::to_string(mesh.cell_number(mesh.shapes.parts[*open])) +
                        " (from 0) do not close",
                    "each edge in two faces of the polyhedron", {}, "write the file again with all faces");
    mesh.notes.push_back({Note::Kind::converted,
                          std::to_string(mesh.shapes.count()) + " cells are cut into " +
                              std::to_string(mesh.cell_count()) + (mesh.dimension == 3 ? " tetrahedra" : " triangles") +
                              ", each cell and face at its node of lowest number",
                          path});
}

}  // namespace barycert::io

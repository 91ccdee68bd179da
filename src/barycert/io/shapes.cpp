#include <numeric>

#include "barycert/io/formats.hpp"
#include "barycert/mesh/columns.hpp"
#include "barycert/mesh/part.hpp"
#include "barycert/mesh/pulling.hpp"

namespace barycert::io {

void cut_into_simplices(Mesh& mesh, const std::string& path) {
    if (mesh.shapes.types.empty()) return;
    std::vector<Mesh::Index> numbers = std::move(mesh.cell_numbers);
    if (numbers.empty()) {
        numbers.resize(mesh.shapes.count());
        std::iota(numbers.begin(), numbers.end(), 0);
    }
    if (const auto open = mesh::pull(mesh))
        refuse_file(path, "the faces of cell " + std::to_string(numbers[*open]) + " (from 0) do not close",
                    "each edge in two faces of the polyhedron", {}, "write the file again with all faces");
    const std::vector<Mesh::Index> of_part = mesh::whole_of_parts(mesh);
    mesh.cell_numbers.clear();
    mesh::append_rows_of(numbers, 1, of_part, mesh.cell_numbers);
    for (Field& field : mesh.cell_fields) field = mesh::rows_of(field, of_part);
    for (Column& labels : mesh.cell_labels) labels = mesh::labels_at(labels, of_part);
    mesh.notes.push_back({Note::Kind::converted,
                          std::to_string(numbers.size()) + " cells are cut into " + std::to_string(mesh.cell_count()) +
                              (mesh.dimension == 3 ? " tetrahedra" : " triangles") +
                              ", each cell and face at its node of lowest number",
                          path});
}

}  // namespace barycert::io

#include "barycert/io/vtk/mesh_arrays.hpp"

#include <algorithm>
#include <limits>

#include "barycert/io/vti/xml_name.hpp"
#include "barycert/io/vtk/cell_types.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/mesh/consistency.hpp"
#include "barycert/mesh/mid_edges.hpp"

namespace barycert::io {

std::uint8_t cell_type_of(const Mesh& mesh) {
    if (mesh.dimension == 2) return mesh.mid_nodes.empty() ? vtk_triangle : vtk_quadratic_triangle;
    return mesh.mid_nodes.empty() ? vtk_tetra : vtk_quadratic_tetra;
}

std::size_t nodes_a_cell(const Mesh& mesh) {
    return mesh.corners() + (mesh.mid_nodes.empty() ? 0 : mesh::edges_of(mesh.dimension).size());
}

OutArray connectivity_of(const Mesh& mesh) {
    VtiArray array{"connectivity", 1, VtiType::int32};
    if (mesh.mid_nodes.empty()) return array_in_memory<Mesh::Index>(std::move(array), mesh.cells);
    const std::size_t corners = mesh.corners(), nodes = nodes_a_cell(mesh), mids = nodes - corners;
    return array_made<std::int32_t>(std::move(array), nodes * mesh.cell_count(), [=, &mesh](std::size_t i) {
        const std::size_t cell = i / nodes, k = i % nodes;
        return k < corners ? mesh.cells[cell * corners + k] : mesh.mid_nodes[cell * mids + k - corners];
    });
}

std::string fault_of_names(std::vector<std::string> all, Names names) {
    for (const std::string& name : all) {
        if (name.empty()) return "a field has no name";
        if (names == Names::xml && !xml_attribute(name)) {
            return "the name of field " + in_quotes(name) + " has bytes that XML cannot hold";
        }
    }
    std::sort(all.begin(), all.end());
    const auto twice = std::adjacent_find(all.begin(), all.end());
    return twice == all.end() ? "" : "two fields are named " + in_quotes(*twice);
}

std::string fault_of_mesh(const Mesh& mesh, Names names) {
    if (const char* const found = mesh::inconsistency(mesh, mesh::FieldValues::any); found != nullptr) return found;
    std::vector<std::string> of_points, of_cells;
    for (const Field& field : mesh.point_fields) of_points.push_back(field.name);
    if (!mesh.point_markers.empty()) of_points.emplace_back(marker_name);
    for (const Field& field : mesh.cell_fields) of_cells.push_back(field.name);
    for (const Column& labels : mesh.cell_labels) {
        of_cells.push_back(labels.name);
        if (labels.size() != mesh.cell_count()) return "the labels of cells do not match the cells";
        if (std::string fault = fault_of_column(labels); !fault.empty()) return fault;
    }
    std::string fault = fault_of_names(std::move(of_points), names);
    return !fault.empty() ? fault : fault_of_names(std::move(of_cells), names);
}

bool needs_wide_indices(const Mesh& mesh) {
    return mesh.cells.size() + mesh.mid_nodes.size() > std::numeric_limits<std::int32_t>::max();
}

std::vector<OutArray> point_arrays_of(const Mesh& mesh) {
    std::vector<OutArray> arrays;
    for (const Field& field : mesh.point_fields) arrays.push_back(array_of_field(field));
    if (!mesh.point_markers.empty())
        arrays.push_back(array_in_memory<std::int64_t>({marker_name, 1, VtiType::int64}, mesh.point_markers));
    return arrays;
}

std::vector<OutArray> cell_arrays_of(const Mesh& mesh, std::vector<std::string>& room) {
    std::vector<OutArray> arrays;
    room.resize(mesh.cell_labels.size());
    for (const Field& field : mesh.cell_fields) arrays.push_back(array_of_field(field));
    for (std::size_t i = 0; i < room.size(); ++i) arrays.push_back(array_of_column(mesh.cell_labels[i], room[i]));
    return arrays;
}

Error cannot_write(const std::string& what, const std::string& fault, const std::string& path) {
    return {.what = "cannot write " + what + ": " + fault, .file = path, .remedy = "correct it in memory"};
}

}  // namespace barycert::io

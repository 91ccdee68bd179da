#include <limits>
#include <new>

#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/io/vtk/out_file.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/mesh/consistency.hpp"
#include "barycert/mesh/mid_edges.hpp"

namespace barycert::io {
namespace {

/// What is wrong with the mesh or the names of its fields, in one clause; empty if nothing is.
std::string fault_of_mesh(const Mesh& mesh, Names names) {
    if (const char* const found = mesh::inconsistency(mesh, mesh::FieldValues::any); found != nullptr) return found;
    std::vector<std::string> of_points, of_cells;
    for (const Field& field : mesh.point_fields) of_points.push_back(field.name);
    if (!mesh.point_markers.empty()) of_points.emplace_back(marker_name);
    for (const Field& field : mesh.cell_fields) of_cells.push_back(field.name);
    for (const Column& labels : mesh.cell_labels) {
        of_cells.push_back(labels.name);
        if (labels.size() != mesh.cell_count()) return "the labels of cells do not match the cells";
        if (labels.type() != Column::Type::text) continue;
        for (const std::string& text : std::get<std::vector<std::string>>(labels.values)) {
            if (text.find('\0') != std::string::npos)
                return "the labels \"" + labels.name + "\" hold a zero byte, which ends a text there";
        }
    }
    std::string fault = fault_of_names(std::move(of_points), names);
    return !fault.empty() ? fault : fault_of_names(std::move(of_cells), names);
}

template <class Offset>
OutArray offsets_of(const Mesh& mesh, NumberType type) {
    return array_made<Offset>({"offsets", 1, type}, mesh.cell_count(),
                              [nodes = nodes_a_cell(mesh)](std::size_t i) { return nodes * (i + 1); });
}

Status write_unstructured(const Mesh& mesh, const std::string& path, VtkData data) {
    std::vector<std::string> room;
    const std::size_t nodes = nodes_a_cell(mesh), cells = mesh.cell_count();
    const bool wide = nodes * cells > std::numeric_limits<std::int32_t>::max();
    const ArrayFormat format{"connectivity", 1, NumberType::int32};
    const auto node = [&mesh, nodes](std::size_t i) { return node_of(mesh, nodes, i / nodes, i % nodes); };
    const auto type = [own = cell_type_of(mesh)](std::size_t) { return own; };
    return write_xml({.data_set = "UnstructuredGrid",
                      .piece = " NumberOfPoints=\"" + std::to_string(mesh.point_count()) + "\" NumberOfCells=\"" +
                               std::to_string(cells) + "\"",
                      .sections = {{"PointData", point_arrays_of(mesh)},
                                   {"CellData", cell_arrays_of(mesh, room)},
                                   {"Points", {array_of_points(mesh.points, mesh.dimension)}},
                                   {"Cells",
                                    {mesh.mid_nodes.empty() ? array_in_memory<Mesh::Index>(format, mesh.cells)
                                                            : array_made<std::int32_t>(format, nodes * cells, node),
                                     wide ? offsets_of<std::int64_t>(mesh, NumberType::int64)
                                          : offsets_of<std::int32_t>(mesh, NumberType::int32),
                                     array_made<std::uint8_t>({"types", 1, NumberType::uint8}, cells, type)}}}},
                     path, data);
}

Status write_checked(const Mesh& mesh, const std::string& path, VtkData data, Names names,
                     Status (*write)(const Mesh& mesh, const std::string& path, VtkData data)) {
    const ExactEnvironment environment;
    if (const std::string fault = fault_of_mesh(mesh, names); !fault.empty())
        return cannot_write("the mesh", fault, path);
    try {
        return write(mesh, path, data);
    } catch (const std::bad_alloc&) {
        return file_error(path, "too little memory to write the mesh", {}, {}, "free some memory");
    }
}

}  // namespace

std::uint8_t cell_type_of(const Mesh& mesh) {
    if (mesh.dimension == 2) return mesh.mid_nodes.empty() ? vtk_triangle : vtk_quadratic_triangle;
    return mesh.mid_nodes.empty() ? vtk_tetra : vtk_quadratic_tetra;
}

std::size_t nodes_a_cell(const Mesh& mesh) {
    return mesh.corners() + (mesh.mid_nodes.empty() ? 0 : mesh::edges_of(mesh.dimension).size());
}

std::vector<OutArray> point_arrays_of(const Mesh& mesh) {
    std::vector<OutArray> arrays;
    for (const Field& field : mesh.point_fields) arrays.push_back(array_of_field(field));
    if (!mesh.point_markers.empty())
        arrays.push_back(array_in_memory<std::int64_t>({marker_name, 1, NumberType::int64}, mesh.point_markers));
    return arrays;
}

std::vector<OutArray> cell_arrays_of(const Mesh& mesh, std::vector<std::string>& room) {
    std::vector<OutArray> arrays;
    room.resize(mesh.cell_labels.size());
    for (const Field& field : mesh.cell_fields) arrays.push_back(array_of_field(field));
    for (std::size_t i = 0; i < room.size(); ++i) {
        const auto& [name, values] = mesh.cell_labels[i];
        if (const auto* const numbers = std::get_if<std::vector<std::int64_t>>(&values); numbers != nullptr) {
            arrays.push_back(array_in_memory<std::int64_t>({name, 1, NumberType::int64}, *numbers));
        } else if (const auto* const reals = std::get_if<std::vector<double>>(&values); reals != nullptr) {
            arrays.push_back(array_in_memory<double>({name, 1, NumberType::float64}, *reals));
        } else {
            for (const std::string& text : std::get<std::vector<std::string>>(values))
                room[i].append(text).push_back('\0');
            arrays.push_back(array_in_memory<char>({name, 1, NumberType::text}, room[i]));
        }
    }
    return arrays;
}

}  // namespace barycert::io

namespace barycert {

Status write_vtu(const Mesh& mesh, const std::string& path, VtkData data) {
    return io::write_checked(mesh, path, data, io::Names::xml, &io::write_unstructured);
}

Status write_vtk(const Mesh& mesh, const std::string& path, VtkData data) {
    if (path.ends_with(".vtu")) return write_vtu(mesh, path, data);
    if (!path.ends_with(".vtk"))
        return file_error(path, "unknown file suffix", ".vtu or .vtk", {}, "use one of these suffixes");
    if (data != VtkData::raw && data != VtkData::ascii)
        return file_error(path, "legacy files of VTK (.vtk) know no compression", "raw or ascii",
                          std::string(name(data)), "write a .vtu file");
    return io::write_checked(mesh, path, data, io::Names::any, &io::write_legacy);
}

}  // namespace barycert

// Meshes as VTK's files, in XML and in the legacy format.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "files/format.hpp"
#include "io/vtk/out_file.hpp"
#include "io/vtk/out_grid.hpp"
#include "io/vtk/raw_grid.hpp"
#include "mesh/consistency.hpp"
#include "mesh/pulling.hpp"

namespace barycert::io {
namespace {

/// Says, in one clause, what is wrong with the mesh, names of fields aside; empty if nothing is.
std::string fault_of_mesh(const Mesh& mesh) {
    if (const char* const found = mesh::inconsistency(mesh, mesh::FieldValues::any); found != nullptr) return found;
    for (const Column& labels : mesh.cell_labels) {
        if (labels.size() != mesh.cell_count()) return "the labels of cells do not match the cells";
        if (labels.type() != Column::Type::text) continue;
        if (std::ranges::any_of(std::get<std::vector<std::string>>(labels.values), has_zero_byte))
            return "the labels \"" + labels.name + "\" hold a zero byte, which ends a text there";
    }
    return {};
}

/// Arrays of cells: fields and labels. Texts go to `room`, which must outlive them.
std::vector<OutArray> cell_arrays_of(const Mesh& mesh, std::vector<std::string>& room) {
    std::vector<OutArray> arrays = arrays_of(mesh.cell_fields);
    room.resize(mesh.cell_labels.size());
    for (std::size_t i = 0; i < room.size(); ++i) {
        const Column& labels = mesh.cell_labels[i];
        const auto add = [&]<class T>(const std::vector<T>& all) {
            if constexpr (std::is_same_v<T, std::string>) {
                arrays.push_back(array_in_memory<char>(labels.name, room[i] = with_ends(all)));
            } else {
                arrays.push_back(array_in_memory<T>(labels.name, all));
            }
        };
        std::visit(add, labels.values);
    }
    return arrays;
}

Status write_mesh(const Mesh& mesh, const std::string& path, VtkData data, Names names) {
    const ExactEnvironment environment;
    try {
        std::string fault = fault_of_mesh(mesh);
        if (!fault.empty()) return cannot_write("the mesh", fault, path);
        std::vector<std::string> room;
        const CellNodes node{mesh};
        const bool shaped = !mesh.shapes.types.empty();
        const std::size_t cells = mesh.whole_count();
        const Mesh rows = shaped ? mesh::rows_of_wholes(mesh) : Mesh();
        OutGrid grid{
            .point_arrays = arrays_of(mesh.point_fields),
            .cell_arrays = cell_arrays_of(shaped ? rows : mesh, room),
            .points = array_of_points(mesh.points, mesh.dimension),
            .connectivity = mesh.mid_nodes.empty()
                                ? array_in_memory<Mesh::Index>("connectivity", shaped ? mesh.shapes.nodes : mesh.cells)
                                : array_made<Mesh::Index>("connectivity", node.nodes * cells, node),
            .cells = cells,
            .nodes = node.nodes,
            .type = node.type(),
            .shapes = shaped ? &mesh.shapes : nullptr};
        if (!mesh.point_markers.empty())
            grid.point_arrays.push_back(array_in_memory<std::int64_t>(marker_name, mesh.point_markers));
        fault = fault_of_names(grid.point_arrays, names);
        if (fault.empty()) fault = fault_of_names(grid.cell_arrays, names);
        if (!fault.empty()) return cannot_write("the mesh", fault, path);
        return names == Names::xml ? write_grid(std::move(grid), path, data)
                                   : write_legacy_grid(std::move(grid), node, path, data == VtkData::ascii);
    } catch (const std::bad_alloc&) {
        return file_error("memory.short", path, "too little memory to write the mesh", {}, {}, "free some memory");
    }
}

}  // namespace

}  // namespace barycert::io

namespace barycert {

Status write_vtu(const Mesh& mesh, const std::string& path, VtkData data) {
    return io::write_mesh(mesh, path, data, io::Names::xml);
}

Status write_vtk(const Mesh& mesh, const std::string& path, VtkData data) {
    const base::FormatKind kind = base::kind_of(path);
    if (kind == base::FormatKind::vtu) return write_vtu(mesh, path, data);
    if (kind != base::FormatKind::vtk)
        return file_error("file.suffix", path, "unknown file suffix", ".vtu or .vtk", {}, "use one of these suffixes");
    if (data != VtkData::raw && data != VtkData::ascii)
        return file_error("option.unfit", path, "legacy files of VTK (.vtk) know no compression", "raw or ascii",
                          std::string(name(data)), "write a .vtu file");
    return io::write_mesh(mesh, path, data, io::Names::legacy);
}

}  // namespace barycert

#include <cstddef>
#include <new>
#include <string>

#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/io/vtk/mesh_arrays.hpp"
#include "barycert/io/vtk/xml_writer.hpp"

namespace barycert {
namespace {

template <class Offset>
io::OutArray offsets_of(const Mesh& mesh, io::VtiType type) {
    const std::size_t nodes = io::nodes_a_cell(mesh);
    return io::array_made<Offset>({"offsets", 1, type}, mesh.cell_count(),
                                  [nodes](std::size_t i) { return nodes * (i + 1); });
}

Status write_mesh(const Mesh& mesh, const std::string& path, VtkData data) {
    std::vector<std::string> room;
    io::OutFile file{.data_set = "UnstructuredGrid", .attributes = {}, .piece = {}, .sections = {}};
    file.piece = " NumberOfPoints=\"" + std::to_string(mesh.point_count()) + "\" NumberOfCells=\"" +
                 std::to_string(mesh.cell_count()) + "\"";
    const std::uint8_t type = io::cell_type_of(mesh);
    file.sections.push_back({"PointData", io::point_arrays_of(mesh)});
    file.sections.push_back({"CellData", io::cell_arrays_of(mesh, room)});
    file.sections.push_back({"Points", {io::array_of_points(mesh.points, mesh.dimension)}});
    file.sections.push_back({"Cells",
                             {io::connectivity_of(mesh),
                              io::needs_wide_indices(mesh) ? offsets_of<std::int64_t>(mesh, io::VtiType::int64)
                                                           : offsets_of<std::int32_t>(mesh, io::VtiType::int32),
                              io::array_made<std::uint8_t>({"types", 1, io::VtiType::uint8}, mesh.cell_count(),
                                                           [type](std::size_t) { return type; })}});
    return io::write_xml(file, path, data);
}

}  // namespace

Status write_vtu(const Mesh& mesh, const std::string& path, VtkData data) {
    const ExactEnvironment environment;
    if (const std::string fault = io::fault_of_mesh(mesh, io::Names::xml); !fault.empty())
        return io::cannot_write("the mesh", fault, path);
    try {
        return write_mesh(mesh, path, data);
    } catch (const std::bad_alloc&) {
        return Error{.what = "too little memory to write the mesh", .file = path, .remedy = "free some memory"};
    }
}

}  // namespace barycert

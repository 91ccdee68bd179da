#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/gradient.hpp"
#include "barycert/io.hpp"
#include "mesh_object.hpp"

namespace barycert::python {
namespace {

/// Node indices of any integer type, each of which must be a node.
template <class T>
std::vector<Mesh::Index> indices_as(const py::array& cells, std::size_t columns, std::size_t nodes) {
    const Array<T> array(cells);
    const std::span<const T> all = span_of(array);
    std::vector<Mesh::Index> out(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (std::cmp_less(all[i], 0) || std::cmp_greater_equal(all[i], nodes))
            throw Exception(
                {.what = "cells[" + std::to_string(i / columns) + ", " + std::to_string(i % columns) + "] is no node",
                 .expected = nodes == 0 ? "no cells, as there are no nodes" : "0 to " + std::to_string(nodes - 1),
                 .found = std::to_string(all[i]),
                 .remedy = "indices count from 0: see where they were made"});
        out[i] = static_cast<Mesh::Index>(all[i]);  // NOLINT(bugprone-signed-char-misuse): chars are numbers here
    }
    return out;
}

std::vector<Mesh::Index> indices_of(const py::array& cells, std::size_t columns, std::size_t nodes) {
    const auto of = [&]<class Signed, class Unsigned>(Signed, Unsigned) {
        return cells.dtype().kind() == 'i' ? indices_as<Signed>(cells, columns, nodes)
                                           : indices_as<Unsigned>(cells, columns, nodes);
    };
    switch (cells.itemsize()) {
        case 1:
            return of(std::int8_t{}, std::uint8_t{});
        case 2:
            return of(std::int16_t{}, std::uint16_t{});
        case 4:
            return of(std::int32_t{}, std::uint32_t{});
        default:
            return of(std::int64_t{}, std::uint64_t{});
    }
}

/// points (n, 2 or 3); cells (m, 3 or 6 in the plane, 4 or 10 in space), integers.
MeshObject make_mesh(const Given<double>& points, const py::array& cells, std::vector<Mesh::Index> cell_numbers) {
    Mesh mesh;
    mesh.dimension = static_cast<int>(points.shape(1));
    mesh.points.assign(points.data(), points.data() + points.size());
    const auto columns = static_cast<std::size_t>(cells.shape(1)), corners = mesh.corners();
    if (mesh.point_count() > std::numeric_limits<Mesh::Index>::max() ||
        cells.shape(0) > std::numeric_limits<Mesh::Index>::max())
        throw Exception({.what = "a mesh has at most 2147483647 nodes and cells"});
    std::vector<Mesh::Index> all = indices_of(cells, columns, mesh.point_count());
    if (columns == corners) {
        mesh.cells = std::move(all);
    } else {
        mesh.mid_edge_order = MidEdgeOrder::vtk;
        for (auto row = all.cbegin(); row != all.cend(); row += static_cast<std::ptrdiff_t>(columns)) {
            const auto middle = row + static_cast<std::ptrdiff_t>(corners);
            mesh.cells.insert(mesh.cells.end(), row, middle);
            mesh.mid_nodes.insert(mesh.mid_nodes.end(), middle, row + static_cast<std::ptrdiff_t>(columns));
        }
    }
    const auto bad =
        std::find_if_not(mesh.points.begin(), mesh.points.end(), [](double x) { return std::isfinite(x); });
    if (bad != mesh.points.end()) {
        const auto i = bad - mesh.points.begin();
        throw Exception({.what = "points[" + std::to_string(i / mesh.dimension) + ", " +
                                 std::to_string(i % mesh.dimension) + "] is not finite",
                         .found = std::to_string(*bad)});
    }
    mesh.cell_numbers = std::move(cell_numbers);
    return MeshObject(std::move(mesh));
}

/// Of each cell or node, if the mesh has some.
template <class T>
py::object if_any(const MeshObject& mesh, const std::vector<T>& numbers, std::size_t columns = 0) {
    if (numbers.empty()) return py::none();
    return view(numbers, mesh.geometry(), columns);
}

py::object field_named(const MeshObject& mesh, const std::string& name, bool of_cells) {
    const std::shared_ptr<const Mesh> fields = mesh.fields();
    for (const Field& field : of_cells ? fields->cell_fields : fields->point_fields) {
        if (field.name == name) return view(field.data, fields, static_cast<std::size_t>(field.components));
    }
    return py::none();
}

std::vector<std::string> field_names(const MeshObject& mesh, bool of_cells) {
    std::vector<std::string> names;
    for (const Field& field : of_cells ? mesh.fields()->cell_fields : mesh.fields()->point_fields)
        names.push_back(field.name);
    return names;
}

Field field_of(std::string name, const Given<double>& values) {
    return {std::move(name), static_cast<int>(values.shape(1)), {values.data(), values.data() + values.size()}};
}

/// No values: takes the field out.
void set_field(MeshObject& mesh, const std::string& name, const std::optional<Given<double>>& values, bool of_cells) {
    std::vector<Field>& fields = mesh.fields(of_cells);
    const auto place = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    if (!values) {
        if (place != fields.end()) fields.erase(place);
    } else if (place == fields.end()) {
        fields.push_back(field_of(name, *values));
    } else {
        *place = field_of(name, *values);
    }
}

/// values (nodes, components): (cells, components, dimension).
py::array gradients_of(const MeshObject& object, const Given<double>& values, const py::object& callable) {
    const Mesh& mesh = object.mesh();
    const auto components = static_cast<std::size_t>(values.shape(1)), n = mesh.corners(), d = n - 1;
    Array<double> out(Shape{extent(mesh.cell_count()), extent(components), extent(d)});
    const std::span<double> all(out.mutable_data(), static_cast<std::size_t>(out.size()));
    const NodalValues<double> nodal{span_of(values), static_cast<int>(components)};
    in_blocks(Progress(callable), "gradients", mesh.cell_count(), [&](std::size_t first, std::size_t count) {
        const std::size_t row = components * d;
        check(gradients(mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron, mesh.points,
                        std::span(mesh.cells).subspan(n * first, n * count), nodal,
                        all.subspan(row * first, row * count)));
    });
    return out;
}

std::vector<std::pair<std::string, bool>> notes_of(const MeshObject& mesh) {
    std::vector<std::pair<std::string, bool>> notes;
    for (const Note& note : mesh.mesh().notes) notes.emplace_back(message(note), note.important);
    return notes;
}

/// The figures of CurvedCells, and what to warn of: empty if no cell is curved.
std::pair<py::dict, std::string> take_mesh_as_straight(const MeshObject& object, const std::string& file, bool refuse) {
    const CurvedCells curved = take(take_as_straight(object.mesh(), file, refuse ? Curved::refuse : Curved::straight));
    using namespace pybind11::literals;
    return {py::dict("cells"_a = curved.cells, "max_deviation"_a = curved.max_deviation,
                     "rounded_cells"_a = curved.rounded_cells, "max_rounded"_a = curved.max_rounded),
            curved.cells == 0 ? std::string() : message(curved)};
}

MeshObject read(const std::string& path, std::optional<std::size_t> number, bool last, std::optional<double> time) {
    const py::gil_scoped_release unlocked;
    return MeshObject(take(read_mesh(path, {.step = {.number = number, .time = time, .last = last}})));
}

void write(const MeshObject& object, const std::string& path, const std::string& comment, const std::string& data) {
    const auto encoding = vtk_data_named(data);
    if (!encoding)
        throw Exception(
            {.what = "encoding of VTK's files", .expected = "raw, zlib, lz4, lzma or ascii", .found = data});
    const py::gil_scoped_release unlocked;
    check(write_mesh(object.whole(), path, {.comment = comment, .data = *encoding}));
}

}  // namespace

void bind_mesh(py::module_& module) {
    py::class_<MeshObject>(module, "Mesh")
        .def(py::init(&make_mesh))
        .def_property_readonly("dimension", [](const MeshObject& m) { return m.mesh().dimension; })
        .def_property_readonly("points",
                               [](const MeshObject& m) { return view(m.mesh().points, m.geometry(), m.dimension()); })
        .def_property_readonly(
            "cells", [](const MeshObject& m) { return view(m.mesh().cells, m.geometry(), m.mesh().corners()); })
        .def_property_readonly(
            "mid_nodes",
            [](const MeshObject& m) { return if_any(m, m.mesh().mid_nodes, m.mesh().dimension == 2 ? 3 : 6); })
        .def_property_readonly("cell_numbers", [](const MeshObject& m) { return if_any(m, m.mesh().cell_numbers); })
        .def_property_readonly("point_markers", [](const MeshObject& m) { return if_any(m, m.mesh().point_markers); })
        .def_property_readonly("notes", &notes_of)
        .def("take_as_straight", &take_mesh_as_straight)
        .def("field_names", &field_names)
        .def("field", &field_named)
        .def("set_field", &set_field)
        .def("sampler", &MeshObject::sampler)
        .def("sampler_of",
             [](const MeshObject& m, const std::optional<Given<double>>& values, const py::object& callable) {
                 return m.sampler_of(values ? std::optional(field_of("value", *values)) : std::nullopt, callable);
             })
        .def("gradients", &gradients_of)
        .def("write", &write);
    module.def("read", &read);
}

}  // namespace barycert::python

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "barycert/check.hpp"
#include "barycert/gradient.hpp"
#include "barycert/io.hpp"
#include "barycert/result.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "mesh_object.hpp"

namespace barycert::python {
namespace {

namespace py = pybind11;

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
    const bool is_signed = cells.dtype().kind() == 'i';
    switch (cells.itemsize()) {
        case 1:
            return is_signed ? indices_as<std::int8_t>(cells, columns, nodes)
                             : indices_as<std::uint8_t>(cells, columns, nodes);
        case 2:
            return is_signed ? indices_as<std::int16_t>(cells, columns, nodes)
                             : indices_as<std::uint16_t>(cells, columns, nodes);
        case 4:
            return is_signed ? indices_as<std::int32_t>(cells, columns, nodes)
                             : indices_as<std::uint32_t>(cells, columns, nodes);
        default:
            return is_signed ? indices_as<std::int64_t>(cells, columns, nodes)
                             : indices_as<std::uint64_t>(cells, columns, nodes);
    }
}

/// points (n, 2 or 3); cells (m, 3 or 6 in the plane, 4 or 10 in space), integers.
MeshObject make_mesh(const Array<double>& points, const py::array& cells, std::vector<Mesh::Index> cell_numbers) {
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

py::array nodes_of(const std::vector<Mesh::Index>& nodes, std::size_t columns, const MeshObject& mesh) {
    return view(nodes.data(), {extent(nodes.size() / columns), extent(columns)}, mesh.geometry());
}

py::array field_view(const std::shared_ptr<const Mesh>& fields, const Field& field) {
    const auto components = static_cast<std::size_t>(field.components);
    return view(field.data.data(), {extent(field.data.size() / components), extent(components)}, fields);
}

py::object field_named(const MeshObject& mesh, const std::string& name, bool of_cells) {
    const std::shared_ptr<const Mesh> fields = mesh.fields();
    for (const Field& field : of_cells ? fields->cell_fields : fields->point_fields) {
        if (field.name == name) return field_view(fields, field);
    }
    return py::none();
}

std::vector<std::string> field_names(const MeshObject& mesh, bool of_cells) {
    std::vector<std::string> names;
    for (const Field& field : of_cells ? mesh.fields()->cell_fields : mesh.fields()->point_fields)
        names.push_back(field.name);
    return names;
}

Field field_of(std::string name, const Array<double>& values) {
    return {std::move(name), static_cast<int>(values.shape(1)), {values.data(), values.data() + values.size()}};
}

/// values (nodes, components): (cells, components, dimension).
py::array gradients_of(const MeshObject& object, const Array<double>& values, const py::object& callable) {
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
        .def(py::init(&make_mesh), py::arg("points").noconvert(), py::arg("cells").noconvert(),
             py::arg("cell_numbers") = std::vector<Mesh::Index>())
        .def_property_readonly("dimension", [](const MeshObject& m) { return m.mesh().dimension; })
        .def_property_readonly(
            "points",
            [](const MeshObject& m) {
                const auto d = static_cast<std::size_t>(m.mesh().dimension);
                return view(m.mesh().points.data(), {extent(m.mesh().point_count()), extent(d)}, m.geometry());
            })
        .def_property_readonly("cells",
                               [](const MeshObject& m) { return nodes_of(m.mesh().cells, m.mesh().corners(), m); })
        .def_property_readonly("mid_nodes",
                               [](const MeshObject& m) -> py::object {
                                   if (m.mesh().mid_nodes.empty()) return py::none();
                                   return nodes_of(m.mesh().mid_nodes, m.mesh().dimension == 2 ? 3 : 6, m);
                               })
        .def_property_readonly("cell_numbers",
                               [](const MeshObject& m) -> py::object {
                                   const std::vector<Mesh::Index>& numbers = m.mesh().cell_numbers;
                                   if (numbers.empty()) return py::none();
                                   return view(numbers.data(), {extent(numbers.size())}, m.geometry());
                               })
        .def_property_readonly("point_markers",
                               [](const MeshObject& m) -> py::object {
                                   const std::vector<std::int64_t>& markers = m.mesh().point_markers;
                                   if (markers.empty()) return py::none();
                                   return view(markers.data(), {extent(markers.size())}, m.geometry());
                               })
        .def_property_readonly("notes", &notes_of)
        .def("take_as_straight", &take_mesh_as_straight, py::arg("file"), py::arg("refuse"))
        .def("field_names", &field_names, py::arg("of_cells"))
        .def("field", &field_named, py::arg("name"), py::arg("of_cells"))
        .def(
            "set_field",
            [](MeshObject& m, std::string name, const Array<double>& values, bool of_cells) {
                m.set_field(field_of(std::move(name), values), of_cells);
            },
            py::arg("name"), py::arg("values").noconvert(), py::arg("of_cells"))
        .def("remove_field", &MeshObject::remove_field, py::arg("name"), py::arg("of_cells"))
        .def(
            "sampler",
            [](MeshObject& m, const std::vector<std::string>& names, py::object progress) {
                return std::const_pointer_cast<BoundSampler>(m.sampler(names, Progress(std::move(progress))));
            },
            py::arg("names"), py::arg("progress"))
        .def(
            "sampler_of",
            [](const MeshObject& m, const Array<double>& values, py::object progress) {
                return std::const_pointer_cast<BoundSampler>(
                    m.sampler_of(field_of("value", values), Progress(std::move(progress))));
            },
            py::arg("values").noconvert(), py::arg("progress"))
        .def(
            "bare_sampler",
            [](const MeshObject& m, py::object progress) {
                return std::const_pointer_cast<BoundSampler>(m.bare_sampler(Progress(std::move(progress))));
            },
            py::arg("progress"))
        .def("gradients", &gradients_of, py::arg("values").noconvert(), py::arg("progress"))
        .def("write", &write, py::arg("path"), py::arg("comment"), py::arg("data"));
    module.def("read", &read, py::arg("path"), py::arg("number"), py::arg("last"), py::arg("time"));
}

}  // namespace barycert::python

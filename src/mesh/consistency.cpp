#include "mesh/consistency.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/finite.hpp"
#include "mesh/mid_edges.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::mesh {
namespace {

constexpr const char* too_many = "it has more than 2147483647 nodes or cells";

bool all_within(const std::vector<Mesh::Index>& indices, Mesh::Index lowest, std::size_t count) {
    // One comparison each, without a branch: compilers make vectors of it.
    const auto low = static_cast<std::uint32_t>(lowest);
    const std::uint32_t limit = static_cast<std::uint32_t>(std::min(count, std::size_t{1} << 31)) - low;
    return base::parallel_reduce(
        indices.size(), std::size_t{1} << 16, true,
        [&](std::size_t begin, std::size_t end, bool& good) {
            std::uint32_t bad = 0;
            for (std::size_t i = begin; i != end; ++i)
                bad |= static_cast<std::uint32_t>(indices[i]) - low >= limit ? 1U : 0U;
            good = good && bad == 0;
        },
        [](bool& all, bool part) { all = all && part; });
}

/// Nothing, or one a row.
template <class T>
bool fits(const std::vector<T>& values, std::size_t rows) {
    return values.empty() || values.size() == rows;
}

const char* fault_of_fields(const std::vector<Field>& fields, std::size_t rows, FieldValues values) {
    for (const Field& field : fields) {
        if (field.components < 1) return "a field has no components";
        if (field.data.size() != rows * static_cast<std::size_t>(field.components))
            return "a field does not have one value per node or cell";
        if (values == FieldValues::finite && !base::all_finite(field.data))
            return "a value of a field is not finite, which the format cannot hold";
    }
    return nullptr;
}

}  // namespace

bool is_increasing(std::span<const double> x) {
    return x.size() > 1 && base::all_finite(x) && std::ranges::adjacent_find(x, std::greater_equal()) == x.end();
}

const char* inconsistency_of_axes(const Mesh& mesh) {
    if (mesh.dimension != 2 && mesh.dimension != 3) return "its dimension is neither 2 nor 3";
    double nodes = 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k) {
        if (!is_increasing(mesh.axes[k])) return "the coordinates along an axis are not two or more that increase";
        nodes *= static_cast<double>(mesh.axes[k].size());
    }
    if (nodes > INT32_MAX) return too_many;
    return mesh.points.empty() && mesh.cells.empty() ? nullptr : "it has axes, and lists nodes or cells";
}

const char* inconsistency_of_extras(const Mesh& mesh, FieldValues values) {
    const std::size_t nodes = mesh.point_count();
    if (mesh.index_base != 0 && mesh.index_base != 1) return "its index base is neither 0 nor 1";
    if (!fits(mesh.point_markers, nodes)) return "the markers do not match the nodes";
    if (const char* fault = fault_of_fields(mesh.point_fields, nodes, values); fault != nullptr) return fault;
    if (const char* fault = fault_of_fields(mesh.cell_fields, mesh.cell_count(), values); fault != nullptr)
        return fault;
    const Mesh::Shapes& shapes = mesh.shapes;
    if (!fits(shapes.inside, mesh.cell_count())) return "its shapes do not match the cells";
    const std::vector<Mesh::Index>& parts = shapes.parts;
    const bool ascend = std::ranges::adjacent_find(parts, std::greater_equal()) == parts.end();
    if (shapes.count() == 0
            ? parts.size() > 1 || (!parts.empty() && mesh.cell_count() != 0)
            : parts.size() != shapes.count() + 1 || shapes.ends.size() != shapes.count() || parts.front() != 0 ||
                  !ascend || parts.back() != static_cast<Mesh::Index>(mesh.cell_count()) ||
                  mesh.cell_numbers.size() != mesh.cell_count())
        return "its cells are not the parts of its shapes";
    if (!fits(mesh.mid_nodes, mesh.cell_count() * edges_of(mesh.dimension).size()))
        return "the mid-edge nodes do not match the cells";
    if (!all_within(mesh.mid_nodes, 0, nodes)) return "a mid-edge node of a cell is not a node";
    if (!mesh.mid_nodes.empty() && edge_sequence(mesh.mid_edge_order, mesh.dimension).empty())
        return "the order of the mid-edge nodes is not set, or is of another dimension";
    return nullptr;
}

const char* inconsistency_of_cells(const Mesh& mesh, FieldValues values) {
    if (mesh.dimension != 2 && mesh.dimension != 3) return "its dimension is neither 2 nor 3";
    if (!mesh.is_listed()) return not_listed;
    if (mesh.points.size() % static_cast<std::size_t>(mesh.dimension) != 0)
        return "the number of coordinates is not a multiple of the dimension";
    if (std::max(mesh.point_count(), mesh.cell_count()) > INT32_MAX) return too_many;
    if (!base::all_finite(mesh.points)) return "a coordinate is not finite";
    if (mesh.cells.size() % mesh.corners() != 0)
        return "the number of vertex indices is not a multiple of the vertices of a cell";
    if (!all_within(mesh.cells, 0, mesh.point_count())) return "a vertex of a cell is not a node";
    if (!fits(mesh.neighbours, mesh.cells.size())) return "the neighbours do not match the cells";
    if (!all_within(mesh.neighbours, -1, mesh.cell_count())) return "a neighbour is not a cell";
    if (mesh.dimension == 2 && !mesh.faces.empty()) return faces_of_triangles;
    if (mesh.faces.size() % 3 != 0) return "the number of face indices is not a multiple of 3";
    if (!all_within(mesh.faces, 0, mesh.point_count())) return "a vertex of a face is not a node";
    return inconsistency_of_extras(mesh, values);
}

const char* inconsistency(const Mesh& mesh, FieldValues values) {
    if (const char* fault = inconsistency_of_cells(mesh, values); fault != nullptr) return fault;
    if (mesh.face_count() > INT32_MAX) return "it has more than 2147483647 faces";
    if (!fits(mesh.face_mid_nodes, mesh.faces.size())) return "the mid-edge nodes do not match the faces";
    if (!all_within(mesh.face_mid_nodes, 0, mesh.point_count())) return "a mid-edge node of a face is not a node";
    if (!fits(mesh.face_markers, mesh.face_count())) return "the markers do not match the faces";
    return nullptr;
}

Status check_field(const Field* field, std::size_t rows, const char* of) {
    if (field == nullptr) return Error{.code = "field.unknown", .what = "a field is missing"};
    const std::string name = "field \"" + field->name + '"';
    if (field->components < 1)
        return file_error("field.component", {}, "number of components of " + name, "at least 1",
                          std::to_string(field->components));
    const std::size_t expected = rows * static_cast<std::size_t>(field->components);
    if (field->data.size() == expected) return Done{};
    return file_error("field.size", {}, "size of " + name,
                      std::to_string(expected) + " numbers, " + std::to_string(field->components) + " for each " + of,
                      std::to_string(field->data.size()));
}

}  // namespace barycert::mesh

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "core/base/finite.hpp"
#include "core/base/large_pages.hpp"
#include "mesh/consistency.hpp"
#include "mesh/surface/parts.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::surface {
namespace {

Error bad_mesh(std::string found) {
    return {.code = "mesh.inconsistent",
            .what = "the mesh is inconsistent",
            .found = std::move(found),
            .remedy = "correct the mesh in memory"};
}

}  // namespace

Error bad_index() {
    return bad_mesh("a corner of a cell that is no node");
}

Status check_input(const Mesh& mesh, int dimension, const CutOptions& options) {
    if (mesh.dimension != 2 && mesh.dimension != 3) return bad_mesh("a dimension that is neither 2 nor 3");
    if (!mesh.is_listed()) return bad_mesh(mesh::not_listed);
    if (dimension != 0 && mesh.dimension != dimension)
        return file_error("mesh.dimension", {}, "a mesh of another dimension",
                          dimension == 3 ? "tetrahedra" : "triangles in the plane",
                          dimension == 3 ? "triangles in the plane" : "tetrahedra");
    if (mesh.points.size() % static_cast<std::size_t>(mesh.dimension) != 0 || mesh.cells.size() % mesh.corners() != 0)
        return bad_mesh("nodes or cells that are not whole");
    if (mesh.point_count() > INT32_MAX || mesh.cell_count() > INT32_MAX)
        return bad_mesh("more than 2147483647 nodes or cells");
    std::atomic<bool> finite{true};
    base::parallel_for(mesh.points.size(), grain, [&](std::size_t begin, std::size_t end) {
        if (!base::all_finite({mesh.points.data() + begin, end - begin})) finite = false;
    });
    if (!finite) return bad_mesh("a coordinate that is not finite");
    Status fit = Done{};
    for (const Field* const field : options.point_fields)
        if (fit) fit = mesh::check_field(field, mesh.point_count(), "node");
    for (const Field* const field : options.cell_fields)
        if (fit) fit = mesh::check_field(field, mesh.cell_count(), "cell");
    return fit;
}

std::vector<double> take_rows(const std::vector<double>& from, std::size_t columns,
                              const std::vector<Mesh::Index>& rows, std::size_t stride) {
    std::vector<double> to;
    base::resize_large(to, columns * (rows.size() / stride));
    base::parallel_for_each(rows.size() / stride, grain, [&](std::size_t i) {
        std::copy_n(from.data() + columns * static_cast<std::size_t>(rows[stride * i]), columns,
                    to.data() + columns * i);
    });
    return to;
}

void take_rows(const std::vector<const Field*>& fields, const std::vector<Mesh::Index>& rows, std::size_t stride,
               std::vector<Field>& to) {
    for (const Field* const field : fields)
        to.push_back({field->name, field->components,
                      take_rows(field->data, static_cast<std::size_t>(field->components), rows, stride)});
}

}  // namespace barycert::surface

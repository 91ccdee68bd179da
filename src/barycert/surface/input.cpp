#include "barycert/surface/parts.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <functional>
#include <string>

#include "barycert/base/strict_math.hpp"
#include "barycert/mesh/consistency.hpp"

namespace barycert::surface {
namespace {

/// Whether good(begin, end) holds on all parts of the range.
template <class Good>
bool all_parts(std::size_t count, Good good) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, count, std::size_t{1} << 15), true,
        [&](const auto& range, bool so_far) { return so_far && good(range.begin(), range.end()); },
        std::logical_and<>());
}

bool all_finite(const std::vector<double>& numbers) {
    return all_parts(numbers.size(), [&](std::size_t begin, std::size_t end) {
        double sum = 0;  // a finite number less itself is zero, any other NaN
        for (std::size_t i = begin; i < end; ++i) sum += numbers[i] - numbers[i];
        return sum == 0;
    });
}

Error bad_mesh(std::string found) {
    return {.what = "the mesh is inconsistent", .found = std::move(found), .remedy = "correct the mesh in memory"};
}

}  // namespace

Error bad_index() {
    return bad_mesh("a corner of a cell that is no node");
}

Status check_mesh(const Mesh& mesh, int dimension) {
    if (mesh.dimension != 2 && mesh.dimension != 3) return bad_mesh("a dimension that is neither 2 nor 3");
    if (dimension != 0 && mesh.dimension != dimension)
        return Error{.what = "a mesh of another dimension",
                     .expected = dimension == 3 ? "tetrahedra" : "triangles in the plane",
                     .found = dimension == 3 ? "triangles in the plane" : "tetrahedra"};
    if (mesh.points.size() % static_cast<std::size_t>(mesh.dimension) != 0 || mesh.cells.size() % mesh.corners() != 0)
        return bad_mesh("nodes or cells that are not whole");
    if (mesh.point_count() > INT32_MAX || mesh.cell_count() > INT32_MAX)
        return bad_mesh("more than 2147483647 nodes or cells");
    if (!all_finite(mesh.points)) return bad_mesh("a coordinate that is not finite");
    return Done{};
}

Status check_options(const Mesh& mesh, const CutOptions& options) {
    for (const Field* const field : options.point_fields) {
        if (Status fits = mesh::check_field(field, mesh.point_count(), "node"); !fits) return fits;
    }
    for (const Field* const field : options.cell_fields) {
        if (Status fits = mesh::check_field(field, mesh.cell_count(), "cell"); !fits) return fits;
    }
    return Done{};
}

}  // namespace barycert::surface

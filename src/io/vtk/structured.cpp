#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/large_pages.hpp"
#include "core/vtk_cell.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

std::array<std::size_t, 3> cells_along(const std::array<std::size_t, 3>& points) {
    std::array<std::size_t, 3> cells{};
    for (std::size_t axis = 0; axis < 3; ++axis) cells[axis] = std::max(points[axis], std::size_t{2}) - 1;
    return cells;
}

/// Cells between the points: voxels and pixels along axes, else hexahedra and quadrilaterals. Along an axis with one
/// point they have no extent.
void add_cells(const StructuredGrid& grid, RawGrid& to) {
    std::array<std::size_t, 3> step{1, grid.counts[0], grid.counts[0] * grid.counts[1]};
    const std::array<std::size_t, 3> cells = cells_along(grid.counts);
    const std::size_t count = grid.cell_count();
    std::vector<std::size_t> wide;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (grid.counts[axis] > 1) wide.push_back(step[axis]);
    }
    if (wide.empty()) return;
    const bool along_axes = !grid.axes[0].empty();
    constexpr std::array<std::array<std::uint8_t, 3>, 2> types{
        {{vtk_line, vtk_quad, vtk_hexahedron}, {vtk_line, vtk_pixel, vtk_voxel}}};
    const std::size_t corners = std::size_t{1} << wide.size();
    std::array<std::size_t, 8> offsets{};
    for (std::size_t corner = 0; corner < corners; ++corner) {
        // Hexahedra and quadrilaterals go round each layer.
        const std::size_t own = along_axes ? corner : corner ^ (corner >> 1U & 1U);
        for (std::size_t axis = 0; axis < wide.size(); ++axis) offsets[corner] += (own >> axis & 1U) * wide[axis];
    }
    to.types.assign(count, types[along_axes ? 1 : 0][wide.size() - 1]);
    base::resize_large(to.cells.ends, count);
    base::resize_large(to.cells.connectivity, count * corners);
    in_parallel(cells[2], [&](std::size_t k) {
        std::size_t cell = k * cells[0] * cells[1];
        for (std::size_t j = 0; j < cells[1]; ++j) {
            for (std::size_t i = 0; i < cells[0]; ++i, ++cell) {
                const std::size_t first = i + j * step[1] + k * step[2];
                to.cells.ends[cell] = static_cast<std::int64_t>((cell + 1) * corners);
                for (std::size_t corner = 0; corner < corners; ++corner)
                    to.cells.connectivity[cell * corners + corner] = static_cast<std::int32_t>(first + offsets[corner]);
            }
        }
    });
}

}  // namespace

std::string StructuredGrid::fault(std::size_t bytes_a_point) const {
    std::uint64_t points = 1;
    for (const std::size_t count : counts) points = std::min(points * count, max_entities + 1);  // at most 2^62
    if (points > max_entities) return std::to_string(max_entities) + " points at most";
    const std::uint64_t memory =
        static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return points > memory / 2 / bytes_a_point ? "as many points as fit in half of the memory of this machine" : "";
}

std::size_t StructuredGrid::cell_count() const {
    const std::array<std::size_t, 3> cells = cells_along(counts);
    return point_count() == 0 ? 0 : cells[0] * cells[1] * cells[2];
}

void StructuredGrid::append_to(RawGrid& grid, Wanted part) const {
    if (point_count() == 0) return;
    if (axes[0].empty() && part == Wanted::all) return add_cells(*this, grid);
    if (!axes[0].empty()) grid.unlisted = *this;
    if (grid.unlisted && (part != Wanted::all || point_count() == 1)) grid.list_points();
}

void RawGrid::list_points() {
    const StructuredGrid grid = *std::exchange(unlisted, {});
    points.resize(3 * grid.point_count());
    in_parallel(grid.counts[2], [&](std::size_t k) {
        double* to = points.data() + 3 * k * grid.counts[0] * grid.counts[1];
        for (const double y : grid.axes[1]) {
            for (const double x : grid.axes[0]) {
                for (const double own : {x, y, grid.axes[2][k]}) *to++ = own;
            }
        }
    });
}

void RawGrid::list(const std::string& path) {
    if (!unlisted) return;
    const StructuredGrid grid = *unlisted;
    if (const std::string fault = grid.fault(StructuredGrid::listed); !fault.empty())
        refuse_file("file.count", path, "the points of the grid", fault, std::to_string(grid.point_count()));
    list_points();
    add_cells(grid, *this);
}

}  // namespace barycert::io

/// Edges of surfaces, and facets of cells as one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/surface.hpp"

namespace barycert::surface {

/// An edge of triangles, by its points, and one of them.
using TriangleEdge = std::pair<std::pair<std::int32_t, std::int32_t>, std::int32_t>;

/// f(edges): for each edge all that it is of triangles.
template <class F>
void for_edges(const Surface& surface, F f) {
    std::vector<TriangleEdge> all;
    all.reserve(surface.cells.size());
    for (std::size_t t = 0; t < surface.cell_count(); ++t) {
        for (std::size_t c = 0; c < 3; ++c)
            all.emplace_back(std::minmax({surface.cells[3 * t + c], surface.cells[3 * t + (c + 1) % 3]}),
                             static_cast<std::int32_t>(t));
    }
    std::ranges::sort(all);
    for (std::size_t i = 0, first = 0; i < all.size(); first = i) {
        while (i < all.size() && all[i].first == all[first].first) ++i;
        f(std::span<const TriangleEdge>(all).subspan(first, i - first));
    }
}

/// Where a boundary bends by 30 degrees or more, as segments between points; in the plane all of it.
std::vector<std::int32_t> outline_of(const Surface& boundary);

/// The facets of all cells, or of these, ascending, without points of others; of a mesh in the plane, the cells. No
/// fields.
Surface facets_of(const Mesh& mesh);
Surface facets_of(const Mesh& mesh, std::vector<Mesh::Index> cells);

}  // namespace barycert::surface

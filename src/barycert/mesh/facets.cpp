#include "barycert/mesh/facets.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <tuple>

#include "barycert/mesh/large_vector.hpp"

namespace barycert::detail {
namespace {

/// The nodes of a facet, ascending; in 2D the first stands twice.
std::array<Mesh::Index, 3> sorted_nodes(const Mesh::Index* cell, std::size_t corners, std::size_t opposite) {
    std::array<Mesh::Index, 3> nodes{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < corners; ++i) {
        if (i != opposite) nodes[count++] = cell[i];
    }
    if (count == 2) nodes[2] = std::min(nodes[0], nodes[1]);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

/// f(cell, corner, sorted nodes) for every facet that is asked for, on all threads.
template <class F>
void for_each_facet(const Mesh& mesh, std::span<const std::uint8_t> use, F&& f) {
    const std::size_t corners = mesh.corners();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.cell_count(), 4096), [&](const auto& range) {
        for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
            if (!use.empty() && use[cell] == 0) continue;
            for (std::size_t corner = 0; corner < corners; ++corner)
                f(cell, corner, sorted_nodes(&mesh.cells[cell * corners], corners, corner));
        }
    });
}

}  // namespace

FacetTable::FacetTable(const Mesh& mesh, std::span<const std::uint8_t> use) {
    // A counting sort by the lowest node leaves lists as short as a node has cells. Threads place facets in any order;
    // sorting the lists makes it one.
    std::vector<std::size_t> next(mesh.point_count() + 1, 0);
    for_each_facet(mesh, use, [&](std::size_t, std::size_t, const std::array<Mesh::Index, 3>& nodes) {
        std::atomic_ref(next[static_cast<std::size_t>(nodes[0]) + 1]).fetch_add(1, std::memory_order_relaxed);
    });
    for (std::size_t node = 0; node + 1 < next.size(); ++node) next[node + 1] += next[node];
    begin_ = next;
    resize_large(facets_, begin_.back());
    for_each_facet(mesh, use, [&](std::size_t cell, std::size_t corner, const std::array<Mesh::Index, 3>& nodes) {
        const std::size_t place =
            std::atomic_ref(next[static_cast<std::size_t>(nodes[0])]).fetch_add(1, std::memory_order_relaxed);
        facets_[place] = {nodes[1], nodes[2], static_cast<Mesh::Index>(cell), static_cast<std::int32_t>(corner)};
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, node_count(), 1024), [&](const auto& range) {
        for (std::size_t node = range.begin(); node != range.end(); ++node) {
            std::sort(facets_.data() + begin_[node], facets_.data() + begin_[node + 1],
                      [](const CellFacet& a, const CellFacet& b) {
                          return std::tuple(a.key(), a.cell, a.corner) < std::tuple(b.key(), b.cell, b.corner);
                      });
        }
    });
}

}  // namespace barycert::detail

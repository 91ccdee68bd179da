#include "mesh/adjacency.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/base/large_pages.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::mesh {
namespace {

/// The corners of a cell by ascending node. Fixed comparisons: this is done twice for each cell.
struct SortedCell {
    std::array<Mesh::Index, 4> node;
    std::array<std::int32_t, 4> corner;

    SortedCell(const Mesh::Index* cell, std::size_t corners) {
        std::array<std::uint64_t, 4> keys;
        for (std::size_t i = 0; i < 4; ++i)
            keys[i] = i < corners ? static_cast<std::uint64_t>(cell[i]) << 2 | i : ~std::uint64_t{0};
        const auto order = [&](std::size_t i, std::size_t j) {
            const std::uint64_t low = std::min(keys[i], keys[j]);
            keys[j] = std::max(keys[i], keys[j]);
            keys[i] = low;
        };
        order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
        for (std::size_t i = 0; i < 4; ++i) {
            node[i] = static_cast<Mesh::Index>(keys[i] >> 2);
            corner[i] = static_cast<std::int32_t>(keys[i] & 3);
        }
    }
};

/// f(cell, its corners sorted) for every cell that is asked for, on all threads.
template <class F>
void for_each_cell(const Mesh& mesh, std::span<const std::uint8_t> use, F&& f) {
    base::parallel_for_each(mesh.cell_count(), 4096, [&](std::size_t cell) {
        if (use.empty() || use[cell] != 0) f(cell, SortedCell(&mesh.cells[cell * mesh.corners()], mesh.corners()));
    });
}

std::size_t add(std::size_t& counter, std::size_t n) {
    return std::atomic_ref(counter).fetch_add(n, std::memory_order_relaxed);
}

}  // namespace

FacetTable::FacetTable(const Mesh& mesh, std::span<const std::uint8_t> use) {
    // A counting sort by the lowest node leaves lists as short as a node has cells. Threads place facets in any order;
    // sorting the lists makes it one.
    // All facets of a cell but the one opposite to its lowest node have that node as their lowest.
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::vector<std::size_t> next(mesh.point_count() + 1, 0);
    for_each_cell(mesh, use, [&](std::size_t, const SortedCell& c) {
        add(next[static_cast<std::size_t>(c.node[0]) + 1], d);
        add(next[static_cast<std::size_t>(c.node[1]) + 1], 1);
    });
    for (std::size_t node = 0; node + 1 < next.size(); ++node) next[node + 1] += next[node];
    begin_ = next;
    base::resize_large(facets_, begin_.back());
    for_each_cell(mesh, use, [&](std::size_t cell, const SortedCell& c) {
        const auto [n, corner] = c;
        const auto index = static_cast<Mesh::Index>(cell);
        CellFacet* const at_first = facets_.data() + add(next[static_cast<std::size_t>(n[0])], d);
        CellFacet* const at_second = facets_.data() + add(next[static_cast<std::size_t>(n[1])], 1);
        if (d == 2) {
            at_first[0] = {n[0], n[1], index, corner[2]};
            at_first[1] = {n[0], n[2], index, corner[1]};
            *at_second = {n[1], n[2], index, corner[0]};
        } else {
            at_first[0] = {n[1], n[2], index, corner[3]};
            at_first[1] = {n[1], n[3], index, corner[2]};
            at_first[2] = {n[2], n[3], index, corner[1]};
            *at_second = {n[2], n[3], index, corner[0]};
        }
    });
    base::parallel_for_each(node_count(), 1024, [&](std::size_t node) {
        const std::span list(facets_.data() + begin_[node], facets_.data() + begin_[node + 1]);
        std::ranges::sort(list, {}, [](const CellFacet& f) { return std::tuple(f.key(), f.cell, f.corner); });
    });
}

void pair_facets(std::span<const CellFacet> equal, std::size_t corners, std::vector<Mesh::Index>& neighbours) {
    // A cell with a repeated corner holds a facet twice and is not its own neighbour.
    const CellFacet& first = equal.front();
    const auto second = std::ranges::find_if(equal, [&](const CellFacet& f) { return f.cell != first.cell; });
    if (second == equal.end()) return;
    const auto place = [&](const CellFacet& f) {
        return static_cast<std::size_t>(f.cell) * corners + static_cast<std::size_t>(f.corner);
    };
    neighbours[place(first)] = second->cell;
    neighbours[place(*second)] = first.cell;
}

std::vector<Mesh::Index> compute_neighbours(const Mesh& mesh) {
    std::vector<Mesh::Index> neighbours(mesh.cells.size(), -1);
    const FacetTable table(mesh);
    base::parallel_for(table.node_count(), 1024, [&](std::size_t begin, std::size_t end) {
        table.for_each_group(begin, end,
                             [&](std::span<const CellFacet> equal) { pair_facets(equal, mesh.corners(), neighbours); });
    });
    return neighbours;
}

std::vector<std::int64_t> hull_facets(const Mesh& mesh, const std::vector<Mesh::Index>& neighbours) {
    std::vector<std::int64_t> hull;
    for (std::size_t place = 0; place < std::min(mesh.cells.size(), neighbours.size()); ++place) {
        if (neighbours[place] == -1) hull.push_back(static_cast<std::int64_t>(place));
    }
    return hull;
}

}  // namespace barycert::mesh
